// Greedy pairing, best pairs first; the functions below define good and impossible pairs.
#include <vdbcage/surface/triquad.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <tuple>

#include <vdbcage/geometry/quad_shape.h>
#include <vdbcage/mesh/detail/half_edges.h>

namespace vdbcage {

namespace {

using openvdb::Index32;
using openvdb::Vec3d;
using openvdb::Vec3I;
using openvdb::Vec4I;

constexpr double angleRoundingDegrees = 1e-6;
constexpr std::size_t none = detail::EdgeTable::none;

/// The faces across each edge, and the number of edges that a point may still lose.
class Adjacency {
public:
    explicit Adjacency(const Mesh& mesh)
        : halfEdges_(mesh), edges_(halfEdges_, mesh.points.size()), valence_(mesh.points.size(), 0),
          least_(mesh.points.size(), 3)
    {
        for (std::size_t edge = 0; edge < edges_.size(); ++edge) {
            const std::size_t h = edges_[edge][0];
            for (const Index32 end : {halfEdges_.from(h), halfEdges_.to(h)}) {
                ++valence_[end];
                if (opposite(h) == none) least_[end] = 2; // at a boundary a corner of a single quad is fine
            }
        }
    }

    const detail::HalfEdges& halfEdges() const { return halfEdges_; }
    /// Returns the opposite half-edge; `none` at a boundary or where the mesh is not an oriented 2-manifold.
    std::size_t opposite(std::size_t h) const { return edges_.opposite(h); }
    bool canLoseEdge(Index32 point) const { return valence_[point] > least_[point]; }
    void loseEdge(Index32 point) { --valence_[point]; }

private:
    detail::HalfEdges halfEdges_;
    detail::EdgeTable edges_;
    std::vector<unsigned> valence_; // edges of each point
    std::vector<unsigned> least_;   // the fewest that it may keep
};

/// The two triangles on the half-edges s and t of an edge as one quad.
struct Pair {
    double score; ///< in degrees, less is better
    std::size_t s, t;
    Vec4I quad;
};

std::vector<Pair> findPairs(const Mesh& mesh, const Adjacency& adjacency, double mergeAngleDegrees)
{
    std::vector<Pair> pairs;
    const std::size_t sides = 3 * mesh.triangles.size();
    for (std::size_t s = 0; s < sides; ++s) {
        const std::size_t t = adjacency.opposite(s);
        if (t == none || t < s || t >= sides) continue;
        // The edge runs from corner 0 to corner 2 of the quad; the triangle of side t is on its left.
        const detail::HalfEdges& halfEdges = adjacency.halfEdges();
        const Vec4I quad(halfEdges.from(s), halfEdges.before(t), halfEdges.to(s), halfEdges.before(s));
        if (quad[1] == quad[3]) continue;
        std::array<Vec3d, 4> corners;
        for (int i = 0; i < 4; ++i) corners[std::size_t(i)] = mesh.points[quad[i]];
        const Vec3d edge = corners[2] - corners[0];
        const double dihedral =
            detail::angleDegrees((corners[1] - corners[0]).cross(edge), edge.cross(corners[3] - corners[0]));
        double deviation;
        if (!(dihedral <= mergeAngleDegrees + angleRoundingDegrees) || !detail::isConvexQuad(corners, 0, deviation))
            continue;
        pairs.push_back({dihedral + deviation, s, t, quad});
    }
    std::sort(pairs.begin(), pairs.end(),
              [](const Pair& p, const Pair& q) { return std::tie(p.score, p.s) < std::tie(q.score, q.s); });
    return pairs;
}

} // namespace

Mesh triquad(const Mesh& triangles, const TriquadOptions& options)
{
    requireWithin(TriquadOptions::mergeAngles, options.mergeAngleDegrees, "merge angle");
    requireUsable(triangles, "the mesh to merge into quads");

    Adjacency adjacency(triangles);
    Mesh result = triangles;
    std::vector<std::size_t> partner(triangles.triangles.size(), none);
    // A face's number is that of its first triangle; quads of the input follow the triangles.
    const auto faceOf = [&](std::size_t side) {
        const std::size_t face = adjacency.halfEdges().face(side);
        return face < partner.size() && partner[face] != none ? std::min(face, partner[face]) : face;
    };
    for (const Pair& pair : findPairs(triangles, adjacency, options.mergeAngleDegrees)) {
        const std::size_t first = pair.s / 3, second = pair.t / 3;
        if (partner[first] != none || partner[second] != none) continue;
        if (!adjacency.canLoseEdge(pair.quad[0]) || !adjacency.canLoseEdge(pair.quad[2])) continue;
        // The quad's four edges must lead to four different faces.
        std::vector<std::size_t> neighbours;
        for (const std::size_t side : {pair.s, pair.t}) {
            const std::size_t next = adjacency.halfEdges().next(side);
            for (const std::size_t other : {next, adjacency.halfEdges().next(next)}) {
                const std::size_t across = adjacency.opposite(other);
                if (across != none) neighbours.push_back(faceOf(across));
            }
        }
        std::sort(neighbours.begin(), neighbours.end());
        if (std::adjacent_find(neighbours.begin(), neighbours.end()) != neighbours.end()) continue;
        if (std::find_if(neighbours.begin(), neighbours.end(),
                         [&](std::size_t face) { return face == first || face == second; }) != neighbours.end()) {
            continue;
        }
        partner[first] = second;
        partner[second] = first;
        adjacency.loseEdge(pair.quad[0]);
        adjacency.loseEdge(pair.quad[2]);
        result.quads.push_back(pair.quad);
    }
    result.triangles.clear();
    for (std::size_t t = 0; t < partner.size(); ++t) {
        if (partner[t] == none) result.triangles.push_back(triangles.triangles[t]);
    }
    return result;
}

} // namespace vdbcage
