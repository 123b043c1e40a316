#include <tools/view/state/cage_changes.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include <openvdb/math/Mat3.h>
#include <tools/edit/mirror.h>
#include <tools/edit/selection.h>
#include <tools/edit/soft.h>
#include <tools/edit/topology.h>
#include <vdbcage/core/error.h>

namespace vdbcage::view {

namespace {

using openvdb::Index32;
using openvdb::Vec3d;

std::vector<Index32> requiredPoints(const State& state, const Mesh& cage)
{
    std::vector<Index32> points = selectedPoints(cage, state.view.selection);
    if (points.empty()) throw InputError("nothing of the cage is selected");
    return points;
}

/// Returns how far each point moves with the selection, 0 to 1.
std::vector<double> weightsOf(const State& state, const Mesh& cage, const std::vector<Index32>& points)
{
    if (state.view.softRadius > 0) {
        const Vec3d extents = boundingBox(state.document.model ? state.document.model->mesh : cage).extents();
        const double longest = std::max({extents.x(), extents.y(), extents.z()});
        return edit::softWeights(edit::Elements(cage), cage.points, points, state.view.softRadius * longest);
    }
    std::vector<double> weights(cage.points.size(), 0);
    for (const Index32 i : points) weights[i] = 1;
    return weights;
}

/// Returns axes of which the last is along `normal`, or those of the world if it is 0.
std::array<Vec3d, 3> axesWithZ(const Vec3d& normal)
{
    const double length = normal.length();
    if (!(length > 0)) return {Vec3d(1, 0, 0), Vec3d(0, 1, 0), Vec3d(0, 0, 1)};
    const Vec3d z = normal / length;
    // The axis of the world at the largest angle to it.
    int least = 0;
    for (int k = 1; k < 3; ++k) {
        if (std::abs(z[k]) < std::abs(z[least])) least = k;
    }
    Vec3d side(0);
    side[least] = 1;
    const Vec3d x = (side - z * z[least]).unit();
    return {x, z.cross(x), z};
}

/// Returns the sum of the area vectors of the faces that touch the selected points.
Vec3d meanNormal(const Mesh& cage, const std::vector<Vec3d>& points, const std::vector<Index32>& selected)
{
    Vec3d sum(0);
    for (const openvdb::Vec3I& t : triangulate(cage)) {
        const bool touches = std::binary_search(selected.begin(), selected.end(), t[0]) ||
                             std::binary_search(selected.begin(), selected.end(), t[1]) ||
                             std::binary_search(selected.begin(), selected.end(), t[2]);
        if (touches) sum += (points[t[1]] - points[t[0]]).cross(points[t[2]] - points[t[0]]);
    }
    return sum;
}

/// Returns the axes of the points' extents: x along the longest.
std::array<Vec3d, 3> principalAxes(const std::vector<Vec3d>& points, const std::vector<Index32>& selected,
                                   const Vec3d& mean)
{
    openvdb::Mat3d covariance = openvdb::Mat3d::zero(), vectors;
    for (const Index32 i : selected) {
        const Vec3d d = points[i] - mean;
        for (int r = 0; r < 3; ++r) {
            for (int c = 0; c < 3; ++c) covariance[r][c] += d[r] * d[c];
        }
    }
    Vec3d values;
    if (!openvdb::math::diagonalizeSymmetricMatrix(covariance, vectors, values)) return axesWithZ(Vec3d(0));
    std::array<int, 3> order{0, 1, 2};
    std::sort(order.begin(), order.end(), [&](int a, int b) { return values[a] > values[b]; });
    const Vec3d x = vectors.col(order[0]).unit(), y = vectors.col(order[1]).unit();
    return {x, y, x.cross(y)};
}

/// Returns the pivot. \pre some points are selected, with the mean `mean`
Vec3d pivotPoint(const Pivot& pivot, const std::vector<Vec3d>& points, const std::vector<Index32>& selected,
                 const Vec3d& mean)
{
    if (pivot.kind == Pivot::Kind::mean) return mean;
    if (pivot.kind != Pivot::Kind::box) return pivot.point;
    openvdb::BBoxd box(points[selected.front()], points[selected.front()]);
    for (const Index32 i : selected) box.expand(points[i]);
    return 0.5 * (box.min() + box.max());
}

/// The farthest distance of a point, in longest sides of the cage: points beyond it are invisible, and cannot be drawn
/// in the end.
constexpr double farthest = 1e9;

void requireNear(const std::vector<Vec3d>& points, const openvdb::BBoxd& cage)
{
    const Vec3d middle = 0.5 * (cage.min() + cage.max());
    const double longest = cage.extents()[cage.maxExtent()];
    for (const Vec3d& p : points) {
        const bool isNear = (p - middle).length() <= farthest * longest;
        if (!p.isFinite() || (longest > 0 && !isNear)) throw InputError("a point would be moved too far away");
    }
}

/// Returns the document with an edited cage and its locked points.
Document withRest(const State& state, Mesh cage, std::vector<Index32> locked)
{
    OpenedMesh edited;
    edited.mesh = std::move(cage);
    Document document = state.document;
    document.setCage(std::make_shared<const OpenedMesh>(std::move(edited)));
    document.locked = std::move(locked);
    return document;
}

bool isIn(const std::vector<Index32>& ascending, Index32 point)
{
    return std::binary_search(ascending.begin(), ascending.end(), point);
}

using Edge = std::pair<Index32, Index32>;

/// Returns the selected edges by their points; if points or faces are selected, the edges between them.
std::vector<Edge> selectedEdges(const edit::Elements& elements, const edit::Selection& selection)
{
    std::vector<Edge> edges;
    if (selection.kind == edit::Element::face) {
        // These are the edges between two selected faces.
        for (Index32 e = 0; e < elements.edges().size(); ++e) {
            const edit::Ids faces = elements.facesOfEdge(e);
            const auto isSelected = [&](Index32 face) {
                return std::binary_search(selection.ids.begin(), selection.ids.end(), face);
            };
            if (faces.size() == 2 && isSelected(faces[0]) && isSelected(faces[1])) edges.push_back(elements.edges()[e]);
        }
        return edges;
    }
    for (const Index32 e : edit::converted(elements, selection, edit::Element::edge).ids) {
        edges.push_back(elements.edges()[e]);
    }
    return edges;
}

/// `locked` are points of the cage; they get their new numbers.
Mesh withEditedEdges(Mesh cage, std::vector<Edge> edges, CageEdit edit, std::vector<Index32>& locked)
{
    for (std::size_t i = 0; i < edges.size(); ++i) {
        // Earlier collapses may have turned it around.
        const Index32 a = std::min(edges[i].first, edges[i].second), b = std::max(edges[i].first, edges[i].second);
        if (a == b) continue;
        const Index32 edge = edit::Elements(cage).edgeBetween(a, b);
        if (edge == edit::none) continue; // an earlier edit removed it
        if (edit == CageEdit::split) cage = edit::splitEdge(cage, edge);
        if (edit == CageEdit::flip) cage = edit::flipEdge(cage, edge);
        if (edit == CageEdit::merge) cage = edit::mergeFaces(cage, edge);
        if (edit != CageEdit::collapse) continue;
        if (isIn(locked, a) || isIn(locked, b)) {
            throw InputError("edge " + std::to_string(edge) + " has a locked point, which a collapse would move");
        }
        cage = edit::collapseEdge(cage, edge);
        // The larger index was removed.
        for (Index32& point : locked) {
            if (point > b) --point;
        }
        for (Edge& other : edges) {
            for (Index32* const end : {&other.first, &other.second}) {
                if (*end == b) {
                    *end = a;
                } else if (*end > b) {
                    --*end;
                }
            }
        }
    }
    return cage;
}

/// Cuts the quads from the last one on, so that those before keep their numbers.
Mesh withCutQuads(Mesh cage, const std::vector<Index32>& faces)
{
    const std::size_t triangles = cage.triangles.size();
    for (auto i = faces.rbegin(); i != faces.rend() && *i >= triangles; ++i) {
        cage = edit::cutQuad(cage, static_cast<Index32>(cage.triangles.size() + (*i - triangles)));
    }
    return cage;
}

} // namespace

const MeshPtr& restOf(const PosableCagePtr& cage)
{
    if (!cage) throw InputError("there is no cage yet");
    return cage->rest();
}

edit::Selection withinCage(edit::Selection selection, const edit::Elements& elements)
{
    std::vector<Index32>& ids = selection.ids;
    ids.erase(std::lower_bound(ids.begin(), ids.end(), elements.count(selection.kind)), ids.end());
    return selection;
}

std::vector<Index32> selectedPoints(const Mesh& cage, const edit::Selection& selection)
{
    const edit::Elements elements(cage);
    return edit::pointsOf(elements, withinCage(selection, elements));
}

std::vector<Vec3d> cagePoints(const State& state, const PosableCagePtr& cage)
{
    if (!cage) return {};
    if (state.view.mode == Mode::shape) return cage->rest()->points;
    return pointsAt(state.document.poses, state.view.frame, *cage);
}

std::optional<SelectionFrame> selectionFrame(const State& state, const PosableCagePtr& cage,
                                             const std::array<Vec3d, 3>& view)
{
    if (!cage) return std::nullopt;
    const std::vector<Index32> selected = selectedPoints(*cage->rest(), state.view.selection);
    if (selected.empty()) return std::nullopt;
    // This is called at each event, which must not wait for poses to be carried over.
    if (state.view.mode == Mode::pose && !areCarried(state.document.poses, *cage)) return std::nullopt;
    const std::vector<Vec3d> points = cagePoints(state, cage);
    SelectionFrame frame;
    for (const Index32 i : selected) frame.mean += points[i] / static_cast<double>(selected.size());
    frame.count = selected.size();
    frame.origin = pivotPoint(state.view.pivot, points, selected, frame.mean);
    switch (state.view.orientation) {
    case Orientation::world:
        frame.axes = axesWithZ(Vec3d(0));
        break;
    case Orientation::local:
        frame.axes = principalAxes(points, selected, frame.mean);
        break;
    case Orientation::normal:
        frame.axes = axesWithZ(meanNormal(*cage->rest(), points, selected));
        break;
    case Orientation::view:
        frame.axes = view;
        break;
    }
    return frame;
}

Document withMotion(const State& state, const PosableCagePtr& cage, const edit::Motion& motion)
{
    const Mesh& rest = *restOf(cage);
    const std::vector<Index32> selected = requiredPoints(state, rest);
    const bool isPosing = state.view.mode == Mode::pose;
    const std::vector<Index32> locked = isPosing ? std::vector<Index32>() : state.document.locked;
    if (std::includes(locked.begin(), locked.end(), selected.begin(), selected.end())) {
        throw InputError("all selected points are locked");
    }
    const std::vector<double> weights = weightsOf(state, rest, selected);
    const std::vector<Vec3d> before = cagePoints(state, cage);
    std::vector<Vec3d> after = edit::moved(before, weights, motion);
    if (const auto& plane = state.view.mirror) {
        std::vector<Index32> ids;
        for (Index32 i = 0; i < weights.size(); ++i) {
            if (weights[i] > 0) ids.push_back(i);
        }
        const auto partners = edit::mirrorPartners(rest.points, plane->axis, plane->offset);
        after = edit::mirrored(before, after, ids, partners, plane->axis, plane->offset);
    }
    for (const Index32 i : locked) {
        if (i < after.size()) after[i] = before[i];
    }
    requireNear(after, boundingBox(rest));
    if (isPosing) return withPose(state, cage, std::move(after));
    Mesh moved = rest;
    moved.points = std::move(after);
    return withRest(state, std::move(moved), locked);
}

Document withFit(const State& state, const PosableCagePtr& cage, double tightness)
{
    Document document = state.document.cage ? state.document : withRest(state, *restOf(cage), {});
    document.isFitted = true;
    document.tightness = tightness;
    return document;
}

Document withLocks(const State& state, const PosableCagePtr& cage, bool locks)
{
    const Mesh& rest = *restOf(cage);
    if (state.view.mode != Mode::shape) throw InputError("points of the cage are locked in mode shape");
    const std::vector<Index32> selected = requiredPoints(state, rest), &before = state.document.locked;
    std::vector<Index32> locked;
    const auto end = std::back_inserter(locked);
    if (locks) {
        std::set_union(before.begin(), before.end(), selected.begin(), selected.end(), end);
    } else {
        std::set_difference(before.begin(), before.end(), selected.begin(), selected.end(), end);
    }
    if (locked == before) return state.document;
    const bool isShown = state.document.cage && !state.document.isFitted;
    Document document = isShown ? state.document : withRest(state, rest, {});
    document.locked = std::move(locked);
    return document;
}

Document withEdit(const State& state, const PosableCagePtr& cage, CageEdit edit)
{
    const Mesh& rest = *restOf(cage);
    if (state.view.mode != Mode::shape) throw InputError("the faces of the cage are changed in mode shape");
    requiredPoints(state, rest);
    const edit::Elements elements(rest);
    const edit::Selection selection = withinCage(state.view.selection, elements);
    std::vector<Index32> locked = state.document.locked;
    if (edit == CageEdit::cut) {
        return withRest(state, withCutQuads(rest, edit::converted(elements, selection, edit::Element::face).ids),
                        std::move(locked));
    }
    std::vector<Edge> edges = selectedEdges(elements, selection);
    if (edges.empty()) throw InputError("no edge of the cage is selected, nor one between selected elements");
    Mesh edited = withEditedEdges(rest, std::move(edges), edit, locked);
    return withRest(state, std::move(edited), std::move(locked));
}

Document withResetPose(const State& state, const PosableCagePtr& cage, bool onlySelected)
{
    const Mesh& rest = *restOf(cage);
    if (!onlySelected) return withPose(state, cage, rest.points);
    std::vector<Vec3d> points = pointsAt(state.document.poses, state.view.frame, *cage);
    for (const Index32 i : requiredPoints(state, rest)) points[i] = rest.points[i];
    return withPose(state, cage, std::move(points));
}

Document withPose(const State& state, const PosableCagePtr& cage, std::vector<Vec3d> points)
{
    const MeshPtr& rest = restOf(cage);
    if (points.size() != rest->points.size()) {
        throw InputError("the pose has " + std::to_string(points.size()) + " points; the cage has " +
                         std::to_string(rest->points.size()));
    }
    for (const Vec3d& p : points) {
        if (!p.isFinite()) throw InputError("the pose has a point that is not finite");
    }
    Document document = state.document;
    TimeLine& poses = document.poses;
    PoseKey key;
    key.frame = state.view.frame;
    if (const PoseKey* const before = poses.keyAt(key.frame)) key.name = before->name;
    key.pose = poseOf(rest, std::move(points));
    // If everything is at rest there is no pose, whatever edit led there.
    const bool isAlone = poses.without(key.frame).isEmpty();
    poses = !key.pose && isAlone && key.name.empty() ? TimeLine() : poses.with(std::move(key));
    return document;
}

Document withKey(const State& state, const PosableCagePtr& cage, int frame, const std::optional<std::string>& name)
{
    Document document = state.document;
    PoseKey key;
    key.frame = frame;
    if (const PoseKey* const before = document.poses.keyAt(frame)) {
        key = *before;
    } else {
        const MeshPtr& rest = restOf(cage);
        key.pose = poseOf(rest, pointsAt(document.poses, frame, *cage));
    }
    if (name) key.name = *name;
    document.poses = document.poses.with(std::move(key));
    return document;
}

Document withInBetweens(const State& state, const PosableCagePtr& cage, int frames)
{
    const MeshPtr& rest = restOf(cage);
    PosePtr pose = poseOf(rest, pointsAt(state.document.poses, state.view.frame, *cage));
    Document document = state.document;
    document.poses = TimeLine().with({0, nullptr, "rest"}).with({frames - 1, std::move(pose), "pose"});
    return document;
}

} // namespace vdbcage::view
