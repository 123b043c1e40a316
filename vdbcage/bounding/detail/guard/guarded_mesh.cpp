#include <vdbcage/bounding/detail/guard/guarded_mesh.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <stdexcept>

#include <vdbcage/bounding/detail/guard/admissible.h>
#include <vdbcage/bounding/detail/guard/star_change.h>
#include <vdbcage/core/detail/pi.h>
#include <vdbcage/core/error.h>

namespace vdbcage::detail {

namespace {

/// Returns a triangle that begins with its least corner.
Vec3I fromLeast(const Vec3I& t)
{
    if (t[0] < t[1] && t[0] < t[2]) return t;
    return t[1] < t[2] ? Vec3I(t[1], t[2], t[0]) : Vec3I(t[2], t[0], t[1]);
}

} // namespace

GuardedMesh::GuardedMesh(const Mesh& surface, const GuardModel& guard, Quads quads, const FaceWishes& wishes)
    : guard_(guard), wishes_(wishes), faces_(triangulate(surface))
{
    points_.reserve(surface.points.size());
    for (const Vec3d& p : surface.points) points_.push_back(guard.rounded(guard.scaled(p)));
    auto firstOfQuads = static_cast<std::uint32_t>(surface.triangles.size());
    if (guard.symmetry()) firstOfQuads = takeHalf(firstOfQuads);
    facesOf_.resize(points_.size());
    life_.assign(faces_.size(), live);
    quadAt_.assign(faces_.size(), none);
    liveFaces_ = faces_.size();
    std::vector<Box> boxes;
    boxes.reserve(faces_.size());
    for (std::uint32_t f = 0; f < faces_.size(); ++f) {
        for (int i = 0; i < 3; ++i) facesOf_[faces_[f][i]].push_back(f);
        boxes.push_back(Box::of(corners(f)));
    }
    for (std::uint32_t v = 0; v < points_.size(); ++v) {
        if (!isManifoldAt(v)) {
            throw InputError("surface", "it is not a closed, oriented 2-manifold at point " + std::to_string(v));
        }
    }
    tree_ = DynamicBvh(std::move(boxes));
    if (quads == Quads::split) return;
    const std::uint32_t end = faces();
    for (std::uint32_t f = firstOfQuads; f < end; f += 2) makeQuad(*this, f, f + 1);
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
            throw InputError("surface", "face " + std::to_string(f) + " lies in the plane of symmetry");
        }
        if (least < 0 && most > 0) {
            throw InputError("surface", "face " + std::to_string(f) + " lies across the plane of symmetry");
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
                throw InputError("surface", "point " + std::to_string(t[i]) + " has no mirror image");
            }
            t[i] = *found;
        }
        t = fromLeast(Vec3I(t[0], t[2], t[1]));
    }
    std::vector<Vec3I> sorted;
    for (const Vec3I& t : beyond) sorted.push_back(fromLeast(t));
    std::sort(sorted.begin(), sorted.end());
    std::sort(behind.begin(), behind.end());
    if (sorted != behind) throw InputError("surface", "it is not symmetric: a face has no mirror image");
    faces_ = std::move(beyond);
    return firstQuad;
}

bool GuardedMesh::isManifoldAt(std::uint32_t v) const
{
    // Around each vertex of a closed oriented 2-manifold the link is one cycle. On the plane of symmetry it is a path
    // from plane to plane that leaves the plane in between.
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

Vec3d GuardedMesh::ontoPlane(Vec3d p) const
{
    p[guard().symmetry()->axis] = guard().symmetry()->offset;
    return p;
}

GuardedMesh::Vertices GuardedMesh::neighbours(std::uint32_t v) const
{
    const bool halved = isOnPlane(v); // if so, one of the neighbours is only the last corner of a face
    Vertices list;
    for (const std::uint32_t f : facesOf_[v]) {
        const Vec3I& t = faces_[f];
        list.push_back(t[0] == v ? t[1] : t[1] == v ? t[2] : t[0]);
        if (halved) list.push_back(t[0] == v ? t[2] : t[1] == v ? t[0] : t[1]);
    }
    const FaceList& alternates = alternatesOf(v);
    for (const std::uint32_t f : alternates) {
        for (const int i : {0, 1, 2}) {
            if (faces_[f][i] != v) list.push_back(faces_[f][i]);
        }
    }
    std::sort(list.begin(), list.end());
    if (halved || !alternates.empty()) list.erase(std::unique(list.begin(), list.end()), list.end());
    return list;
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
        if (!alternatesOf_.empty()) alternatesOf_.emplace_back();
        reconnect(star);
        return;
    }
    points_[star.centre] = p;
    const bool takesFaceIn = star.oldFaces.size() > facesOf_[star.centre].size() + alternatesOf(star.centre).size();
    if (star.removed != none || takesFaceIn) {
        reconnect(star);
    } else {
        for (const std::uint32_t f : star.keptFaces) tree_.update(f, Box::of(corners(f)));
    }
}

GuardedMesh::Saved GuardedMesh::saved(const StarChange& star) const
{
    Saved saved{faces(), vertices(), {}, {}, {}};
    std::vector<std::uint32_t> touched;
    for (const std::uint32_t f : star.oldFaces) {
        saved.faces.emplace_back(f, faces_[f]);
        for (const int k : {0, 1, 2}) touched.push_back(faces_[f][k]);
    }
    std::sort(touched.begin(), touched.end());
    touched.erase(std::unique(touched.begin(), touched.end()), touched.end());
    for (const std::uint32_t v : touched) saved.facesOf.emplace_back(v, facesOf_[v]);
    if (star.centre < vertices()) saved.points.emplace_back(star.centre, points_[star.centre]);
    return saved;
}

void GuardedMesh::restore(const Saved& saved)
{
    for (std::uint32_t f = saved.faceCount; f < faces(); ++f) {
        if (life_[f] != live) continue;
        life_[f] = dead;
        --liveFaces_;
        tree_.remove(f);
    }
    for (std::uint32_t v = saved.vertexCount; v < vertices(); ++v) facesOf_[v].clear();
    for (const auto& [v, p] : saved.points) points_[v] = p;
    for (const auto& [v, list] : saved.facesOf) facesOf_[v] = list;
    for (const auto& [f, t] : saved.faces) {
        faces_[f] = t;
        if (life_[f] == live) {
            tree_.update(f, Box::of(corners(f)));
        } else {
            life_[f] = live;
            ++liveFaces_;
            tree_.restore(f, Box::of(corners(f)));
        }
    }
    tree_.rebuildIfWorthwhile();
    tree_.refit();
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
        const bool isNew = f == none;
        if (isNew) {
            f = faces();
            faces_.emplace_back();
            life_.push_back(live);
            quadAt_.push_back(none);
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
    if (quadAt_[f] == none) return none;
    const Quad& quad = quads_[quadAt_[f]];
    const auto& both = life_[f] == live ? quad.faces : quad.alternates;
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
    constexpr double radians = pi / 180, rounding = 1e-12;
    leastQuadCosine_ = degrees >= 90 ? 0 : std::cos(degrees * radians) - rounding;
}

Vec4I GuardedMesh::quadOf(std::uint32_t f) const
{
    const Quad& quad = quads_[quadAt_[f]];
    return quadOf(quad.faces[0], quad.faces[1]);
}

void GuardedMesh::pair(std::uint32_t f, std::uint32_t g, const std::array<Vec3I, 2>& alternates)
{
    alternatesOf_.resize(points_.size());
    auto number = static_cast<std::uint32_t>(quads_.size());
    if (freeQuads_.empty()) {
        quads_.emplace_back();
    } else {
        number = freeQuads_.back();
        freeQuads_.pop_back();
    }
    quads_[number] = {{f, g}, {faces(), faces() + 1}};
    quadAt_[f] = quadAt_[g] = number;
    const bool mayCutToo = mayCut(f) || mayCut(g);
    for (const Vec3I& t : alternates) {
        const std::uint32_t o = faces();
        if (mayCutToo) letCut(o, true);
        faces_.push_back(t);
        life_.push_back(alternate);
        quadAt_.push_back(number);
        for (const int k : {0, 1, 2}) alternatesOf_[t[k]].push_back(o);
        tree_.insert(o, Box::of(corners(o)));
    }
    tree_.rebuildIfWorthwhile();
}

void GuardedMesh::letCut(std::uint32_t face, bool may)
{
    if (mayCut_.size() <= face) mayCut_.resize(face + 1, 0);
    mayCut_[face] = may ? 1 : 0;
}

void GuardedMesh::limit(std::uint32_t v, const MoveLimit& limit)
{
    limits_.resize(points_.size());
    limits_[v] = limit;
}

void GuardedMesh::splitQuad(std::uint32_t face)
{
    const std::uint32_t number = quadAt_[face];
    const Quad quad = quads_[number];
    for (const std::uint32_t f : quad.faces) quadAt_[f] = none;
    for (const std::uint32_t o : quad.alternates) {
        for (const int k : {0, 1, 2}) {
            auto& list = alternatesOf_[faces_[o][k]];
            list.erase(std::find(list.begin(), list.end(), o));
        }
        life_[o] = dead;
        quadAt_[o] = none;
        tree_.remove(o);
    }
    freeQuads_.push_back(number);
    tree_.rebuildIfWorthwhile();
    tree_.refit();
}

void GuardedMesh::flipQuad(std::uint32_t face)
{
    Quad& quad = quads_[quadAt_[face]];
    const auto move = [&](std::uint32_t f, std::vector<FaceList>& from, std::vector<FaceList>& to, Life life) {
        for (const int k : {0, 1, 2}) {
            auto& list = from[faces_[f][k]];
            list.erase(std::find(list.begin(), list.end(), f));
            to[faces_[f][k]].push_back(f);
        }
        life_[f] = life;
    };
    for (const std::uint32_t f : quad.faces) move(f, facesOf_, alternatesOf_, alternate);
    for (const std::uint32_t f : quad.alternates) move(f, alternatesOf_, facesOf_, live);
    std::swap(quad.faces, quad.alternates);
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
        if (quadAt_[f] == none) {
            const Vec3I& t = faces_[f];
            mesh.triangles.emplace_back(number[t[0]], number[t[1]], number[t[2]]);
        } else if (quads_[quadAt_[f]].faces[0] == f) {
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
