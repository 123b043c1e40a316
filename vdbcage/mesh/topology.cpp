#include <vdbcage/mesh/topology.h>

#include <algorithm>
#include <atomic>
#include <functional>

#include <tbb/blocked_range.h>
#include <vdbcage/core/detail/asker.h>
#include <vdbcage/core/detail/parallel.h>
#include <vdbcage/geometry/union_find.h>
#include <vdbcage/mesh/detail/half_edges.h>

namespace vdbcage {

namespace {

using detail::HalfEdges;
using Index = HalfEdges::Index;

// The half-edges that leave each point, one for each corner: those of point p are corners[first[p]] ... corners[first[p
// + 1] - 1], ascending.
struct CornersOfPoints {
    CornersOfPoints(const HalfEdges& all, std::size_t points, Interrupter* interrupter)
        : first(points + 1, 0), corners(all.size())
    {
        detail::Asker ask(interrupter);
        for (std::size_t c = 0; c < all.size(); ++c) {
            ask();
            ++first[all.from(c) + 1];
        }
        for (std::size_t p = 0; p < points; ++p) first[p + 1] += first[p];
        std::vector<std::size_t> next(first.begin(), first.end() - 1);
        for (std::size_t c = 0; c < all.size(); ++c) {
            ask();
            corners[next[all.from(c)]++] = c;
        }
    }

    std::vector<std::size_t> first;
    std::vector<std::size_t> corners;
};

// A corner's edge to a neighbour of the vertex under examination.
struct IncidentEdge {
    Index neighbour;
    Index corner; // counted within the vertex
    bool outward; // the face runs from the vertex to the neighbour
};

struct Counts {
    std::size_t vertices = 0, edges = 0, boundary = 0, nonManifold = 0, misoriented = 0, nonManifoldVertices = 0;

    Counts operator+(const Counts& other) const
    {
        return {vertices + other.vertices,       edges + other.edges,
                boundary + other.boundary,       nonManifold + other.nonManifold,
                misoriented + other.misoriented, nonManifoldVertices + other.nonManifoldVertices};
    }
};

// The facts about faces that the threads find together.
struct FaceFacts {
    explicit FaceFacts(std::size_t faces) : sets(faces), unbalanced(faces) {}

    detail::UnionFind sets;                    // connected over edges
    std::vector<std::atomic<bool>> unbalanced; // set for a face at each edge not run along equally often both ways
};

class VertexExaminer {
public:
    VertexExaminer(const HalfEdges& corners, const CornersOfPoints& ofPoints, FaceFacts& faces)
        : corners_(corners), ofPoints_(ofPoints), faces_(faces)
    {
    }

    // Edges are counted at their end with the smaller index; umbrellas at every vertex.
    void examine(Index vertex, Counts& counts)
    {
        const std::size_t begin = ofPoints_.first[vertex], count = ofPoints_.first[vertex + 1] - begin;
        if (count == 0) return;
        ++counts.vertices;
        incidentEdges_.clear();
        umbrellas_.resize(count);
        for (Index i = 0; i < count; ++i) {
            umbrellas_[i] = i;
            const std::size_t corner = ofPoints_.corners[begin + i];
            const Index next = corners_.to(corner), previous = corners_.before(corner);
            if (next != vertex) incidentEdges_.push_back({next, i, true});
            if (previous != vertex) incidentEdges_.push_back({previous, i, false});
        }
        std::sort(incidentEdges_.begin(), incidentEdges_.end(),
                  [](const IncidentEdge& a, const IncidentEdge& b) { return a.neighbour < b.neighbour; });
        for (std::size_t i = 0, end; i < incidentEdges_.size(); i = end) {
            const Index first = incidentEdges_[i].corner;
            std::size_t out = 0;
            for (end = i; end < incidentEdges_.size() && incidentEdges_[end].neighbour == incidentEdges_[i].neighbour;
                 ++end) {
                if (incidentEdges_[end].outward) ++out;
                umbrellas_[root(incidentEdges_[end].corner)] = root(first);
                if (vertex < incidentEdges_[i].neighbour) {
                    faces_.sets.unite(face(begin, first), face(begin, incidentEdges_[end].corner));
                }
            }
            if (vertex < incidentEdges_[i].neighbour) countEdge(end - i, out, face(begin, first), counts);
        }
        std::size_t umbrellas = 0;
        for (Index i = 0; i < count; ++i) umbrellas += umbrellas_[i] == i ? 1 : 0;
        if (umbrellas > 1) ++counts.nonManifoldVertices;
    }

private:
    Index face(std::size_t begin, Index corner) const { return corners_.face(ofPoints_.corners[begin + corner]); }
    Index root(Index i)
    {
        while (umbrellas_[i] != i) i = umbrellas_[i] = umbrellas_[umbrellas_[i]];
        return i;
    }
    void countEdge(std::size_t uses, std::size_t out, Index face, Counts& counts)
    {
        ++counts.edges;
        if (uses == 1) ++counts.boundary;
        if (uses == 2 && out != 1) ++counts.misoriented;
        if (uses > 2) ++counts.nonManifold;
        if (2 * out != uses) faces_.unbalanced[face].store(true, std::memory_order_relaxed);
    }

    const HalfEdges& corners_;
    const CornersOfPoints& ofPoints_;
    FaceFacts& faces_;
    std::vector<IncidentEdge> incidentEdges_;
    std::vector<Index> umbrellas_; // a union-find over the vertex's corners
};

} // namespace

bool MeshTopology::isCycle() const
{
    return faces > 0 && std::find(componentIsCycle.begin(), componentIsCycle.end(), 0) == componentIsCycle.end();
}

long MeshTopology::eulerCharacteristic() const
{
    return static_cast<long>(vertices) - static_cast<long>(edges) + static_cast<long>(faces);
}

MeshTopology analyzeTopology(const Mesh& mesh, Interrupter* interrupter)
{
    const HalfEdges corners(mesh);
    const CornersOfPoints ofPoints(corners, mesh.points.size(), interrupter);
    FaceFacts faces(faceCount(mesh));
    throwIfInterrupted(interrupter);

    const auto examine = [&](const tbb::blocked_range<std::size_t>& range, Counts counts) {
        VertexExaminer examiner(corners, ofPoints, faces);
        for (std::size_t vertex = range.begin(); vertex < range.end(); ++vertex) {
            throwIfInterrupted(interrupter); // each time: a vertex may have any number of corners
            examiner.examine(static_cast<Index>(vertex), counts);
        }
        return counts;
    };
    const tbb::blocked_range<std::size_t> all(0, mesh.points.size(), 4096);
    const Counts counts = detail::parallelReduce(all, Counts(), examine, std::plus<>());

    MeshTopology result;
    result.faces = faceCount(mesh);
    result.vertices = counts.vertices;
    result.edges = counts.edges;
    result.boundaryEdges = counts.boundary;
    result.nonManifoldEdges = counts.nonManifold;
    result.misorientedEdges = counts.misoriented;
    result.nonManifoldVertices = counts.nonManifoldVertices;
    result.faceComponent.resize(result.faces);
    detail::Asker ask(interrupter);
    for (Index face = 0; face < result.faces; ++face) {
        ask();
        const Index first = faces.sets.find(face); // the root is the component's first face: numbered before the others
        if (first == face) {
            result.faceComponent[face] = static_cast<Index>(result.componentIsCycle.size());
            result.componentIsCycle.push_back(1);
        } else {
            result.faceComponent[face] = result.faceComponent[first];
        }
    }
    for (Index face = 0; face < result.faces; ++face) {
        if (faces.unbalanced[face]) result.componentIsCycle[result.faceComponent[face]] = 0;
    }
    return result;
}

} // namespace vdbcage
