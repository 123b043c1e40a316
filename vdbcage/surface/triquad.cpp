// Greedy pairing, best pairs first; what makes a pair good or impossible is stated in the functions below.
#include <vdbcage/surface/triquad.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <tuple>

#include <vdbcage/geometry/quad_shape.h>

namespace vdbcage {

namespace {

using openvdb::Index32;
using openvdb::Vec3d;
using openvdb::Vec3I;
using openvdb::Vec4I;

constexpr double angleRoundingDegrees = 1e-6;
constexpr std::size_t none = std::numeric_limits<std::size_t>::max();

/// One side of a face: from corner a to corner b. Sides are numbered face by face: 3 t + i for triangles, then quads.
struct Side {
    Index32 a, b;
    std::size_t face;
};

/// Who meets whom across which edge.
class Adjacency {
public:
    explicit Adjacency(const Mesh& mesh) : valence_(mesh.points.size(), 0), least_(mesh.points.size(), 3)
    {
        for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
            const Vec3I& face = mesh.triangles[t];
            for (int i = 0; i < 3; ++i) sides_.push_back({face[i], face[(i + 1) % 3], t});
        }
        for (std::size_t q = 0; q < mesh.quads.size(); ++q) {
            const Vec4I& face = mesh.quads[q];
            for (int i = 0; i < 4; ++i) sides_.push_back({face[i], face[(i + 1) % 4], mesh.triangles.size() + q});
        }
        std::vector<std::size_t> order(sides_.size());
        for (std::size_t s = 0; s < order.size(); ++s) order[s] = s;
        const auto ends = [&](std::size_t s) { return std::minmax(sides_[s].a, sides_[s].b); };
        std::sort(order.begin(), order.end(), [&](std::size_t s, std::size_t t) {
            return std::make_tuple(ends(s).first, ends(s).second, s) <
                   std::make_tuple(ends(t).first, ends(t).second, t);
        });
        opposite_.assign(sides_.size(), none);
        for (std::size_t i = 0; i < order.size();) {
            std::size_t end = i + 1;
            while (end < order.size() && ends(order[end]) == ends(order[i])) ++end;
            const Side& side = sides_[order[i]];
            ++valence_[side.a];
            ++valence_[side.b];
            if (end == i + 2 && side.a == sides_[order[i + 1]].b) {
                opposite_[order[i]] = order[i + 1];
                opposite_[order[i + 1]] = order[i];
            } else {
                least_[side.a] = least_[side.b] = 2; // at a boundary a corner of a single quad is fine
            }
            i = end;
        }
    }

    const Side& side(std::size_t s) const { return sides_[s]; }
    std::size_t opposite(std::size_t s) const { return opposite_[s]; }
    bool canLoseEdge(Index32 point) const { return valence_[point] > least_[point]; }
    void loseEdge(Index32 point) { --valence_[point]; }

private:
    std::vector<Side> sides_;
    std::vector<std::size_t> opposite_; // `none` at a boundary or where it is not a 2-manifold
    std::vector<unsigned> valence_;     // edges of each point
    std::vector<unsigned> least_;       // the fewest that it may be left with
};

/// The two triangles on the sides s and t of an edge as one quad.
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
        const auto apex = [&](std::size_t side) { return mesh.triangles[side / 3][int((side + 2) % 3)]; };
        const Vec4I quad(adjacency.side(s).a, apex(t), adjacency.side(s).b, apex(s));
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
    // A face is known by its first triangle; quads of the input follow the triangles.
    const auto faceOf = [&](std::size_t side) {
        const std::size_t face = adjacency.side(side).face;
        return face < partner.size() && partner[face] != none ? std::min(face, partner[face]) : face;
    };
    for (const Pair& pair : findPairs(triangles, adjacency, options.mergeAngleDegrees)) {
        const std::size_t first = pair.s / 3, second = pair.t / 3;
        if (partner[first] != none || partner[second] != none) continue;
        if (!adjacency.canLoseEdge(pair.quad[0]) || !adjacency.canLoseEdge(pair.quad[2])) continue;
        // The quad's four edges must lead to four different faces.
        std::vector<std::size_t> neighbours;
        for (const std::size_t side : {pair.s, pair.t}) {
            for (const std::size_t step : {1U, 2U}) {
                const std::size_t across = adjacency.opposite(3 * (side / 3) + (side + step) % 3);
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
