#include <tools/edit/selection.h>

#include <algorithm>
#include <iterator>
#include <string>

#include <vdbcage/core/error.h>
#include <vdbcage/geometry/union_find.h>

namespace vdbcage::edit {

namespace {

/// Whether each element of a kind is selected, by its number.
using Marks = std::vector<char>;

Marks marksOf(const Elements& elements, const Selection& selection)
{
    Marks marks(elements.count(selection.kind), 0);
    for (const Index id : selection.ids) marks[id] = 1;
    return marks;
}

std::vector<Index> idsOf(const Marks& marks)
{
    std::vector<Index> ids;
    for (Index id = 0; id < marks.size(); ++id) {
        if (marks[id]) ids.push_back(id);
    }
    return ids;
}

/// Calls `visit(point)` for each point of an element.
template <typename Visit>
void forEachPoint(const Elements& elements, Element kind, Index id, const Visit& visit)
{
    if (kind == Element::point) {
        visit(id);
    } else if (kind == Element::edge) {
        visit(elements.edges()[id].first);
        visit(elements.edges()[id].second);
    } else {
        for (const Index point : elements.pointsOfFace(id)) visit(point);
    }
}

/// Returns the elements of a kind of which all points are marked.
Selection within(const Elements& elements, Element kind, const Marks& points)
{
    Selection result{kind, {}};
    for (Index id = 0; id < elements.count(kind); ++id) {
        bool isWithin = true;
        forEachPoint(elements, kind, id, [&](Index point) { isWithin = isWithin && points[point]; });
        if (isWithin) result.ids.push_back(id);
    }
    return result;
}

Marks pointMarks(const Elements& elements, const Selection& selection)
{
    Marks points(elements.count(Element::point), 0);
    for (const Index id : selection.ids) {
        forEachPoint(elements, selection.kind, id, [&](Index point) { points[point] = 1; });
    }
    return points;
}

void requireOneKind(const Selection& a, const Selection& b)
{
    if (a.kind == b.kind) return;
    throw InputError(std::string("selection: ") + elementsName(a.kind) + " and " + elementsName(b.kind) +
                     " do not go together; both must be of one kind");
}

/// Returns the corner of the face at `point`.
std::size_t cornerOf(const Elements& elements, Index face, Index point)
{
    const Ids points = elements.pointsOfFace(face);
    return static_cast<std::size_t>(std::find(points.begin(), points.end(), point) - points.begin());
}

/// Returns the face beyond an edge; `none` unless the edge has two faces.
Index faceAcross(const Elements& elements, Index edge, Index face)
{
    const Ids faces = elements.facesOfEdge(edge);
    if (faces.size() != 2) return none;
    return faces[0] == face ? faces[1] : faces[0];
}

/// Returns the edges around a point, each with its neighbours beside it, `edge` first; empty unless they form one
/// closed umbrella.
std::vector<Index> umbrella(const Elements& elements, Index point, Index edge)
{
    const std::size_t valence = elements.edgesOfPoint(point).size();
    std::vector<Index> edges;
    if (elements.facesOfPoint(point).size() != valence) return {};
    Index face = elements.facesOfEdge(edge)[0];
    for (Index at = edge; edges.size() < valence;) {
        edges.push_back(at);
        const Ids around = elements.edgesOfFace(face);
        const std::size_t corner = cornerOf(elements, face, point);
        const Index after = around[corner], before = around[(corner + around.size() - 1) % around.size()];
        if (after == none || before == none || after == before || (at != after && at != before)) return {};
        at = at == after ? before : after;
        face = faceAcross(elements, at, face);
        if (face == none) return {};
        if (at == edge) break;
    }
    return edges.size() == valence ? edges : std::vector<Index>(); // fewer: there are several umbrellas
}

/// Returns the edge that goes on from `edge` beyond `point`; `none` if the loop ends there.
Index opposite(const Elements& elements, Index point, Index edge)
{
    const std::size_t valence = elements.edgesOfPoint(point).size();
    if (valence < 4 || valence % 2 != 0) return none;
    if (valence != 4) {
        for (const Index face : elements.facesOfPoint(point)) {
            if (elements.pointsOfFace(face).size() != 3) return none;
        }
    }
    const std::vector<Index> around = umbrella(elements, point, edge);
    return around.empty() ? none : around[valence / 2];
}

/// Marks the edges of the loop through `edge`. A step can be taken back, so a walk without end comes back to its
/// beginning.
void markEdgeLoop(const Elements& elements, Index edge, Marks& edges)
{
    const auto& ends = elements.edges();
    edges[edge] = 1;
    for (const Index start : {ends[edge].first, ends[edge].second}) {
        Index at = edge, point = start;
        for (;;) {
            at = opposite(elements, point, at);
            if (at == none) break;
            edges[at] = 1;
            point = ends[at].first == point ? ends[at].second : ends[at].first;
            if (at == edge && point == start) return; // the other way meets the same edges
        }
    }
}

/// Marks the quads of the strip that leaves `face` through `edge`.
void markStrip(const Elements& elements, Index face, Index edge, Marks& faces)
{
    Index at = face, through = edge;
    for (;;) {
        at = faceAcross(elements, through, at);
        if (at == none) return;
        const Ids around = elements.edgesOfFace(at);
        if (around.size() != 4) return;
        faces[at] = 1;
        const auto side = static_cast<std::size_t>(std::find(around.begin(), around.end(), through) - around.begin());
        through = around[(side + 2) % 4];
        if (through == none || (at == face && through == edge)) return;
    }
}

void markStrips(const Elements& elements, const Marks& selected, Index face, Marks& faces)
{
    const Ids around = elements.edgesOfFace(face);
    if (around.size() != 4) return;
    const auto isBeside = [&](std::size_t side) { // a selected face
        const Index other = around[side] == none ? none : faceAcross(elements, around[side], face);
        return other != none && selected[other];
    };
    const bool isAlone = !isBeside(0) && !isBeside(1) && !isBeside(2) && !isBeside(3);
    for (std::size_t side = 0; side < 4; ++side) {
        const bool isWanted = isAlone || isBeside(side) || isBeside((side + 2) % 4);
        if (isWanted && around[side] != none) markStrip(elements, face, around[side], faces);
    }
}

} // namespace

std::vector<Index> pointsOf(const Elements& elements, const Selection& selection)
{
    return idsOf(pointMarks(elements, selection));
}

Selection converted(const Elements& elements, const Selection& selection, Element kind)
{
    if (kind == selection.kind) return selection;
    return within(elements, kind, pointMarks(elements, selection));
}

Selection all(const Elements& elements, Element kind)
{
    return inverted(elements, {kind, {}});
}

Selection inverted(const Elements& elements, const Selection& selection)
{
    Marks marks = marksOf(elements, selection);
    for (Index id = 0; id < marks.size(); ++id) {
        marks[id] = !marks[id] && (selection.kind != Element::point || elements.isUsed(id));
    }
    return {selection.kind, idsOf(marks)};
}

Selection linked(const Elements& elements, const Selection& selection)
{
    detail::UnionFind components(elements.count(Element::point));
    for (Index face = 0; face < elements.count(Element::face); ++face) {
        const Ids points = elements.pointsOfFace(face);
        for (const Index point : points) components.unite(points[0], point);
    }
    Marks isWanted(elements.count(Element::point), 0); // by the component's root
    for (const Index point : pointsOf(elements, selection)) isWanted[components.find(point)] = 1;
    Marks points(isWanted.size());
    for (Index point = 0; point < points.size(); ++point) points[point] = isWanted[components.find(point)];
    return within(elements, selection.kind, points);
}

Selection grown(const Elements& elements, const Selection& selection)
{
    Marks marks = marksOf(elements, selection);
    for (const Index point : pointsOf(elements, selection)) {
        if (selection.kind == Element::face) {
            for (const Index face : elements.facesOfPoint(point)) marks[face] = 1;
            continue;
        }
        for (const Index edge : elements.edgesOfPoint(point)) {
            if (selection.kind == Element::edge) {
                marks[edge] = 1;
            } else {
                marks[elements.edges()[edge].first] = marks[elements.edges()[edge].second] = 1;
            }
        }
    }
    return {selection.kind, idsOf(marks)};
}

Selection shrunk(const Elements& elements, const Selection& selection)
{
    return removed(selection, grown(elements, inverted(elements, selection)));
}

Selection loop(const Elements& elements, const Selection& selection)
{
    const Marks selected = marksOf(elements, selection);
    Marks marks = selected;
    if (selection.kind == Element::face) {
        for (const Index face : selection.ids) markStrips(elements, selected, face, marks);
        return {selection.kind, idsOf(marks)};
    }
    Marks edges(elements.count(Element::edge), 0);
    for (const Index edge : converted(elements, selection, Element::edge).ids) markEdgeLoop(elements, edge, edges);
    const Selection loops = converted(elements, {Element::edge, idsOf(edges)}, selection.kind);
    return added(selection, loops);
}

Selection added(const Selection& selection, const Selection& more)
{
    requireOneKind(selection, more);
    Selection result{selection.kind, {}};
    std::set_union(selection.ids.begin(), selection.ids.end(), more.ids.begin(), more.ids.end(),
                   std::back_inserter(result.ids));
    return result;
}

Selection removed(const Selection& selection, const Selection& less)
{
    requireOneKind(selection, less);
    Selection result{selection.kind, {}};
    std::set_difference(selection.ids.begin(), selection.ids.end(), less.ids.begin(), less.ids.end(),
                        std::back_inserter(result.ids));
    return result;
}

} // namespace vdbcage::edit
