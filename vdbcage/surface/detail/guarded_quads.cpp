// Based on: Cohen-Steiner and Morvan, "Restricted Delaunay Triangulations and Normal Cycle", 2003 (curvature tensors
// from dihedral angles, for the directions that quads follow); Edmonds, "Paths, Trees, and Flowers", 1965 (paths that
// alternate between pairs and none).
// Differs: a pair must also pass the guard, which pushes vertices; so pairs are taken greedily and paths are short.

#include <vdbcage/surface/detail/guarded_quads.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <tuple>
#include <utility>
#include <vector>

#include <openvdb/math/Mat3.h>
#include <vdbcage/surface/detail/quad_shape.h>

namespace vdbcage::detail {

namespace {

using openvdb::Mat3d;

Vec3d areaNormal(const Corners& t)
{
    return (t[1] - t[0]).cross(t[2] - t[0]);
}

/// Two faces that share an edge.
struct Pair {
    double score; ///< in degrees, less is better
    std::uint32_t f, g;
};

/// How the surface bends around each vertex: for each edge its direction squared, by its length and dihedral angle.
std::vector<Mat3d> curvatureTensors(const GuardedSurface& surface)
{
    std::vector<Mat3d> tensors(surface.vertices(), Mat3d::zero());
    const auto add = [&](std::uint32_t v, const Vec3d& edge, const Vec3d& m, const Vec3d& n) {
        const double length = edge.length();
        if (!(length > 0)) return;
        const double bend = std::atan2(m.cross(n).dot(edge) / length, m.dot(n)) / length;
        for (int k = 0; k < 3; ++k) {
            for (int l = 0; l < 3; ++l) tensors[v][k][l] += bend * edge[k] * edge[l];
        }
    };
    for (std::uint32_t v = 0; v < surface.vertices(); ++v) {
        for (const std::uint32_t f : surface.facesOf(v)) {
            for (const std::uint32_t g : surface.facesOf(v)) {
                if (g <= f) continue;
                const Vec3I &s = surface.face(f), &t = surface.face(g);
                for (int i = 0; i < 3; ++i) {
                    for (int j = 0; j < 3; ++j) {
                        if (s[i] != t[(j + 1) % 3] || s[(i + 1) % 3] != t[j]) continue;
                        const Vec3d edge = surface.point(s[(i + 1) % 3]) - surface.point(s[i]);
                        add(v, edge, areaNormal(surface.corners(f)), areaNormal(surface.corners(g)));
                    }
                }
            }
        }
        if (!surface.isOnPlane(v)) continue;
        // The other half adds the mirror image of these edges, and both meet in edges on the plane.
        const int across = surface.guard().symmetry()->axis;
        for (int k = 0; k < 3; ++k) {
            for (int l = 0; l < 3; ++l) tensors[v][k][l] *= (k == across) == (l == across) ? 2 : 0;
        }
        for (const std::uint32_t f : surface.facesOf(v)) {
            const Vec3I& t = surface.face(f);
            for (int i = 0; i < 3; ++i) {
                const std::uint32_t a = t[i], b = t[(i + 1) % 3];
                if ((a != v && b != v) || !surface.isOnPlane(a) || !surface.isOnPlane(b)) continue;
                const Vec3d normal = areaNormal(surface.corners(f));
                Vec3d image = normal;
                image[across] = -image[across];
                add(v, surface.point(b) - surface.point(a), normal, image);
            }
        }
    }
    return tensors;
}

/// How far a quad's sides are from the directions of curvature: 0 if along them or if there are none, up to 1.
double misalignment(const std::array<Vec3d, 4>& corners, const Mat3d& tensor)
{
    Vec3d x = corners[2] - corners[0];
    Vec3d normal = x.cross(corners[3] - corners[1]);
    if (!normal.normalize(0) || !x.normalize(0)) return 0;
    const Vec3d y = normal.cross(x);
    const double xx = x.dot(tensor * x), xy = x.dot(tensor * y), yy = y.dot(tensor * y);
    const double spread = std::hypot(xx - yy, 2 * xy), sum = std::abs(xx + yy);
    if (!(spread > 0)) return 0;
    const double direction = 0.5 * std::atan2(2 * xy, xx - yy);
    double misaligned = 0, lengths = 0;
    for (std::size_t i = 0; i < 4; ++i) {
        const Vec3d side = corners[(i + 1) % 4] - corners[i];
        const double length = side.length();
        const double sine = std::sin(2 * (std::atan2(side.dot(y), side.dot(x)) - direction));
        misaligned += length * sine * sine;
        lengths += length;
    }
    return misaligned / lengths * spread / std::max(spread, sum);
}

class Pairing {
public:
    Pairing(GuardedSurface& surface, double mergeAngleDegrees, Interrupter* interrupter)
        : surface_(surface), mergeAngle_(mergeAngleDegrees), interrupter_(interrupter),
          neighbours_(surface.faces(), {Fan::none, Fan::none, Fan::none})
    {
        const std::vector<Mat3d> tensors = curvatureTensors(surface);
        for (std::uint32_t v = 0; v < surface.vertices(); ++v) {
            for (const std::uint32_t f : surface.facesOf(v)) {
                if (surface.face(f)[0] != v) continue; // each face once
                for (int i = 0; i < 3; ++i) {
                    const std::uint32_t g = across(f, i);
                    neighbours_[f][static_cast<std::size_t>(i)] = g;
                    if (f < g) addPair(f, g, tensors);
                }
            }
        }
        std::sort(pairs_.begin(), pairs_.end(), [](const Pair& a, const Pair& b) {
            return std::tie(a.score, a.f, a.g) < std::tie(b.score, b.f, b.g);
        });
    }

    void pairGreedily()
    {
        for (const Pair& pair : pairs_) {
            throwIfInterrupted(interrupter_);
            if (isFree(pair.f) && isFree(pair.g)) makeQuad(pair.f, pair.g);
        }
    }

    /// Pairs up free faces by taking pairs on the way between them apart.
    void pairMore()
    {
        constexpr std::size_t longest = 5; // pairs made on a path
        for (std::uint32_t f = 0; f < neighbours_.size(); ++f) {
            if (!isFace(f)) continue;
            for (std::size_t most = 1; most <= longest && isFree(f); ++most) {
                throwIfInterrupted(interrupter_);
                int tries = 0;
                std::vector<std::uint32_t> path{f};
                extend(path, most, tries);
            }
        }
    }

private:
    bool isFace(std::uint32_t f) const { return neighbours_[f][0] != Fan::none; }
    bool isFree(std::uint32_t f) const { return surface_.otherHalf(f) == Fan::none; }

    /// The face across side i of f; f itself, if that side is on the plane of symmetry.
    std::uint32_t across(std::uint32_t f, int i) const
    {
        const std::uint32_t a = surface_.face(f)[i], b = surface_.face(f)[(i + 1) % 3];
        for (const std::uint32_t g : surface_.facesOf(a)) {
            const Vec3I& t = surface_.face(g);
            for (int j = 0; j < 3; ++j) {
                if (t[j] == b && t[(j + 1) % 3] == a) return g;
            }
        }
        return f;
    }

    std::array<Vec3d, 4> cornersOf(std::uint32_t f, std::uint32_t g) const
    {
        const Vec4I ids = surface_.quadOf(f, g);
        return {surface_.point(ids[0]), surface_.point(ids[1]), surface_.point(ids[2]), surface_.point(ids[3])};
    }

    /// Whether the guard may get a quad out of two faces by pushing.
    bool isPromising(std::uint32_t f, std::uint32_t g, double& angle, double& deviation) const
    {
        constexpr double mostFlattened = 2.5;
        angle = angleDegrees(areaNormal(surface_.corners(f)), areaNormal(surface_.corners(g)));
        return angle <= mostFlattened * mergeAngle_ && isConvexQuad(cornersOf(f, g), 0, deviation);
    }

    void addPair(std::uint32_t f, std::uint32_t g, const std::vector<Mat3d>& tensors)
    {
        constexpr double alignmentDegrees = 45;
        double angle, deviation;
        const auto corners = cornersOf(f, g);
        if (!isPromising(f, g, angle, deviation)) return;
        const Vec4I ids = surface_.quadOf(f, g);
        const Mat3d tensor = tensors[ids[0]] + tensors[ids[1]] + tensors[ids[2]] + tensors[ids[3]];
        pairs_.push_back({angle + deviation + alignmentDegrees * misalignment(corners, tensor), f, g});
    }

    /// A face and its other half have one number.
    std::uint32_t polygon(std::uint32_t f) const
    {
        const std::uint32_t g = surface_.otherHalf(f);
        return g == Fan::none ? f : std::min(f, g);
    }

    /// Whether the polygons around a quad would be four, and the ends of its diagonal keep three edges.
    bool fits(std::uint32_t f, std::uint32_t g) const
    {
        std::vector<std::uint32_t> around;
        for (const std::uint32_t half : {f, g}) {
            for (const std::uint32_t h : neighbours_[half]) {
                if (h == half) {
                    around.push_back(Fan::none); // across the plane of symmetry, its own image
                } else if (h != f && h != g) {
                    around.push_back(polygon(h));
                }
            }
        }
        std::sort(around.begin(), around.end());
        if (around.size() != 4 || std::adjacent_find(around.begin(), around.end()) != around.end()) return false;
        const Vec4I ids = surface_.quadOf(f, g);
        for (const int end : {0, 2}) {
            std::set<std::uint32_t> polygons;
            for (const std::uint32_t h : surface_.facesOf(ids[end])) polygons.insert(polygon(h));
            const std::size_t sides = surface_.isOnPlane(ids[end]) ? 2 : 1;
            if (sides * (polygons.size() - 1) < 3) return false; // one less afterwards
        }
        return true;
    }

    /// Makes a quad of two free faces, if need be by pushing the ends of the lower diagonal outward.
    bool makeQuad(std::uint32_t f, std::uint32_t g)
    {
        if (!fits(f, g)) return false;
        if (surface_.makeQuad(f, g)) return true;
        const Vec4I ids = surface_.quadOf(f, g);
        const auto corners = cornersOf(f, g);
        Vec3d outward = (corners[2] - corners[0]).cross(corners[3] - corners[1]);
        if (!outward.normalize(0)) return false;
        const double height = outward.dot(corners[0] - corners[1]); // of the first diagonal above the other
        const std::size_t end = height > 0 ? 1 : 0;
        const auto vertex = [&](std::size_t i) { return ids[static_cast<int>(i)]; };
        for (const double share : {0.25, 0.5, 0.75, 1.0}) {
            // Where the diagonals almost meet, more than rounding takes away.
            const Vec3d push = share * (std::abs(height) + surface_.guard().clearance()) * outward;
            if (!moveBy(vertex(end), push)) continue;
            if (moveBy(vertex(end + 2), push)) {
                if (surface_.makeQuad(f, g)) return true;
                surface_.apply(surface_.fanOf(vertex(end + 2)), corners[end + 2]);
            }
            surface_.apply(surface_.fanOf(vertex(end)), corners[end]);
        }
        return false;
    }

    bool moveBy(std::uint32_t v, const Vec3d& by)
    {
        const Fan fan = surface_.fanOf(v);
        const Vec3d target = surface_.rounded(fan, surface_.point(v) + by);
        if (!surface_.allows(fan, target)) return false;
        surface_.apply(fan, target);
        return true;
    }

    /// Looks for ways on from the end of a path free, half, other half, half, other half, ... to another free face, and
    /// takes the first that the guard allows. Returns whether the search is over.
    bool extend(std::vector<std::uint32_t>& path, std::size_t most, int& tries)
    {
        constexpr int mostTries = 40;
        const std::uint32_t end = path.back();
        for (const std::uint32_t next : neighbours_[end]) {
            if (std::find(path.begin(), path.end(), next) != path.end()) continue;
            double angle, deviation;
            if (!isPromising(end, next, angle, deviation)) continue;
            const std::uint32_t half = surface_.otherHalf(next);
            path.push_back(next);
            if (half == Fan::none) {
                if (path.size() == 2 * most && (exchange(path) || ++tries >= mostTries)) return true;
            } else if (path.size() < 2 * most) {
                path.push_back(half);
                if (extend(path, most, tries)) return true;
                path.pop_back();
            }
            path.pop_back();
        }
        return false;
    }

    bool exchange(const std::vector<std::uint32_t>& path)
    {
        GuardedSurface before = surface_;
        for (std::size_t i = 1; i + 1 < path.size(); i += 2) surface_.splitQuad(path[i]);
        for (std::size_t i = 0; i < path.size(); i += 2) {
            if (makeQuad(path[i], path[i + 1])) continue;
            surface_ = std::move(before);
            return false;
        }
        return true;
    }

    GuardedSurface& surface_;
    double mergeAngle_;
    Interrupter* interrupter_;
    std::vector<std::array<std::uint32_t, 3>> neighbours_; // by face, across its sides
    std::vector<Pair> pairs_;
};

} // namespace

void pairUp(GuardedSurface& surface, double mergeAngleDegrees, Interrupter* interrupter)
{
    surface.limitQuadFold(mergeAngleDegrees);
    Pairing pairing(surface, mergeAngleDegrees, interrupter);
    pairing.pairGreedily();
    pairing.pairMore();
}

} // namespace vdbcage::detail
