#include <vdbcage/bounding/detail/guarded_mesh.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <stdexcept>

#include <vdbcage/core/error.h>
#include <vdbcage/geometry/triangle_pair.h>
#include <vdbcage/geometry/quad_shape.h>

namespace vdbcage::detail {

namespace {

/// A triangle beginning with its least corner.
Vec3I fromLeast(const Vec3I& t)
{
    if (t[0] < t[1] && t[0] < t[2]) return t;
    return t[1] < t[2] ? Vec3I(t[1], t[2], t[0]) : Vec3I(t[2], t[0], t[1]);
}

Box grown(const Box& box, double by)
{
    return {box.lo - Vec3d(by), box.hi + Vec3d(by)};
}

} // namespace

GuardedMesh::GuardedMesh(const Mesh& surface, const GuardModel& guard, Quads quads)
    : guard_(guard), faces_(triangulate(surface))
{
    points_.reserve(surface.points.size());
    for (const Vec3d& p : surface.points) points_.push_back(guard.rounded(guard.scaled(p)));
    auto firstOfQuads = static_cast<std::uint32_t>(surface.triangles.size());
    if (guard.symmetry()) firstOfQuads = takeHalf(firstOfQuads);
    facesOf_.resize(points_.size());
    alternatesOf_.resize(points_.size());
    life_.assign(faces_.size(), live);
    quadAt_.assign(faces_.size(), StarChange::none);
    liveFaces_ = faces_.size();
    std::vector<Box> boxes;
    boxes.reserve(faces_.size());
    for (std::uint32_t f = 0; f < faces_.size(); ++f) {
        for (int i = 0; i < 3; ++i) facesOf_[faces_[f][i]].push_back(f);
        boxes.push_back(Box::of(corners(f)));
    }
    for (std::uint32_t v = 0; v < points_.size(); ++v) {
        if (!isManifoldAt(v)) {
            throw InputError("surface: it is not a closed, oriented 2-manifold at point " + std::to_string(v));
        }
    }
    tree_ = DynamicBvh(std::move(boxes));
    if (quads == Quads::split) return;
    const std::uint32_t end = faces();
    for (std::uint32_t f = firstOfQuads; f < end; f += 2) makeQuad(f, f + 1);
}

std::uint32_t GuardedMesh::takeHalf(std::uint32_t firstOfQuads)
{
    const int axis = guard().symmetry()->axis;
    const double offset = guard().symmetry()->offset;
    const auto side = [&](std::uint32_t v) { return (points_[v][axis] > offset) - (points_[v][axis] < offset); };
    std::vector<Vec3I> beyond, behind; // the faces
    std::vector<std::uint32_t> used;   // the vertices beyond
    std::uint32_t firstQuad = 0;
    for (std::uint32_t f = 0; f < faces(); ++f) {
        const Vec3I& t = faces_[f];
        const auto [least, most] = std::minmax({side(t[0]), side(t[1]), side(t[2])});
        if (least == most && least == 0) {
            throw InputError("surface: face " + std::to_string(f) + " lies in the plane of symmetry");
        }
        if (least < 0 && most > 0) {
            throw InputError("surface: face " + std::to_string(f) + " lies across the plane of symmetry");
        }
        (most > 0 ? beyond : behind).push_back(t);
        if (most > 0 && f < firstOfQuads) ++firstQuad;
        for (const int i : {0, 1, 2}) {
            if (most > 0 && side(t[i]) > 0) used.push_back(t[i]);
        }
    }
    std::sort(used.begin(), used.end());
    used.erase(std::unique(used.begin(), used.end()), used.end());
    const auto isBefore = [&](std::uint32_t v, std::uint32_t w) { return points_[v] < points_[w]; };
    std::sort(used.begin(), used.end(), isBefore);
    for (Vec3I& t : behind) {
        for (const int i : {0, 1, 2}) {
            if (side(t[i]) == 0) continue;
            const Vec3d image = guard().mirrored(points_[t[i]]);
            const auto found = std::lower_bound(used.begin(), used.end(), image,
                                                [&](std::uint32_t v, const Vec3d& p) { return points_[v] < p; });
            if (found == used.end() || points_[*found] != image) {
                throw InputError("surface: point " + std::to_string(t[i]) + " has no mirror image");
            }
            t[i] = *found;
        }
        t = fromLeast(Vec3I(t[0], t[2], t[1]));
    }
    std::vector<Vec3I> sorted;
    for (const Vec3I& t : beyond) sorted.push_back(fromLeast(t));
    std::sort(sorted.begin(), sorted.end());
    std::sort(behind.begin(), behind.end());
    if (sorted != behind) throw InputError("surface: it is not symmetric: a face has no mirror image");
    faces_ = std::move(beyond);
    return firstQuad;
}

bool GuardedMesh::isManifoldAt(std::uint32_t v) const
{
    // Around each vertex of a closed oriented 2-manifold the link is one cycle; on the plane of symmetry, a path from
    // plane to plane, off it on the way.
    std::map<std::uint32_t, std::uint32_t> next;
    for (const std::uint32_t f : facesOf_[v]) {
        const Vec3I& t = faces_[f];
        const int i = t[0] == v ? 0 : t[1] == v ? 1 : 2;
        next[t[(i + 1) % 3]] = t[(i + 2) % 3];
    }
    if (next.size() != facesOf_[v].size()) return false;
    if (next.empty()) return true;
    std::uint32_t first = next.begin()->first;
    if (isOnPlane(v)) {
        std::size_t starts = 0;
        for (const auto& step : next) {
            if (!isOnPlane(step.first)) continue;
            first = step.first;
            ++starts;
        }
        if (starts != 1 || next.size() < 2) return false;
    }
    std::uint32_t at = first;
    for (std::size_t steps = 1; steps <= next.size(); ++steps) {
        const auto step = next.find(at);
        if (step == next.end()) return false;
        at = step->second;
        if (at == first && steps < next.size()) return false;
    }
    return isOnPlane(v) ? at != first && isOnPlane(at) : at == first;
}

bool GuardedMesh::isOnPlane(std::uint32_t v) const
{
    const auto& plane = guard().symmetry();
    return plane && points_[v][plane->axis] == plane->offset;
}

Vec3d GuardedMesh::ontoPlane(Vec3d p) const
{
    p[guard().symmetry()->axis] = guard().symmetry()->offset;
    return p;
}

Vec3d GuardedMesh::rounded(const StarChange& star, const Vec3d& p) const
{
    return guard().rounded(star.onPlane ? ontoPlane(p) : p);
}

Corners GuardedMesh::corners(std::uint32_t f) const
{
    const Vec3I& t = faces_[f];
    return {points_[t[0]], points_[t[1]], points_[t[2]]};
}

GuardedMesh::Vertices GuardedMesh::neighbours(std::uint32_t v) const
{
    const bool halved = isOnPlane(v); // one of them is the last corner of a face only
    Vertices list;
    for (const std::uint32_t f : facesOf_[v]) {
        const Vec3I& t = faces_[f];
        list.push_back(t[0] == v ? t[1] : t[1] == v ? t[2] : t[0]);
        if (halved) list.push_back(t[0] == v ? t[2] : t[1] == v ? t[0] : t[1]);
    }
    for (const std::uint32_t f : alternatesOf_[v]) {
        for (const int i : {0, 1, 2}) {
            if (faces_[f][i] != v) list.push_back(faces_[f][i]);
        }
    }
    std::sort(list.begin(), list.end());
    if (halved || !alternatesOf_[v].empty()) list.erase(std::unique(list.begin(), list.end()), list.end());
    return list;
}

Vec3d GuardedMesh::outward(const StarChange& star) const
{
    Vec3d normal(0.0);
    for (const std::uint32_t f : star.oldFaces) {
        const Corners t = corners(f);
        normal += (t[1] - t[0]).cross(t[2] - t[0]);
    }
    if (star.onPlane) normal[guard().symmetry()->axis] = 0;
    const double length = normal.length();
    return length > 0 ? normal / length : Vec3d(0.0);
}

Corners GuardedMesh::starCorners(const StarChange& star, std::size_t i, const Vec3d& p) const
{
    return {p, points_[star.link[i][0]], points_[star.link[i][1]]};
}

bool GuardedMesh::isOld(const StarChange& star, std::uint32_t face) const
{
    return std::find(star.oldFaces.begin(), star.oldFaces.end(), face) != star.oldFaces.end();
}

bool GuardedMesh::areAlternatives(std::uint32_t f, std::uint32_t g) const
{
    return f != StarChange::none && quadAt_[f] != StarChange::none && quadAt_[f] == quadAt_[g] && life_[f] != life_[g];
}

bool GuardedMesh::areConvexQuads(const StarChange& star, const Vec3d& p) const
{
    for (std::size_t i = star.link.size() - star.alternates; i < star.link.size(); ++i) {
        const Quad& quad = quads_[quadAt_[star.keptFaces[i]]];
        const Vec4I ids = quadOf(quad.pair[0], quad.pair[1]);
        std::array<Vec3d, 4> places;
        for (int k = 0; k < 4; ++k) places[static_cast<std::size_t>(k)] = ids[k] == star.centre ? p : points_[ids[k]];
        double deviation;
        if (!isConvexQuad(places, leastQuadCosine_, deviation)) return false;
    }
    return true;
}

bool GuardedMesh::wellShaped(const StarChange& star, const Vec3d& p) const
{
    if (!areConvexQuads(star, p)) return false;
    double least = 1;
    for (std::size_t i = 0; i < star.link.size(); ++i) least = std::min(least, minSine(starCorners(star, i, p)));
    if (least >= guard().minSine()) return true;
    double before = 1;
    for (const std::uint32_t f : star.oldFaces) before = std::min(before, minSine(corners(f)));
    if (!(least >= before)) return false;
    for (std::size_t i = 0; i < star.link.size(); ++i) {
        if (hasNoArea(starCorners(star, i, p))) return false;
    }
    return true;
}

/// The triangles of a star with its centre at some place, each with the box that alternates keep out of.
struct GuardedMesh::PlacedStar {
    PlacedStar(const GuardedMesh& surface, const StarChange& placed, const Vec3d& p) : star(placed), all(Box::of(p))
    {
        const Spacing& spacing = surface.guard().spacing();
        for (std::size_t i = 0; i < star.link.size(); ++i) {
            triangles.emplace_back(Vec3I(star.centre, star.link[i][0], star.link[i][1]), surface.starCorners(star, i, p));
            boxes.push_back(grown(Box::of(triangles.back().corners), spacing.around(triangles.back().longestEdge())));
            all.expand(boxes.back());
        }
    }

    const StarChange& star;
    SurfaceTriangles triangles;
    boost::container::small_vector<Box, 16> boxes;
    Box all;
};

bool GuardedMesh::isTooNear(const PlacedStar& placed, std::uint32_t face, const Box& box) const
{
    const auto meets = [&](const Box& other) { return other.meets(box); };
    if (std::none_of(placed.boxes.begin(), placed.boxes.end(), meets) || isOld(placed.star, face)) return false;
    const SurfaceTriangle other(faces_[face], corners(face));
    for (std::size_t i = 0; i < placed.triangles.size(); ++i) {
        if (!placed.boxes[i].meets(box) || areAlternatives(placed.star.keptFaces[i], face)) continue;
        if (tooNear(placed.triangles[i], other, guard().spacing())) return true;
    }
    return false;
}

bool GuardedMesh::clearOfSurface(const StarChange& star, const Vec3d& p) const
{
    const Spacing& spacing = guard().spacing();
    const PlacedStar placed(*this, star, p);
    const SurfaceTriangles& triangles = placed.triangles;
    if (star.alternates > 0 || star.onPlane || !spreadOut(triangles, spacing, guard().minSine())) {
        for (std::size_t i = 0; i < triangles.size(); ++i) {
            for (std::size_t j = i + 1; j < triangles.size(); ++j) {
                if (star.alternates > 0 && areAlternatives(star.keptFaces[i], star.keptFaces[j])) continue;
                if (tooNear(triangles[i], triangles[j], spacing)) return false;
            }
        }
    }
    return tree_.forEachOverlap(placed.all,
                                [&](std::uint32_t face, const Box& box) { return !isTooNear(placed, face, box); });
}

bool GuardedMesh::isTooNearPlane(const StarChange& star, const Vec3d& p) const
{
    const auto& plane = guard().symmetry();
    if (!plane) return false;
    // Half of what is to be between a face and its mirror image.
    const double distance = 0.5 * spacingAround(star, p), sine = 0.5 * guard().spacing().sine;
    const auto height = [&](const Vec3d& q) { return q[plane->axis] - plane->offset; };
    if (star.onPlane ? height(p) != 0 : !(height(p) >= distance && height(p) > 0)) return true;
    for (const auto& edge : star.link) {
        for (const std::uint32_t v : edge) {
            if (isOnPlane(v) == star.onPlane) continue;
            const Vec3d& q = points_[v];
            if (std::abs(height(p) - height(q)) < sine * (p - q).length()) return true;
        }
    }
    return false;
}

double GuardedMesh::spacingAround(const StarChange& star, const Vec3d& p) const
{
    double longest2 = 0;
    for (const auto& edge : star.link) longest2 = std::max(longest2, (points_[edge[0]] - p).lengthSqr());
    return guard().spacing().around(std::sqrt(longest2));
}

bool GuardedMesh::allows(const StarChange& star, const Vec3d& p, Obstacle* obstacle) const
{
    Obstacle none;
    Obstacle& found = obstacle ? *obstacle : none;
    found.clear = 0;
    if (isTooNearPlane(star, p)) return false;
    if (!wellShaped(star, p)) return false;
    for (; found.clear < star.link.size(); ++found.clear) {
        if (!guard().clear(starCorners(star, found.clear, p), found.item, &found.item)) return false;
    }
    if (!clearOfSurface(star, p)) return false;
    return sweepsOverNothing(star, p);
}

bool GuardedMesh::sweepsOverNothing(const StarChange& star, const Vec3d& p) const
{
    Box box = Box::of(p);
    for (const auto& edge : star.link) {
        for (const std::uint32_t v : edge) box.expand(Box::of(points_[v]));
    }
    if (star.centre < vertices()) box.expand(Box::of(points_[star.centre]));
    if (star.removed != StarChange::none) box.expand(Box::of(points_[star.removed]));
    const auto image = [&](const Corners& t) {
        return Corners{guard().mirrored(t[0]), guard().mirrored(t[2]), guard().mirrored(t[1])};
    };
    if (star.onPlane) {
        for (const Vec3d& corner : {box.lo, box.hi}) box.expand(Box::of(guard().mirrored(corner)));
    }
    if (!guard().mayHoldPart(box)) return true;
    // The surface with every quad split by its pair' diagonal, then by the other. Parts of the model touch neither,
    // so that one inside both is inside for every choice of diagonals.
    for (const Life hidden : {alternate, live}) {
        std::vector<Corners> surface;
        const auto shows = [&](std::uint32_t f) {
            return f == StarChange::none || quadAt_[f] == StarChange::none || life_[f] != hidden;
        };
        for (std::size_t i = 0; i < star.link.size(); ++i) {
            if (shows(star.keptFaces[i])) surface.push_back(starCorners(star, i, p));
        }
        for (const std::uint32_t f : star.oldFaces) {
            const Corners t = corners(f);
            if (shows(f)) surface.push_back({t[0], t[2], t[1]});
        }
        if (star.onPlane) {
            const std::size_t half = surface.size();
            for (std::size_t i = 0; i < half; ++i) surface.push_back(image(surface[i]));
        }
        if (guard().swept(surface, box)) return false;
        if (star.alternates == 0) break;
    }
    return true;
}

void GuardedMesh::contacts(const StarChange& star, const Vec3d& from, const Vec3d& to, Obstacle obstacle,
                              std::vector<HalfSpace>& halfSpaces) const
{
    constexpr int mostGaps = 6; // of each triangle; the rest shows up in the next try if it matters
    // A little more than the clearance, so that rounding leaves the next try on the right side.
    const double clearance = 1.01 * guard().clearance();
    const Spacing& spacing = guard().spacing();
    for (std::size_t i = 0; i < star.link.size(); ++i) {
        const Corners now = starCorners(star, i, from), then = starCorners(star, i, to);
        const bool isBlocked = i >= obstacle.clear && !guard().clear(then, obstacle.item, &obstacle.item);
        if (isBlocked && !addImpacts(guard(), now, to, i == 0, clearance, halfSpaces)) {
            int gaps = 0;
            guard().forEachBlocker(then, [&](const Corners& other) {
                addApproach(then, other, to, clearance, halfSpaces);
                return ++gaps < mostGaps;
            });
        }
        const SurfaceTriangle triangle(Vec3I(star.centre, star.link[i][0], star.link[i][1]), then);
        tree_.forEachOverlap(
            grown(Box::of(then), spacing.around(triangle.longestEdge())), [&](std::uint32_t face, const Box& /*box*/) {
                if (isOld(star, face)) return true;
                for (const int corner : {0, 1, 2}) {
                    if (faces_[face][corner] == triangle.ids[1] || faces_[face][corner] == triangle.ids[2]) return true;
                }
                const SurfaceTriangle other(faces_[face], corners(face));
                if (tooNear(triangle, other, spacing)) {
                    addApproach(now, other.corners, from, 1.01 * distanceBetween(triangle, other, spacing), halfSpaces);
                }
                return true;
            });
    }
    if (!guard().symmetry()) return;
    Vec3d across(0.0);
    across[guard().symmetry()->axis] = 1;
    if (!star.onPlane) {
        if (isTooNearPlane(star, to)) {
            halfSpaces.push_back({across, guard().symmetry()->offset + 0.505 * spacingAround(star, to)});
        }
        return;
    }
    // The centre moves in the plane: so do the half-spaces.
    constexpr double leastSine = 1e-6;
    std::size_t kept = 0;
    for (HalfSpace& h : halfSpaces) {
        const double height = h.normal.dot(across);
        const Vec3d normal = h.normal - height * across;
        const double length = normal.length();
        if (!(length > leastSine)) continue;
        halfSpaces[kept++] = {normal / length, (h.offset - height * guard().symmetry()->offset) / length};
    }
    halfSpaces.resize(kept);
}

void GuardedMesh::apply(const StarChange& star, const Vec3d& p)
{
    change(star, p);
    tree_.refit();
}

void GuardedMesh::change(const StarChange& star, const Vec3d& p)
{
    if (star.centre == vertices()) {
        points_.push_back(p);
        facesOf_.emplace_back();
        alternatesOf_.emplace_back();
        reconnect(star);
        return;
    }
    points_[star.centre] = p;
    const bool takesFaceIn = star.oldFaces.size() > facesOf_[star.centre].size() + alternatesOf_[star.centre].size();
    if (star.removed != StarChange::none || takesFaceIn) {
        reconnect(star);
    } else {
        for (const std::uint32_t f : star.keptFaces) tree_.update(f, Box::of(corners(f)));
    }
}

void GuardedMesh::reconnect(const StarChange& star)
{
    for (const std::uint32_t f : star.oldFaces) {
        for (int i = 0; i < 3; ++i) {
            auto& list = facesOf_[faces_[f][i]];
            list.erase(std::find(list.begin(), list.end(), f));
        }
        if (std::find(star.keptFaces.begin(), star.keptFaces.end(), f) != star.keptFaces.end()) continue;
        life_[f] = dead;
        --liveFaces_;
        tree_.remove(f);
    }
    for (std::size_t i = 0; i < star.link.size(); ++i) {
        std::uint32_t f = star.keptFaces[i];
        const bool isNew = f == StarChange::none;
        if (isNew) {
            f = faces();
            faces_.emplace_back();
            life_.push_back(live);
            quadAt_.push_back(StarChange::none);
            ++liveFaces_;
        }
        faces_[f] = Vec3I(star.centre, star.link[i][0], star.link[i][1]);
        for (int k = 0; k < 3; ++k) facesOf_[faces_[f][k]].push_back(f);
        const Box box = Box::of(corners(f));
        if (isNew) {
            tree_.insert(f, box);
        } else {
            tree_.update(f, box);
        }
    }
    tree_.rebuildIfWorthwhile();
}

std::uint32_t GuardedMesh::partnerOf(std::uint32_t f) const
{
    if (quadAt_[f] == StarChange::none) return StarChange::none;
    const Quad& quad = quads_[quadAt_[f]];
    const auto& both = life_[f] == live ? quad.pair : quad.alternates;
    return both[0] == f ? both[1] : both[0];
}

Vec4I GuardedMesh::quadOf(std::uint32_t f, std::uint32_t g) const
{
    const Vec3I &s = faces_[f], &t = faces_[g];
    for (int i = 0; i < 3; ++i) {
        for (int j = 0; j < 3; ++j) {
            if (s[i] == t[(j + 1) % 3] && s[(i + 1) % 3] == t[j]) {
                return {s[i], t[(j + 2) % 3], s[(i + 1) % 3], s[(i + 2) % 3]};
            }
        }
    }
    throw std::logic_error("two faces of a quad share no edge");
}

void GuardedMesh::limitQuadFold(double degrees)
{
    constexpr double radians = 3.14159265358979323846 / 180, rounding = 1e-12;
    leastQuadCosine_ = degrees >= 90 ? 0 : std::cos(degrees * radians) - rounding;
}

bool GuardedMesh::makeQuad(std::uint32_t f, std::uint32_t g)
{
    const Vec4I ids = quadOf(f, g);
    if (ids[1] == ids[3] || (isOnPlane(ids[1]) && isOnPlane(ids[3]))) return false;
    // Two corners joined by an edge elsewhere would share two once the quad is split between them.
    const auto joined = neighbours(ids[1]);
    if (std::binary_search(joined.begin(), joined.end(), ids[3])) return false;
    std::array<Vec3d, 4> places;
    for (int k = 0; k < 4; ++k) places[static_cast<std::size_t>(k)] = points_[ids[k]];
    double deviation;
    if (!isConvexQuad(places, leastQuadCosine_, deviation)) return false;
    const std::array<SurfaceTriangle, 2> triangles{SurfaceTriangle(Vec3I(ids[0], ids[1], ids[3]), {places[0], places[1], places[3]}),
                                      SurfaceTriangle(Vec3I(ids[1], ids[2], ids[3]), {places[1], places[2], places[3]})};
    Box all = Box::of(places[0]);
    for (const SurfaceTriangle& triangle : triangles) {
        if (hasNoArea(triangle.corners) || minSine(triangle.corners) < guard().minSine()) return false;
        if (!guard().clear(triangle.corners, TriangleBvh::none, nullptr)) return false;
        all.expand(Box::of(triangle.corners));
    }
    const Spacing& spacing = guard().spacing();
    if (tooNear(triangles[0], triangles[1], spacing)) return false;
    const bool isFree = tree_.forEachOverlap(grown(all, spacing.distance), [&](std::uint32_t face, const Box& /*box*/) {
        if (face == f || face == g) return true;
        const SurfaceTriangle near(faces_[face], corners(face));
        return !tooNear(triangles[0], near, spacing) && !tooNear(triangles[1], near, spacing);
    });
    if (!isFree) return false;
    if (guard().mayHoldPart(all)) {
        const Corners s = corners(f), t = corners(g);
        if (guard().swept({triangles[0].corners, triangles[1].corners, {s[0], s[2], s[1]}, {t[0], t[2], t[1]}}, all)) {
            return false;
        }
    }
    auto number = static_cast<std::uint32_t>(quads_.size());
    if (freeQuads_.empty()) {
        quads_.emplace_back();
    } else {
        number = freeQuads_.back();
        freeQuads_.pop_back();
    }
    quads_[number] = {{f, g}, {faces(), faces() + 1}};
    quadAt_[f] = quadAt_[g] = number;
    for (const SurfaceTriangle& triangle : triangles) {
        const std::uint32_t o = faces();
        faces_.push_back(triangle.ids);
        life_.push_back(alternate);
        quadAt_.push_back(number);
        for (const int k : {0, 1, 2}) alternatesOf_[triangle.ids[k]].push_back(o);
        tree_.insert(o, Box::of(triangle.corners));
    }
    tree_.rebuildIfWorthwhile();
    return true;
}

void GuardedMesh::splitQuad(std::uint32_t half)
{
    const std::uint32_t number = quadAt_[half];
    const Quad quad = quads_[number];
    for (const std::uint32_t f : quad.pair) quadAt_[f] = StarChange::none;
    for (const std::uint32_t o : quad.alternates) {
        for (const int k : {0, 1, 2}) {
            auto& list = alternatesOf_[faces_[o][k]];
            list.erase(std::find(list.begin(), list.end(), o));
        }
        life_[o] = dead;
        quadAt_[o] = StarChange::none;
        tree_.remove(o);
    }
    freeQuads_.push_back(number);
    tree_.rebuildIfWorthwhile();
    tree_.refit();
}

void GuardedMesh::flipQuad(std::uint32_t half)
{
    Quad& quad = quads_[quadAt_[half]];
    const auto move = [&](std::uint32_t f, std::vector<FaceList>& from, std::vector<FaceList>& to, Life life) {
        for (const int k : {0, 1, 2}) {
            auto& list = from[faces_[f][k]];
            list.erase(std::find(list.begin(), list.end(), f));
            to[faces_[f][k]].push_back(f);
        }
        life_[f] = life;
    };
    for (const std::uint32_t f : quad.pair) move(f, facesOf_, alternatesOf_, alternate);
    for (const std::uint32_t f : quad.alternates) move(f, alternatesOf_, facesOf_, live);
    std::swap(quad.pair, quad.alternates);
}

GuardedMesh::Batch::~Batch()
{
    surface_.tree_.refit();
}

bool GuardedMesh::Batch::apply(const StarChange& star, const Vec3d& p)
{
    const auto touched = [&](std::uint32_t v) { return std::binary_search(moved_.begin(), moved_.end(), v); };
    if (touched(star.centre) || (star.removed != StarChange::none && touched(star.removed))) return false;
    Box box = Box::of(p);
    for (const auto& edge : star.link) {
        for (const std::uint32_t v : edge) {
            if (touched(v)) return false;
            box.expand(Box::of(surface_.point(v)));
        }
    }
    const Box around = grown(box, surface_.guard().spacing().distance);
    std::optional<PlacedStar> placed;
    for (const Made& made : made_) {
        if (!around.meets(made.box)) continue;
        if (!placed) placed.emplace(surface_, star, p);
        for (const auto* faces : {&surface_.facesOf(made.centre), &surface_.alternatesOf(made.centre)}) {
            for (const std::uint32_t f : *faces) {
                if (surface_.isTooNear(*placed, f, Box::of(surface_.corners(f)))) return false;
            }
        }
    }
    surface_.change(star, p);
    for (const std::uint32_t v : {star.centre, star.removed}) {
        if (v != StarChange::none) moved_.insert(std::lower_bound(moved_.begin(), moved_.end(), v), v);
    }
    made_.push_back({box, star.centre});
    return true;
}

Mesh GuardedMesh::mesh() const
{
    Mesh mesh;
    std::vector<std::uint32_t> number(points_.size());
    for (std::uint32_t v = 0; v < points_.size(); ++v) {
        if (!isVertex(v)) continue;
        number[v] = static_cast<std::uint32_t>(mesh.points.size());
        mesh.points.push_back(guard().unscaled(points_[v]));
    }
    for (std::uint32_t f = 0; f < faces_.size(); ++f) {
        if (life_[f] != live) continue;
        if (quadAt_[f] == StarChange::none) {
            const Vec3I& t = faces_[f];
            mesh.triangles.emplace_back(number[t[0]], number[t[1]], number[t[2]]);
        } else if (quads_[quadAt_[f]].pair[0] == f) {
            const Vec4I q = quadOf(f, partnerOf(f));
            mesh.quads.emplace_back(number[q[0]], number[q[1]], number[q[2]], number[q[3]]);
        }
    }
    if (!guard().symmetry()) return mesh;
    std::vector<std::uint32_t> image(mesh.points.size());
    for (std::uint32_t v = 0; v < points_.size(); ++v) {
        if (!isVertex(v)) continue;
        image[number[v]] = number[v];
        if (isOnPlane(v)) continue;
        image[number[v]] = static_cast<std::uint32_t>(mesh.points.size());
        mesh.points.push_back(guard().unscaled(guard().mirrored(points_[v])));
    }
    const std::size_t triangles = mesh.triangles.size(), quads = mesh.quads.size();
    for (std::size_t i = 0; i < triangles; ++i) {
        const Vec3I t = mesh.triangles[i];
        mesh.triangles.emplace_back(image[t[0]], image[t[2]], image[t[1]]);
    }
    for (std::size_t i = 0; i < quads; ++i) {
        const Vec4I q = mesh.quads[i];
        mesh.quads.emplace_back(image[q[0]], image[q[3]], image[q[2]], image[q[1]]);
    }
    return mesh;
}

} // namespace vdbcage::detail
