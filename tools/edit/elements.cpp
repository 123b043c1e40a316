#include <tools/edit/elements.h>

#include <algorithm>

#include <vdbcage/mesh/detail/half_edges.h>

namespace vdbcage::edit {

void Elements::Lists::add(const std::vector<Index>& ids)
{
    ids_.insert(ids_.end(), ids.begin(), ids.end());
    first_.push_back(ids_.size());
}

Elements::Lists Elements::Lists::inverse(const Lists& of, std::size_t count)
{
    std::vector<std::vector<Index>> lists(count);
    for (std::size_t i = 0; i < of.size(); ++i) {
        for (const Index id : of[i]) {
            if (id == none) continue;
            const bool isNew = lists[id].empty() || lists[id].back() != i;
            if (isNew) lists[id].push_back(static_cast<Index>(i));
        }
    }
    Lists result;
    for (const std::vector<Index>& list : lists) result.add(list);
    return result;
}

Elements::Elements(const Mesh& mesh) : points_(mesh.points.size())
{
    const detail::HalfEdges halfEdges(mesh);
    const detail::EdgeTable table(halfEdges, points_);
    edges_.reserve(table.size());
    Lists pointsOfEdges;
    for (std::size_t edge = 0; edge < table.size(); ++edge) {
        const std::size_t h = table[edge][0];
        edges_.push_back(std::minmax({halfEdges.from(h), halfEdges.to(h)}));
        pointsOfEdges.add({edges_.back().first, edges_.back().second});
    }
    std::size_t h = 0;
    const auto addFace = [&](std::size_t size) {
        std::vector<Index> points, edges;
        for (std::size_t i = 0; i < size; ++i, ++h) {
            const std::size_t edge = table.edgeOf(h);
            points.push_back(halfEdges.from(h));
            edges.push_back(edge == detail::EdgeTable::none ? none : static_cast<Index>(edge));
        }
        pointsOfFaces_.add(points);
        edgesOfFaces_.add(edges);
    };
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) addFace(3);
    for (std::size_t i = 0; i < mesh.quads.size(); ++i) addFace(4);
    facesOfEdges_ = Lists::inverse(edgesOfFaces_, edges_.size());
    edgesOfPoints_ = Lists::inverse(pointsOfEdges, points_);
    facesOfPoints_ = Lists::inverse(pointsOfFaces_, points_);
}

std::size_t Elements::count(Element kind) const
{
    switch (kind) {
    case Element::point:
        return points_;
    case Element::edge:
        return edges_.size();
    case Element::face:
        break;
    }
    return pointsOfFaces_.size();
}

Index Elements::edgeBetween(Index a, Index b) const
{
    const std::pair<Index, Index> wanted = std::minmax({a, b});
    const auto found = std::lower_bound(edges_.begin(), edges_.end(), wanted);
    return found != edges_.end() && *found == wanted ? static_cast<Index>(found - edges_.begin()) : none;
}

} // namespace vdbcage::edit
