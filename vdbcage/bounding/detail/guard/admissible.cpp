#include <vdbcage/bounding/detail/guard/admissible.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include <vdbcage/bounding/detail/guard/face_queries.h>
#include <vdbcage/geometry/quad_shape.h>
#include <vdbcage/geometry/triangle_pair.h>

namespace vdbcage::detail {

namespace {

Box grown(const Box& box, double by)
{
    return {box.lo - Vec3d(by), box.hi + Vec3d(by)};
}

bool isOld(const StarChange& star, std::uint32_t face)
{
    return std::find(star.oldFaces.begin(), star.oldFaces.end(), face) != star.oldFaces.end();
}

bool areConvexQuads(const GuardedMesh& mesh, const StarChange& star, const Vec3d& p)
{
    for (std::size_t i = star.link.size() - star.alternates; i < star.link.size(); ++i) {
        const Vec4I ids = mesh.quadOf(star.keptFaces[i]);
        std::array<Vec3d, 4> places;
        for (int k = 0; k < 4; ++k)
            places[static_cast<std::size_t>(k)] = ids[k] == star.centre ? p : mesh.point(ids[k]);
        double deviation;
        if (!isConvexQuad(places, mesh.leastQuadCosine(), deviation)) return false;
    }
    return true;
}

bool wellShaped(const GuardedMesh& mesh, const StarChange& star, const Vec3d& p)
{
    if (!areConvexQuads(mesh, star, p)) return false;
    double least = 1;
    for (std::size_t i = 0; i < star.link.size(); ++i) least = std::min(least, minSine(starCorners(mesh, star, i, p)));
    if (least >= mesh.guard().minSine()) return true;
    double before = 1;
    for (const std::uint32_t f : star.oldFaces) before = std::min(before, minSine(mesh.corners(f)));
    if (!(least >= before)) return false;
    for (std::size_t i = 0; i < star.link.size(); ++i) {
        if (hasNoArea(starCorners(mesh, star, i, p))) return false;
    }
    return true;
}

/// A star with its centre at some place: its triangles, each with the box that other triangles must keep out of.
struct PlacedStar {
    PlacedStar(const GuardedMesh& surface, const StarChange& placed, const Vec3d& p) : star(placed), all(Box::of(p))
    {
        const Spacing& spacing = surface.guard().spacing();
        for (std::size_t i = 0; i < star.link.size(); ++i) {
            triangles.emplace_back(Vec3I(star.centre, star.link[i][0], star.link[i][1]),
                                   starCorners(surface, star, i, p));
            boxes.push_back(grown(Box::of(triangles.back().corners), spacing.around(triangles.back().longestEdge())));
            all.expand(boxes.back());
        }
    }

    const StarChange& star;
    SurfaceTriangles triangles;
    boost::container::small_vector<Box, 16> boxes;
    Box all;
};

bool isTooNear(const GuardedMesh& mesh, const PlacedStar& placed, std::uint32_t face, const Box& box)
{
    const auto meets = [&](const Box& other) { return other.meets(box); };
    if (std::none_of(placed.boxes.begin(), placed.boxes.end(), meets) || isOld(placed.star, face)) return false;
    const SurfaceTriangle other(mesh.face(face), mesh.corners(face));
    for (std::size_t i = 0; i < placed.triangles.size(); ++i) {
        if (!placed.boxes[i].meets(box) || mesh.areAlternatives(placed.star.keptFaces[i], face)) continue;
        if (tooNear(placed.triangles[i], other, mesh.guard().spacing())) return true;
    }
    return false;
}

bool clearOfSurface(const GuardedMesh& mesh, const StarChange& star, const Vec3d& p)
{
    const Spacing& spacing = mesh.guard().spacing();
    const PlacedStar placed(mesh, star, p);
    const SurfaceTriangles& triangles = placed.triangles;
    if (star.alternates > 0 || star.onPlane || !spreadOut(triangles, spacing, mesh.guard().minSine())) {
        for (std::size_t i = 0; i < triangles.size(); ++i) {
            for (std::size_t j = i + 1; j < triangles.size(); ++j) {
                if (star.alternates > 0 && mesh.areAlternatives(star.keptFaces[i], star.keptFaces[j])) continue;
                if (tooNear(triangles[i], triangles[j], spacing)) return false;
            }
        }
    }
    return mesh.tree().forEachOverlap(
        placed.all, [&](std::uint32_t face, const Box& box) { return !isTooNear(mesh, placed, face, box); });
}

double spacingAround(const GuardedMesh& mesh, const StarChange& star, const Vec3d& p)
{
    double longest2 = 0;
    for (const auto& edge : star.link) longest2 = std::max(longest2, (mesh.point(edge[0]) - p).lengthSqr());
    return mesh.guard().spacing().around(std::sqrt(longest2));
}

bool isTooNearPlane(const GuardedMesh& mesh, const StarChange& star, const Vec3d& p)
{
    const auto& plane = mesh.guard().symmetry();
    if (!plane) return false;
    // Half of the spacing between a face and its mirror image.
    const double distance = 0.5 * spacingAround(mesh, star, p), sine = 0.5 * mesh.guard().spacing().sine;
    const auto height = [&](const Vec3d& q) { return q[plane->axis] - plane->offset; };
    if (star.onPlane ? height(p) != 0 : !(height(p) >= distance && height(p) > 0)) return true;
    for (const auto& edge : star.link) {
        for (const std::uint32_t v : edge) {
            if (mesh.isOnPlane(v) == star.onPlane) continue;
            const Vec3d& q = mesh.point(v);
            if (std::abs(height(p) - height(q)) < sine * (p - q).length()) return true;
        }
    }
    return false;
}

bool sweepsOverNothing(const GuardedMesh& mesh, const StarChange& star, const Vec3d& p)
{
    Box box = Box::of(p);
    for (const auto& edge : star.link) {
        for (const std::uint32_t v : edge) box.expand(Box::of(mesh.point(v)));
    }
    if (star.centre < mesh.vertices()) box.expand(Box::of(mesh.point(star.centre)));
    if (star.removed != StarChange::none) box.expand(Box::of(mesh.point(star.removed)));
    const auto image = [&](const Corners& t) {
        return Corners{mesh.guard().mirrored(t[0]), mesh.guard().mirrored(t[2]), mesh.guard().mirrored(t[1])};
    };
    if (star.onPlane) {
        for (const Vec3d& corner : {box.lo, box.hi}) box.expand(Box::of(mesh.guard().mirrored(corner)));
    }
    if (!mesh.guard().mayHoldPart(box)) return true;
    const auto mayCut = [&](std::uint32_t f) { return mesh.mayCut(f); };
    if (std::any_of(star.oldFaces.begin(), star.oldFaces.end(), mayCut)) return true;
    // The surface with every quad split by its diagonal, then by the alternate one. Parts of the model touch neither,
    // so one inside both is inside for every choice of diagonals.
    for (const bool hidesAlternates : {true, false}) {
        std::vector<Corners> surface;
        const auto shows = [&](std::uint32_t f) { return !mesh.isInQuad(f) || mesh.isFace(f) == hidesAlternates; };
        for (std::size_t i = 0; i < star.link.size(); ++i) {
            if (shows(star.keptFaces[i])) surface.push_back(starCorners(mesh, star, i, p));
        }
        for (const std::uint32_t f : star.oldFaces) {
            const Corners t = mesh.corners(f);
            if (shows(f)) surface.push_back({t[0], t[2], t[1]});
        }
        if (star.onPlane) {
            const std::size_t half = surface.size();
            for (std::size_t i = 0; i < half; ++i) surface.push_back(image(surface[i]));
        }
        if (mesh.guard().swept(surface, box)) return false;
        if (star.alternates == 0) break;
    }
    return true;
}

} // namespace

bool allows(const GuardedMesh& mesh, const StarChange& star, const Vec3d& p, Obstacle* obstacle)
{
    Obstacle none;
    Obstacle& found = obstacle ? *obstacle : none;
    found.clear = 0;
    const MoveLimit* limit = mesh.limitOf(star.centre);
    if ((limit && !limit->allows(p)) || mesh.limitOf(star.removed)) return false;
    if (isTooNearPlane(mesh, star, p)) return false;
    if (!wellShaped(mesh, star, p)) return false;
    for (; found.clear < star.link.size(); ++found.clear) {
        if (mesh.mayCut(star.keptFaces[found.clear])) continue;
        if (!mesh.guard().clear(starCorners(mesh, star, found.clear, p), found.item, &found.item)) return false;
    }
    if (!clearOfSurface(mesh, star, p)) return false;
    return sweepsOverNothing(mesh, star, p);
}

void contacts(const GuardedMesh& mesh, const StarChange& star, const Vec3d& from, const Vec3d& to, Obstacle obstacle,
              std::vector<HalfSpace>& halfSpaces)
{
    constexpr int mostGaps = 6; // of each triangle; others show up in the next try if they matter
    // A little more than the clearance, so that rounding leaves the next try on the right side.
    const double clearance = 1.01 * mesh.guard().clearance();
    const Spacing& spacing = mesh.guard().spacing();
    const MoveLimit* limit = mesh.limitOf(star.centre);
    if (limit) addReach(*limit, to, halfSpaces);
    for (std::size_t i = 0; i < star.link.size(); ++i) {
        const Corners now = starCorners(mesh, star, i, from), then = starCorners(mesh, star, i, to);
        const bool isBlocked = i >= obstacle.clear && !mesh.mayCut(star.keptFaces[i]) &&
                               !mesh.guard().clear(then, obstacle.item, &obstacle.item);
        if (isBlocked && !addImpacts(mesh.guard(), now, to, i == 0, clearance, halfSpaces)) {
            int gaps = 0;
            mesh.guard().forEachBlocker(then, [&](const Corners& other) {
                addApproach(then, other, to, clearance, halfSpaces);
                return ++gaps < mostGaps;
            });
        }
        const SurfaceTriangle triangle(Vec3I(star.centre, star.link[i][0], star.link[i][1]), then);
        mesh.tree().forEachOverlap(
            grown(Box::of(then), spacing.around(triangle.longestEdge())), [&](std::uint32_t face, const Box& /*box*/) {
                if (isOld(star, face)) return true;
                for (const int corner : {0, 1, 2}) {
                    if (mesh.face(face)[corner] == triangle.ids[1] || mesh.face(face)[corner] == triangle.ids[2])
                        return true;
                }
                const SurfaceTriangle other(mesh.face(face), mesh.corners(face));
                if (tooNear(triangle, other, spacing)) {
                    addApproach(now, other.corners, from, 1.01 * distanceBetween(triangle, other, spacing), halfSpaces);
                }
                return true;
            });
    }
    for (int axis = 0; limit && axis < 3; ++axis) {
        if (!limit->mayMove[static_cast<std::size_t>(axis)]) restrictToPlane(axis, limit->home[axis], halfSpaces);
    }
    if (!mesh.guard().symmetry()) return;
    const auto [axis, offset] = *mesh.guard().symmetry();
    if (star.onPlane) {
        restrictToPlane(axis, offset, halfSpaces);
    } else if (isTooNearPlane(mesh, star, to)) {
        Vec3d across(0.0);
        across[axis] = 1;
        halfSpaces.push_back({across, offset + 0.505 * spacingAround(mesh, star, to)});
    }
}

bool makeQuad(GuardedMesh& mesh, std::uint32_t f, std::uint32_t g)
{
    const Vec4I ids = mesh.quadOf(f, g);
    if (ids[1] == ids[3] || (mesh.isOnPlane(ids[1]) && mesh.isOnPlane(ids[3]))) return false;
    // Two corners joined by an edge elsewhere would share two edges once the quad is split between them.
    const auto joined = mesh.neighbours(ids[1]);
    if (std::binary_search(joined.begin(), joined.end(), ids[3])) return false;
    const std::array<Vec3d, 4> places = pointsOf(mesh, ids);
    double deviation;
    if (!isConvexQuad(places, mesh.leastQuadCosine(), deviation)) return false;
    const std::array<SurfaceTriangle, 2> triangles{
        SurfaceTriangle(Vec3I(ids[0], ids[1], ids[3]), {places[0], places[1], places[3]}),
        SurfaceTriangle(Vec3I(ids[1], ids[2], ids[3]), {places[1], places[2], places[3]})};
    Box all = Box::of(places[0]);
    const bool mayCut = mesh.mayCut(f) || mesh.mayCut(g);
    for (const SurfaceTriangle& triangle : triangles) {
        if (hasNoArea(triangle.corners) || minSine(triangle.corners) < mesh.guard().minSine()) return false;
        if (!mayCut && !mesh.guard().clear(triangle.corners, TriangleBvh::none, nullptr)) return false;
        all.expand(Box::of(triangle.corners));
    }
    const Spacing& spacing = mesh.guard().spacing();
    if (tooNear(triangles[0], triangles[1], spacing)) return false;
    const bool isFree =
        mesh.tree().forEachOverlap(grown(all, spacing.distance), [&](std::uint32_t face, const Box& /*box*/) {
            if (face == f || face == g) return true;
            const SurfaceTriangle near(mesh.face(face), mesh.corners(face));
            return !tooNear(triangles[0], near, spacing) && !tooNear(triangles[1], near, spacing);
        });
    if (!isFree) return false;
    if (!mayCut && mesh.guard().mayHoldPart(all)) {
        const Corners s = mesh.corners(f), t = mesh.corners(g);
        if (mesh.guard().swept({triangles[0].corners, triangles[1].corners, {s[0], s[2], s[1]}, {t[0], t[2], t[1]}},
                               all)) {
            return false;
        }
    }
    mesh.pair(f, g, {triangles[0].ids, triangles[1].ids});
    return true;
}

Batch::~Batch()
{
    mesh_.refit();
}

bool Batch::apply(const StarChange& star, const Vec3d& p)
{
    const auto touched = [&](std::uint32_t v) { return std::binary_search(moved_.begin(), moved_.end(), v); };
    if (touched(star.centre) || (star.removed != StarChange::none && touched(star.removed))) return false;
    Box box = Box::of(p);
    for (const auto& edge : star.link) {
        for (const std::uint32_t v : edge) {
            if (touched(v)) return false;
            box.expand(Box::of(mesh_.point(v)));
        }
    }
    const Box around = grown(box, mesh_.guard().spacing().distance);
    std::optional<PlacedStar> placed;
    for (const Made& made : made_) {
        if (!around.meets(made.box)) continue;
        if (!placed) placed.emplace(mesh_, star, p);
        for (const auto* faces : {&mesh_.facesOf(made.centre), &mesh_.alternatesOf(made.centre)}) {
            for (const std::uint32_t f : *faces) {
                if (isTooNear(mesh_, *placed, f, Box::of(mesh_.corners(f)))) return false;
            }
        }
    }
    mesh_.change(star, p);
    for (const std::uint32_t v : {star.centre, star.removed}) {
        if (v != StarChange::none) moved_.insert(std::lower_bound(moved_.begin(), moved_.end(), v), v);
    }
    made_.push_back({box, star.centre});
    return true;
}

bool applyNear(GuardedMesh& mesh, const StarChange& star, const Vec3d& place, double length,
               const std::array<double, 4>& heights)
{
    const Vec3d up = length * outward(mesh, star);
    for (const double height : heights) {
        const Vec3d target = rounded(mesh, star, place + height * up);
        if (!allows(mesh, star, target)) continue;
        mesh.apply(star, target);
        return true;
    }
    return false;
}

} // namespace vdbcage::detail
