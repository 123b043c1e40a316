// Based on: Cohen-Steiner and Morvan, "Restricted Delaunay Triangulations and Normal Cycle", 2003 (curvature tensors
// from dihedral angles, for the directions that quads follow); Edmonds, "Paths, Trees, and Flowers", 1965 (paths that
// alternate between pairs and none); Daniels, Silva, Shepherd, Cohen, "Quadrilateral Mesh Simplification", 2008
// (polychords of quads, polychords; here they begin and end at triangles, and are split). Differs: a pair must also
// pass the guard, which pushes vertices; so pairs are taken greedily and paths are short. On them a quad is split along
// either diagonal, and a path may end in a collapse.

#include <vdbcage/bounding/detail/quad_pairing.h>

#include <vdbcage/bounding/detail/admissible.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <initializer_list>
#include <optional>
#include <set>
#include <tuple>
#include <utility>
#include <vector>

#include <openvdb/math/Mat3.h>
#include <vdbcage/bounding/detail/relax.h>
#include <vdbcage/geometry/quad_shape.h>

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
    double loss;  ///< as Pairing::lossOf
    std::uint32_t f, g;
};

/// How the surface bends around each vertex: for each edge its direction squared, by its length and dihedral angle.
std::vector<Mat3d> curvatureTensors(const GuardedMesh& surface)
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
    Pairing(GuardedMesh& surface, const PairingOptions& options, Interrupter* interrupter)
        : surface_(surface), options_(options), interrupter_(interrupter), distancePerFace_(distancePerFace(surface))
    {
        const std::vector<Mat3d> tensors = curvatureTensors(surface);
        for (const std::uint32_t f : triangles()) {
            for (int i = 0; i < 3; ++i) {
                const std::uint32_t g = across(f, i);
                if (f < g && isFree(g)) addPair(f, g, tensors);
            }
        }
        std::sort(pairs_.begin(), pairs_.end(), [](const Pair& a, const Pair& b) {
            return std::tie(a.score, a.f, a.g) < std::tie(b.score, b.f, b.g);
        });
    }

    /// One face less, the others being as many and as good, takes `distancePerFace_` away: pairs that cost more are
    /// made for the share alone.
    void pairGreedily()
    {
        for (const bool costly : {false, true}) {
            for (const Pair& pair : pairs_) {
                throwIfInterrupted(interrupter_);
                if (costly && isEnough()) return;
                if (costly == (pair.loss > 1) && isFree(pair.f) && isFree(pair.g)) makeQuad(pair.f, pair.g);
            }
        }
    }

    /// Pairs up triangles by taking quads on the way between them apart, as few as will do.
    void pairMore()
    {
        for (const std::uint32_t f : triangles()) {
            for (std::size_t most = 1; most <= options_.reach && isTriangle(f); ++most) {
                if (isEnough()) return;
                search(f, most, End::quad);
            }
        }
    }

    /// Takes triangles away in twos, those with the shortest edges and the nearest to each other first.
    void collapseMore()
    {
        for (std::size_t most = 1; most <= options_.reach; ++most) {
            std::vector<std::pair<double, std::uint32_t>> order;
            for (const std::uint32_t f : triangles()) {
                const Corners t = surface_.corners(f);
                order.emplace_back(
                    std::min({(t[1] - t[0]).lengthSqr(), (t[2] - t[1]).lengthSqr(), (t[0] - t[2]).lengthSqr()}), f);
            }
            std::sort(order.begin(), order.end());
            for (const auto& next : order) {
                if (isEnough()) return;
                if (isTriangle(next.second)) search(next.second, most, End::collapse);
            }
        }
    }

    /// Makes quads of triangles by splitting the polychords of quads between them lengthwise, the shortest first: each
    /// brings a face more for every quad in it. New vertices are joined to nothing yet, so that connectivity is in the
    /// way of none.
    void splitMore()
    {
        for (std::size_t length = 1; length <= 2 * options_.reach; ++length) {
            for (const std::uint32_t f : triangles()) {
                for (int i = 0; i < 3 && isTriangle(f); ++i) {
                    throwIfInterrupted(interrupter_);
                    if (isEnough()) return;
                    const std::optional<Polychord> polychord = polychordFrom(f, i, length);
                    if (polychord && polychord->quads.size() == length) split(*polychord);
                }
            }
        }
    }

private:
    enum class End { quad, collapse }; ///< what is made of the two triangles at the end of a path

    static double distancePerFace(const GuardedMesh& surface)
    {
        constexpr int samplesPerFace = 4;
        const std::size_t faces = surface.liveFaces();
        return integratedDistance(surface, areaPerSample(surface, faces, samplesPerFace)) / static_cast<double>(faces);
    }

    /// What the surface encloses: the mean over both diagonals of its quads, and with the half behind the plane of
    /// symmetry, where there is one.
    double volume() const
    {
        const auto& plane = surface_.guard().symmetry();
        const Vec3d apex = plane ? surface_.ontoPlane(Vec3d(0.0)) : Vec3d(0.0);
        const auto below = [&](std::uint32_t f) {
            const Corners t = surface_.corners(f);
            return (t[0] - apex).dot((t[1] - apex).cross(t[2] - apex)) / 6;
        };
        double sum = 0;
        for (std::uint32_t f = 0; f < surface_.faces(); ++f) {
            if (!surface_.isFace(f)) continue;
            sum += surface_.weight(f) * below(f);
            if (isFree(f)) continue;
            for (const std::uint32_t other : surface_.alternatesIn(f)) sum += 0.25 * below(other); // from each half
        }
        return sum;
    }

    /// Whether what was changed since the surface had another volume moved it too far away from the model.
    bool isCostly(double before) const { return volume() - before > options_.mostLoss * distancePerFace_; }

    bool isEnough() const { return quadShare(surface_) >= options_.share; }
    bool isFree(std::uint32_t f) const { return surface_.partnerOf(f) == StarChange::none; }
    bool isTriangle(std::uint32_t f) const { return surface_.isFace(f) && isFree(f); }

    /// The faces that are in no quad.
    std::vector<std::uint32_t> triangles() const
    {
        std::vector<std::uint32_t> list;
        for (std::uint32_t f = 0; f < surface_.faces(); ++f) {
            if (isTriangle(f)) list.push_back(f);
        }
        return list;
    }

    /// The face across side i of a face, or of a quad's other; f itself, if that side is on the plane of symmetry or a
    /// diagonal of an other.
    std::uint32_t across(std::uint32_t f, int i) const
    {
        const std::uint32_t next = faceAt(surface_.face(f)[(i + 1) % 3], surface_.face(f)[i]);
        return next == StarChange::none ? f : next;
    }

    /// The side of a face that goes from a to b, or -1.
    int sideOf(std::uint32_t f, std::uint32_t a, std::uint32_t b) const
    {
        const Vec3I& t = surface_.face(f);
        for (int i = 0; i < 3; ++i) {
            if (t[i] == a && t[(i + 1) % 3] == b) return i;
        }
        return -1;
    }

    std::array<Vec3d, 4> cornersOf(std::uint32_t f, std::uint32_t g) const
    {
        const Vec4I ids = surface_.quadOf(f, g);
        return {surface_.point(ids[0]), surface_.point(ids[1]), surface_.point(ids[2]), surface_.point(ids[3])};
    }

    /// What the surface moves away from the model, at least, to bound under both diagonals: the volume between them,
    /// in parts of `distancePerFace_`.
    double lossOf(const std::array<Vec3d, 4>& corners) const
    {
        const Vec3d both = (corners[2] - corners[0]).cross(corners[3] - corners[1]);
        return std::abs(both.dot(corners[0] - corners[1])) / 6 / distancePerFace_;
    }

    /// Whether the guard may get a quad out of two faces by pushing.
    bool isPromising(std::uint32_t f, std::uint32_t g, double& angle, double& deviation) const
    {
        constexpr double mostFlattened = 2.5;
        angle = angleDegrees(areaNormal(surface_.corners(f)), areaNormal(surface_.corners(g)));
        return angle <= mostFlattened * options_.mergeAngleDegrees && isConvexQuad(cornersOf(f, g), 0, deviation);
    }

    void addPair(std::uint32_t f, std::uint32_t g, const std::vector<Mat3d>& tensors)
    {
        constexpr double alignmentDegrees = 45, lossDegrees = 30;
        double angle, deviation;
        const auto corners = cornersOf(f, g);
        if (!isPromising(f, g, angle, deviation)) return;
        const Vec4I ids = surface_.quadOf(f, g);
        const Mat3d tensor = tensors[ids[0]] + tensors[ids[1]] + tensors[ids[2]] + tensors[ids[3]];
        const double loss = lossOf(corners);
        pairs_.push_back(
            {angle + deviation + alignmentDegrees * misalignment(corners, tensor) + lossDegrees * loss, loss, f, g});
    }

    /// A face and its other half have one number.
    std::uint32_t polygon(std::uint32_t f) const
    {
        const std::uint32_t g = surface_.partnerOf(f);
        return g == StarChange::none ? f : std::min(f, g);
    }

    /// Whether the polygons around a quad would be four, and the ends of its diagonal keep three edges.
    bool fits(std::uint32_t f, std::uint32_t g) const
    {
        std::vector<std::uint32_t> around;
        for (const std::uint32_t half : {f, g}) {
            for (int i = 0; i < 3; ++i) {
                const std::uint32_t h = across(half, i);
                if (h == half) {
                    around.push_back(StarChange::none); // across the plane of symmetry, its own image
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
        if (detail::makeQuad(surface_, f, g)) return true;
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
                if (detail::makeQuad(surface_, f, g)) return true;
                surface_.apply(starOf(surface_, vertex(end + 2)), corners[end + 2]);
            }
            surface_.apply(starOf(surface_, vertex(end)), corners[end]);
        }
        return false;
    }

    bool moveBy(std::uint32_t v, const Vec3d& by)
    {
        const StarChange star = starOf(surface_, v);
        const Vec3d target = rounded(surface_, star, surface_.point(v) + by);
        if (!allows(surface_, star, target)) return false;
        surface_.apply(star, target);
        return true;
    }

    void search(std::uint32_t f, std::size_t most, End last)
    {
        throwIfInterrupted(interrupter_);
        int tries = 0;
        std::vector<std::uint32_t> path{f};
        extend(path, most, last, tries);
    }

    /// Looks for ways on from the end of a path to another triangle, and takes the first that the guard allows. A path
    /// is a triangle, then for each quad on the way the half, or other, that is paired with what is before it and the
    /// one left over, then a triangle; 2 `most` faces in all. Returns whether the search is over.
    bool extend(std::vector<std::uint32_t>& path, std::size_t most, End last, int& tries)
    {
        constexpr int mostTries = 40;
        const std::uint32_t end = path.back();
        for (int i = 0; i < 3; ++i) {
            const std::uint32_t a = surface_.face(end)[i], b = surface_.face(end)[(i + 1) % 3];
            const std::uint32_t next = across(end, i);
            if (next == end || isOnPath(path, next)) continue;
            double angle, deviation;
            if (isFree(next)) {
                if (path.size() + 1 < 2 * most) continue;
                if (last == End::quad && !isPromising(end, next, angle, deviation)) continue;
                path.push_back(next);
                if (repair(path, last) || ++tries >= mostTries) return true;
                path.pop_back();
                continue;
            }
            if (path.size() + 1 >= 2 * most) continue;
            const auto& alternates = surface_.alternatesIn(next);
            const std::uint32_t other = alternates[sideOf(alternates[0], b, a) >= 0 ? 0 : 1];
            for (const std::uint32_t half : {next, other}) {
                if (!isPromising(end, half, angle, deviation)) continue;
                path.push_back(half);
                path.push_back(surface_.partnerOf(half));
                if (extend(path, most, last, tries)) return true;
                path.resize(path.size() - 2);
            }
        }
        return false;
    }

    bool isOnPath(const std::vector<std::uint32_t>& path, std::uint32_t f) const
    {
        const bool isFree = this->isFree(f);
        return std::any_of(path.begin(), path.end(), [&](std::uint32_t g) {
            if (g == f) return true;
            if (isFree || this->isFree(g)) return false;
            const auto& alternates = surface_.alternatesIn(f);
            return g == surface_.partnerOf(f) || g == alternates[0] || g == alternates[1];
        });
    }

    bool repair(const std::vector<std::uint32_t>& path, End last)
    {
        GuardedMesh before = surface_;
        const double volumeBefore = volume();
        for (std::size_t i = 1; i + 1 < path.size(); i += 2) {
            if (!surface_.isFace(path[i])) surface_.flipQuad(path[i]);
            surface_.splitQuad(path[i]);
        }
        bool isDone = true;
        for (std::size_t i = 0; isDone && i < path.size(); i += 2) {
            const bool isLast = i + 2 == path.size();
            isDone = isLast && last == End::collapse ? collapse(path[i], path[i + 1]) : makeQuad(path[i], path[i + 1]);
        }
        if (isDone && !isCostly(volumeBefore)) return true;
        surface_ = std::move(before);
        return false;
    }

    /// Collapses the edge between two triangles; all quads stay, or the surface is left in pieces of what it was.
    bool collapse(std::uint32_t f, std::uint32_t g)
    {
        const Vec4I ids = surface_.quadOf(f, g);
        const std::uint32_t keep = std::min(ids[0], ids[2]), remove = std::max(ids[0], ids[2]);
        const std::vector<std::array<std::uint32_t, 2>> quads = splitQuadsAt({keep, remove});
        StarChange star;
        if (!starOfCollapse(surface_, keep, remove, star)) return false;
        const Vec3d a = surface_.point(keep), b = surface_.point(remove), middle = 0.5 * (a + b);
        const Vec3d up = outward(surface_, star) * (a - b).length();
        const GuardedMesh before = surface_;
        for (const Vec3d& at :
             {middle, a, b, middle + 0.1 * up, a + 0.1 * up, b + 0.1 * up, middle + 0.3 * up, middle + 0.6 * up}) {
            const Vec3d place = rounded(surface_, star, at);
            if (!allows(surface_, star, place)) continue;
            surface_.apply(star, place);
            if (std::all_of(quads.begin(), quads.end(), [&](const auto& quad) { return makeQuad(quad[0], quad[1]); })) {
                return true;
            }
            surface_ = before;
        }
        return false;
    }

    /// Returns their faces.
    std::vector<std::array<std::uint32_t, 2>> splitQuadsAt(std::initializer_list<std::uint32_t> vertices)
    {
        std::vector<std::array<std::uint32_t, 2>> quads;
        for (const std::uint32_t v : vertices) {
            for (const std::uint32_t f : surface_.facesOf(v)) {
                if (isFree(f)) continue;
                quads.push_back({f, surface_.partnerOf(f)});
                surface_.splitQuad(f);
            }
        }
        return quads;
    }

    /// Quads in a row, each left across the side opposite to the one that it is entered across, from a triangle to
    /// another or to the plane of symmetry. Every side of a triangle begins one; both ways it is the same.
    struct Polychord {
        std::vector<std::array<std::uint32_t, 2>> sides; ///< those crossed, in the direction of the face before them
        std::vector<std::array<std::uint32_t, 2>> quads; ///< their faces
    };

    /// The polychord that begins across side i of a triangle, if it has no more than so many quads, all different, and
    /// does not come back.
    std::optional<Polychord> polychordFrom(std::uint32_t f, int i, std::size_t most) const
    {
        Polychord polychord{{{surface_.face(f)[i], surface_.face(f)[(i + 1) % 3]}}, {}};
        std::set<std::uint32_t> passed{f};
        for (;;) {
            const auto [a, b] = polychord.sides.back();
            const std::uint32_t next = faceAt(b, a);
            if (next == StarChange::none) return polychord; // the plane
            if (!passed.insert(polygon(next)).second) return std::nullopt;
            if (isFree(next)) return polychord;
            if (polychord.quads.size() == most) return std::nullopt;
            const std::uint32_t other = surface_.partnerOf(next);
            const Vec4I ids = surface_.quadOf(next, other);
            int side = 0;
            while (ids[side] != b) ++side;
            polychord.quads.push_back({next, other});
            polychord.sides.push_back({ids[(side + 2) % 4], ids[(side + 3) % 4]});
        }
    }

    /// Puts a vertex on every side that a polychord crosses: each quad becomes two, and the triangles at the ends
    /// become quads, with a corner pushed out. Returns whether the guard allows it, and it is not costly; else nothing
    /// changes.
    bool split(const Polychord& polychord)
    {
        const GuardedMesh before = surface_;
        const double volumeBefore = volume();
        for (const double push : {0.3, 0.6, 1.0}) { // corners of 147, 118, and 90 degrees
            if (split(polychord, push) && !isCostly(volumeBefore)) return true;
            surface_ = before;
        }
        return false;
    }

    /// The same with one push; leaves pieces where it fails.
    bool split(const Polychord& polychord, double push)
    {
        for (const auto& quad : polychord.quads) surface_.splitQuad(quad[0]);
        for (std::size_t i = 0; i < polychord.sides.size(); ++i) {
            const auto [a, b] = polychord.sides[i];
            const std::uint32_t behind = faceAt(a, b), ahead = faceAt(b, a);
            const bool isFirst = i == 0, isLast = i == polychord.quads.size(), onPlane = ahead == StarChange::none;
            // The new vertex takes the place of what is before the side and all of the face after it.
            StarChange::Faces faces{behind};
            if (!isLast) {
                faces.insert(faces.end(), polychord.quads[i].begin(), polychord.quads[i].end());
            } else if (!onPlane) {
                faces.push_back(ahead);
            }
            Vec3d at = 0.5 * (surface_.point(a) + surface_.point(b));
            if (isFirst) at += push * asideOf(behind, ahead, a, b);
            if (isLast && !onPlane) at += push * asideOf(ahead, behind, b, a);
            const std::uint32_t first = cornerAcross(behind, a, b);
            const std::uint32_t last = onPlane ? StarChange::none : cornerAcross(ahead, b, a);
            StarChange star;
            if (!starOfFaces(surface_, faces, onPlane, star)) return false;
            if (!place(star, at, (surface_.point(a) - surface_.point(b)).length())) return false;
            if (isFirst) {
                if (!makeQuad(faceAt(b, first), faceAt(first, a))) return false;
            } else {
                const auto [c, d] = polychord.sides[i - 1];
                if (!makeQuad(faceAt(c, a), faceAt(a, star.centre))) return false;
                if (!makeQuad(faceAt(star.centre, b), faceAt(b, d))) return false;
            }
            if (isLast && !onPlane && !makeQuad(faceAt(a, last), faceAt(last, b))) return false;
        }
        return true;
    }

    /// Makes the change near a place, as little above it as the guard allows, in parts of `length`.
    bool place(const StarChange& star, const Vec3d& at, double length)
    {
        const Vec3d up = length * outward(surface_, star);
        for (const double height : {0.0, 0.03, 0.1, 0.3}) {
            const Vec3d target = rounded(surface_, star, at + height * up);
            if (!allows(surface_, star, target)) continue;
            surface_.apply(star, target);
            return true;
        }
        return false;
    }

    /// The face with a side from a to b, or StarChange::none.
    std::uint32_t faceAt(std::uint32_t a, std::uint32_t b) const
    {
        for (const std::uint32_t f : surface_.facesOf(a)) {
            if (sideOf(f, a, b) >= 0) return f;
        }
        return StarChange::none;
    }

    std::uint32_t cornerAcross(std::uint32_t f, std::uint32_t a, std::uint32_t b) const
    {
        return surface_.face(f)[(sideOf(f, a, b) + 2) % 3];
    }

    /// From a face's side, from a to b, away from the face, half as far as the side is long: between the two faces'
    /// planes where they meet in a ridge, along the next one in a valley.
    Vec3d asideOf(std::uint32_t f, std::uint32_t next, std::uint32_t a, std::uint32_t b) const
    {
        const Vec3d along = surface_.point(b) - surface_.point(a);
        const Vec3d normal = areaNormal(surface_.corners(next));
        Vec3d over = along.cross(areaNormal(surface_.corners(f))), into = along.cross(normal);
        if (!over.normalize(0) || !into.normalize(0)) return Vec3d(0.0);
        Vec3d direction = over.dot(normal) > 0 ? over + into : into;
        if (!direction.normalize(0)) return Vec3d(0.0);
        return 0.5 * along.length() * direction;
    }

    GuardedMesh& surface_;
    PairingOptions options_;
    Interrupter* interrupter_;
    double distancePerFace_;
    std::vector<Pair> pairs_;
};

} // namespace

double quadShare(const GuardedMesh& surface)
{
    const auto faces = static_cast<double>(surface.liveFaces() - surface.quads());
    return faces > 0 ? static_cast<double>(surface.quads()) / faces : 1;
}

void pairUp(GuardedMesh& surface, const PairingOptions& options, Interrupter* interrupter)
{
    if (surface.liveFaces() == 0) return;
    surface.limitQuadFold(options.mergeAngleDegrees);
    Pairing pairing(surface, options, interrupter);
    pairing.pairGreedily();
    pairing.pairMore();
    if (options.collapses) pairing.collapseMore();
    if (options.splits) pairing.splitMore();
}

} // namespace vdbcage::detail
