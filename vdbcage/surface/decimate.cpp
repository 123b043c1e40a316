// Based on: Garland, Heckbert, Surface Simplification Using Quadric Error Metrics, SIGGRAPH 1997.
// Differs: area-weighted; a small spread term evens out flat ground (see geometry/quadric.h); the shape of the
// triangles enters the cost; the heap is lazy: its costs are lower bounds, and the true cost is computed when its turn
// comes.
#include <vdbcage/surface/decimate.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <queue>

#include <tbb/blocked_range.h>
#include <vdbcage/core/detail/parallel.h>
#include <vdbcage/geometry/quadric.h>
#include <vdbcage/mesh/detail/open_mesh.h>

namespace vdbcage {

namespace {

using detail::OpenTriMesh;
using detail::Quadric;
using openvdb::Vec3d;
using Vertex = OpenTriMesh::VertexHandle;
using HalfEdge = OpenTriMesh::HalfedgeHandle;
using Edge = OpenTriMesh::EdgeHandle;

constexpr double spreadWeight = 2e-3; // of the spread beside the planes, in the cost
constexpr double stiffness = 1e-3;    // below this the planes leave a direction open
constexpr double boundaryWeight = 10; // of the planes that keep a boundary in place
constexpr double goodQuality = 0.5;   // triangles at least this good cost nothing extra
constexpr unsigned goodValence = 8;   // so do vertices of at most this valence

/// The limits of a collapse for the triangles around it. Each level is tried until no collapse is allowed.
struct Limits {
    double quality; ///< a triangle may not become worse than this, unless it was worse before
    double turn;    ///< least cosine between a triangle's normal before and after
    double fold;    ///< least cosine between the normals of neighbours after, unless it was less before
};
constexpr std::array<Limits, 4> levels = {
    {{0.1, 0.2, -0.8}, {0.02, 0.1, -0.9}, {1e-3, 0.0, -0.95}, {1e-9, -1.0, -1.0}}};

/// Returns 1 for an equilateral triangle, 0 for one without area; `doubledArea` is the length of the cross product.
double quality(const Vec3d& a, const Vec3d& b, const Vec3d& c, double doubledArea)
{
    const double edges = (b - a).lengthSqr() + (c - b).lengthSqr() + (a - c).lengthSqr();
    return edges > 0 ? 2 * std::sqrt(3.0) * doubledArea / edges : 0;
}

/// The least cosine between the normals of each triangle and the next of a star.
struct Fold {
    double sharpest = 1;

    void add(const Vec3d& normal, double length)
    {
        if (!(length > 0)) return;
        if (lastLength_ > 0) sharpest = std::min(sharpest, normal.dot(last_) / (length * lastLength_));
        if (!(firstLength_ > 0)) {
            first_ = normal;
            firstLength_ = length;
        }
        last_ = normal;
        lastLength_ = length;
    }
    void restart() { lastLength_ = 0; } // the next triangle does not share an edge with the last
    void close() { add(first_, firstLength_); }

private:
    Vec3d first_{0.0}, last_{0.0};
    double firstLength_ = 0, lastLength_ = 0;
};

/// A collapse of an edge: its two ends become one vertex at `place`.
struct Collapse {
    HalfEdge halfEdge; // its origin is removed, its target stays
    Vec3d place{0.0};
    double cost = 0;
};

class Decimation {
public:
    Decimation(const Mesh& surface, Interrupter* interrupter);
    void reduceTo(std::size_t faces);
    Mesh result() const { return detail::fromOpenMesh(mesh_); }

private:
    enum class State : std::uint8_t {
        bounded, // its entry in the queue is a lower bound of its cost
        priced,  // its entry in the queue is its cost, until something near it changes
        blocked, // not in the queue until something near it changes
    };
    struct Entry {
        double cost;
        std::uint32_t edge, version;
        bool operator<(const Entry& other) const // std::priority_queue has the largest on top
        {
            return cost != other.cost ? cost > other.cost : edge > other.edge;
        }
    };

    void addQuadrics(Quadric& sum, HalfEdge outgoing) const;
    void initQuadrics(Interrupter* interrupter);
    void initQueue(Interrupter* interrupter);
    void enqueue(Edge edge, double cost, State state);
    void reconsider(Edge edge);
    bool lowerBound(Edge edge, Collapse& optimum) const;
    bool keepsTopology(HalfEdge halfEdge);
    bool price(Collapse& collapse, bool hasOptimum);
    bool allowed(Collapse& collapse, const Quadric& sum) const;
    bool shapeAround(HalfEdge halfEdge, const Vec3d& place, double& worstBefore, double& worstAfter) const;
    void apply(const Collapse& collapse);

    Quadric quadric(HalfEdge halfEdge) const
    {
        Quadric sum = quadrics_[index(mesh_.from_vertex_handle(halfEdge))];
        return sum += quadrics_[index(mesh_.to_vertex_handle(halfEdge))];
    }
    /// Calls visit(half-edge) for those that leave the same vertex as `first`, counter-clockwise from there.
    template <typename Visit>
    void forEachOutgoing(HalfEdge first, const Visit& visit) const
    {
        HalfEdge outgoing = first;
        do {
            visit(outgoing);
            outgoing = mesh_.opposite_halfedge_handle(mesh_.prev_halfedge_handle(outgoing));
        } while (outgoing != first);
    }
    template <typename Visit>
    void forEachOutgoing(Vertex vertex, const Visit& visit) const
    {
        if (!mesh_.is_isolated(vertex)) forEachOutgoing(mesh_.halfedge_handle(vertex), visit);
    }
    const Vec3d& at(Vertex vertex) const { return places_[index(vertex)]; }
    template <typename Handle>
    static std::size_t index(Handle handle)
    {
        return std::size_t(handle.idx());
    }

    Interrupter* interrupter_;
    OpenTriMesh mesh_;
    std::size_t faces_;
    Vec3d centre_; // the coordinates below are (point - centre_) / scale_
    double scale_;
    std::vector<Vec3d> places_;
    std::vector<Quadric> quadrics_;
    std::vector<unsigned> valences_;
    std::vector<std::size_t> marks_; // of vertices, by the last of `mark_`
    std::size_t mark_ = 0;
    std::vector<double> bounds_;          // of edges: lower bounds of their cost
    std::vector<State> states_;           // of edges
    std::vector<std::uint32_t> versions_; // of edges: an entry of another version is void
    std::priority_queue<Entry> queue_;
    std::size_t level_ = 0;
};

Decimation::Decimation(const Mesh& surface, Interrupter* interrupter)
    : interrupter_(interrupter), mesh_(detail::toOpenMesh(surface)), faces_(mesh_.n_faces())
{
    const openvdb::BBoxd box = boundingBox(surface);
    centre_ = box.min() + (box.max() - box.min()) * 0.5;
    const Vec3d sides = box.max() - box.min();
    scale_ = std::max({sides.x(), sides.y(), sides.z()});
    if (!std::isfinite(scale_))
        throw InputError("the surface to decimate", "its coordinates are too large to subtract");
    places_.reserve(surface.points.size());
    for (const Vec3d& point : surface.points) places_.push_back((point - centre_) / scale_);
    marks_.assign(places_.size(), 0);
    for (const auto vertex : mesh_.vertices()) valences_.push_back(mesh_.valence(vertex));
    initQuadrics(interrupter);
    initQueue(interrupter);
}

/// Adds the quadrics of the face on the left of the half-edge to its origin; at a boundary, those of the boundary.
void Decimation::addQuadrics(Quadric& sum, HalfEdge outgoing) const
{
    const Vec3d& p = at(mesh_.from_vertex_handle(outgoing));
    if (!mesh_.is_boundary(outgoing)) {
        const Vec3d& a = at(mesh_.to_vertex_handle(outgoing));
        const Vec3d& b = at(mesh_.to_vertex_handle(mesh_.next_halfedge_handle(outgoing)));
        const Vec3d normal = (a - p).cross(b - p);
        const double area = normal.length() / 2;
        if (area > 0) {
            sum.addPlane(normal / (2 * area), p, area / 3);
            sum.addSpread(p, area / 3);
        }
        return;
    }
    // Both boundary edges at the vertex hold it by the plane through them, perpendicular to their face.
    for (const HalfEdge side : {outgoing, mesh_.prev_halfedge_handle(outgoing)}) {
        const HalfEdge inner = mesh_.opposite_halfedge_handle(side);
        const Vec3d& start = at(mesh_.from_vertex_handle(inner));
        const Vec3d along = at(mesh_.to_vertex_handle(inner)) - start;
        const Vec3d& apex = at(mesh_.to_vertex_handle(mesh_.next_halfedge_handle(inner)));
        Vec3d upright = along.cross((apex - start).cross(along));
        if (upright.normalize(0)) sum.addPlane(upright, start, boundaryWeight * along.lengthSqr());
    }
}

void Decimation::initQuadrics(Interrupter* interrupter)
{
    quadrics_.resize(places_.size());
    // Each vertex sums up alone, in the order of its star: the same sums for any number of threads.
    detail::parallelFor(tbb::blocked_range<std::size_t>(0, places_.size(), 1024), [&](const auto& range) {
        throwIfInterrupted(interrupter, 0);
        for (std::size_t i = range.begin(); i != range.end(); ++i) {
            forEachOutgoing(Vertex(int(i)), [&](HalfEdge outgoing) { addQuadrics(quadrics_[i], outgoing); });
        }
    });
}

/// Finds the least cost that the edge can have, and its place; returns false if there is no such place.
bool Decimation::lowerBound(Edge edge, Collapse& optimum) const
{
    optimum.halfEdge = mesh_.halfedge_handle(edge, 0);
    const Quadric sum = quadric(optimum.halfEdge);
    if (!sum.bestPlace(stiffness, optimum.place)) return false;
    optimum.cost = sum.cost(optimum.place, spreadWeight);
    return true;
}

void Decimation::initQueue(Interrupter* interrupter)
{
    std::vector<Entry> entries(mesh_.n_edges());
    bounds_.resize(entries.size());
    detail::parallelFor(tbb::blocked_range<std::size_t>(0, entries.size(), 1024), [&](const auto& range) {
        throwIfInterrupted(interrupter, 0);
        for (std::size_t i = range.begin(); i != range.end(); ++i) {
            Collapse optimum;
            lowerBound(Edge(int(i)), optimum);
            bounds_[i] = optimum.cost;
            entries[i] = {optimum.cost, std::uint32_t(i), 0};
        }
    });
    states_.assign(entries.size(), State::bounded);
    versions_.assign(entries.size(), 0);
    queue_ = std::priority_queue<Entry>(std::less<Entry>(), std::move(entries));
}

void Decimation::reconsider(Edge edge)
{
    if (states_[index(edge)] != State::bounded) enqueue(edge, bounds_[index(edge)], State::bounded);
}

void Decimation::enqueue(Edge edge, double cost, State state)
{
    states_[index(edge)] = state;
    queue_.push({cost, std::uint32_t(edge.idx()), ++versions_[index(edge)]});
}

/// Tests the link condition: the collapse leaves a 2-manifold of the same topology.
bool Decimation::keepsTopology(HalfEdge halfEdge)
{
    const Vertex origin = mesh_.from_vertex_handle(halfEdge), target = mesh_.to_vertex_handle(halfEdge);
    unsigned common = 0, sides = 0;
    ++mark_;
    forEachOutgoing(origin, [&](HalfEdge outgoing) { marks_[index(mesh_.to_vertex_handle(outgoing))] = mark_; });
    forEachOutgoing(target,
                    [&](HalfEdge outgoing) { common += marks_[index(mesh_.to_vertex_handle(outgoing))] == mark_; });
    for (const HalfEdge side : {halfEdge, mesh_.opposite_halfedge_handle(halfEdge)}) {
        if (mesh_.is_boundary(side)) continue;
        ++sides;
        // The apex loses an edge. A tetrahedron, or a triangle at the boundary, would fold up.
        const Vertex apex = mesh_.to_vertex_handle(mesh_.next_halfedge_handle(side));
        if (valences_[index(apex)] <= (mesh_.is_boundary(apex) ? 2U : 3U)) return false;
    }
    return common == sides && (sides == 1 || !mesh_.is_boundary(origin) || !mesh_.is_boundary(target));
}

/// Finds the worst quality of the triangles that a collapse changes, before and after it. Returns false if one turns,
/// folds or degenerates more than the level permits.
bool Decimation::shapeAround(HalfEdge halfEdge, const Vec3d& place, double& worstBefore, double& worstAfter) const
{
    const Limits& limits = levels[level_];
    worstBefore = worstAfter = 1;
    bool good = true;
    // Goes around the origin from one apex of the edge to the other, and back around the target. This is the order of
    // the triangles in the star that the collapse makes, so each shares an edge with the one before.
    Fold incidentEdgesBefore, incidentEdgesAfter;
    for (const HalfEdge first : {halfEdge, mesh_.opposite_halfedge_handle(halfEdge)}) {
        const Vertex other = mesh_.to_vertex_handle(first);
        const Vec3d& p = at(mesh_.from_vertex_handle(first));
        forEachOutgoing(first, [&](HalfEdge outgoing) {
            if (!good) return;
            if (mesh_.is_boundary(outgoing)) {
                incidentEdgesBefore.restart();
                incidentEdgesAfter.restart();
                return;
            }
            const HalfEdge link = mesh_.next_halfedge_handle(outgoing);
            const Vertex left = mesh_.to_vertex_handle(outgoing), right = mesh_.to_vertex_handle(link);
            const Vec3d &a = at(left), &b = at(right);
            const Vec3d before = (a - p).cross(b - p);
            const double areaBefore = before.length();
            incidentEdgesBefore.add(before, areaBefore);
            if (left == other || right == other) return; // this one vanishes
            const Vec3d after = (a - place).cross(b - place);
            const double areaAfter = after.length();
            incidentEdgesAfter.add(after, areaAfter);
            const double qualityBefore = quality(p, a, b, areaBefore), qualityAfter = quality(place, a, b, areaAfter);
            worstBefore = std::min(worstBefore, qualityBefore);
            worstAfter = std::min(worstAfter, qualityAfter);
            good = before.dot(after) >= limits.turn * areaBefore * areaAfter &&
                   (qualityAfter >= limits.quality || qualityAfter > qualityBefore);
            // The neighbour across the link stays; the triangle must not fold onto it.
            const HalfEdge outer = mesh_.opposite_halfedge_handle(link);
            if (!good || mesh_.is_boundary(outer)) return;
            const Vec3d& c = at(mesh_.to_vertex_handle(mesh_.next_halfedge_handle(outer)));
            const Vec3d beyond = (b - c).cross(a - c);
            good = beyond.dot(after) >= limits.fold * beyond.length() * areaAfter ||
                   beyond.dot(after) * areaBefore >= beyond.dot(before) * areaAfter;
        });
        if (!good) return false;
    }
    incidentEdgesAfter.close();
    return incidentEdgesAfter.sharpest >= std::min(limits.fold, incidentEdgesBefore.sharpest);
}

/// Returns whether the collapse to collapse.place is permitted at this level; computes its cost. Every veto belongs
/// here.
bool Decimation::allowed(Collapse& collapse, const Quadric& sum) const
{
    double worstBefore, worstAfter;
    if (!shapeAround(collapse.halfEdge, collapse.place, worstBefore, worstAfter)) return false;
    collapse.cost = sum.cost(collapse.place, spreadWeight);
    if (worstAfter < goodQuality && worstAfter < worstBefore) {
        const double excess = goodQuality / std::max(worstAfter, 1e-3);
        collapse.cost *= excess * excess;
    }
    const unsigned valence = valences_[index(mesh_.from_vertex_handle(collapse.halfEdge))] +
                             valences_[index(mesh_.to_vertex_handle(collapse.halfEdge))] - 4;
    if (valence > goodValence) collapse.cost *= double(valence) / double(goodValence);
    return true;
}

/// Changes an edge's optimum to the cheapest permitted collapse of the edge: there, else in the middle or at an end.
bool Decimation::price(Collapse& collapse, bool hasOptimum)
{
    if (!keepsTopology(collapse.halfEdge)) return false;
    const Quadric sum = quadric(collapse.halfEdge);
    if (hasOptimum && allowed(collapse, sum)) return true;
    bool found = false;
    const Vec3d& a = at(mesh_.from_vertex_handle(collapse.halfEdge));
    const Vec3d& b = at(mesh_.to_vertex_handle(collapse.halfEdge));
    for (const Vec3d& place : {(a + b) * 0.5, a, b}) {
        Collapse candidate{collapse.halfEdge, place, 0};
        if (!allowed(candidate, sum) || (found && candidate.cost >= collapse.cost)) continue;
        collapse = candidate;
        found = true;
    }
    return found;
}

void Decimation::apply(const Collapse& collapse)
{
    const Vertex gone = mesh_.from_vertex_handle(collapse.halfEdge), kept = mesh_.to_vertex_handle(collapse.halfEdge);
    faces_ -= mesh_.is_boundary(mesh_.edge_handle(collapse.halfEdge)) ? 1 : 2;
    for (const HalfEdge side : {collapse.halfEdge, mesh_.opposite_halfedge_handle(collapse.halfEdge)}) {
        if (mesh_.is_boundary(side)) continue;
        --valences_[index(mesh_.to_vertex_handle(mesh_.next_halfedge_handle(side)))];
        --valences_[index(kept)]; // the apex counted twice
    }
    valences_[index(kept)] += valences_[index(gone)] - 2;
    quadrics_[index(kept)] += quadrics_[index(gone)];
    places_[index(kept)] = collapse.place;
    mesh_.set_point(kept, detail::fromVec3d(collapse.place * scale_ + centre_));
    mesh_.collapse(collapse.halfEdge);
    // Bounds of edges near by still hold: quadrics only grow. Priced or blocked ones are tried again.
    forEachOutgoing(kept, [&](HalfEdge edge) {
        forEachOutgoing(mesh_.to_vertex_handle(edge),
                        [&](HalfEdge outgoing) { reconsider(mesh_.edge_handle(outgoing)); });
    });
}

void Decimation::reduceTo(std::size_t faces)
{
    const std::size_t start = faces_;
    for (std::size_t count = 0; faces_ > faces; ++count) {
        if (count % 1024 == 0) {
            throwIfInterrupted(interrupter_, int(100 * (start - faces_) / (start - faces)));
        }
        if (queue_.empty()) {
            if (++level_ == levels.size()) return;
            for (const auto edge : mesh_.edges()) reconsider(edge);
            if (queue_.empty()) return;
        }
        const Entry entry = queue_.top();
        queue_.pop();
        const Edge edge{int(entry.edge)};
        if (versions_[entry.edge] != entry.version || mesh_.status(edge).deleted()) continue;
        // First the bound, which is cheap to update, then the true cost: is it still this edge's turn?
        const auto mustWait = [&](double cost) {
            return cost > entry.cost && !queue_.empty() && cost > queue_.top().cost;
        };
        Collapse collapse;
        const bool hasOptimum = lowerBound(edge, collapse);
        bounds_[entry.edge] = collapse.cost;
        if (mustWait(collapse.cost)) {
            enqueue(edge, collapse.cost, State::bounded);
        } else if (!price(collapse, hasOptimum)) {
            states_[entry.edge] = State::blocked;
        } else if (mustWait(collapse.cost)) {
            enqueue(edge, collapse.cost, State::priced);
        } else {
            apply(collapse);
        }
    }
}

} // namespace

Mesh decimate(const Mesh& surface, const DecimateOptions& options, Interrupter* interrupter)
{
    if (options.faces < 4) {
        throw InputError("decimation", "faces is " + std::to_string(options.faces) + "; it must be at least 4");
    }
    requireUsable(surface, "the surface to decimate");
    Decimation decimation(surface, interrupter);
    decimation.reduceTo(options.faces);
    return decimation.result();
}

} // namespace vdbcage
