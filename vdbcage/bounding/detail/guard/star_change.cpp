#include <vdbcage/bounding/detail/guard/star_change.h>

#include <algorithm>

#include <vdbcage/bounding/detail/guard/face_queries.h>

namespace vdbcage::detail {

StarChange starOf(const GuardedMesh& mesh, std::uint32_t v)
{
    StarChange star;
    star.centre = v;
    star.onPlane = mesh.isOnPlane(v);
    star.alternates = mesh.alternatesOf(v).size();
    star.oldFaces.assign(mesh.facesOf(v).begin(), mesh.facesOf(v).end());
    star.oldFaces.insert(star.oldFaces.end(), mesh.alternatesOf(v).begin(), mesh.alternatesOf(v).end());
    star.keptFaces = star.oldFaces;
    for (const std::uint32_t f : star.oldFaces) {
        const Vec3I& t = mesh.face(f);
        const int i = t[0] == v ? 0 : t[1] == v ? 1 : 2;
        star.link.push_back({t[(i + 1) % 3], t[(i + 2) % 3]});
    }
    return star;
}

bool starOfCollapse(const GuardedMesh& mesh, std::uint32_t keep, std::uint32_t remove, StarChange& star)
{
    // Link condition: the ends have exactly two common neighbours (one on the plane of symmetry, where the half ends),
    // and something is left.
    const bool keepOnPlane = mesh.isOnPlane(keep), removeOnPlane = mesh.isOnPlane(remove);
    const auto a = mesh.neighbours(keep), b = mesh.neighbours(remove);
    std::size_t common = 0;
    for (auto i = a.begin(), j = b.begin(); i != a.end() && j != b.end();) {
        if (*i == *j) ++common;
        const bool first = *i <= *j, second = *j <= *i;
        i += first;
        j += second;
    }
    star = StarChange{};
    star.centre = keep;
    star.onPlane = keepOnPlane || removeOnPlane;
    if (common != (keepOnPlane && removeOnPlane ? 1U : 2U)) return false;
    if (!star.onPlane && a.size() + b.size() < 8) return false;
    star.removed = remove;
    for (const std::uint32_t v : {keep, remove}) {
        for (const std::uint32_t f : mesh.facesOf(v)) {
            const Vec3I& t = mesh.face(f);
            const bool both =
                (t[0] == keep || t[1] == keep || t[2] == keep) && (t[0] == remove || t[1] == remove || t[2] == remove);
            if (both) {
                if (v == keep) star.oldFaces.push_back(f);
                continue;
            }
            star.oldFaces.push_back(f);
            star.keptFaces.push_back(f);
            const int i = t[0] == v ? 0 : t[1] == v ? 1 : 2;
            star.link.push_back({t[(i + 1) % 3], t[(i + 2) % 3]});
        }
    }
    if (!star.onPlane) return star.link.size() >= 3;
    // The link goes from the plane to the plane and leaves it in between.
    std::size_t onPlane = 0;
    for (const auto& edge : star.link)
        onPlane += std::size_t(mesh.isOnPlane(edge[0])) + std::size_t(mesh.isOnPlane(edge[1]));
    return onPlane == 2 && star.link.size() >= 2;
}

StarChange starOfSplit(const GuardedMesh& mesh, std::uint32_t u, std::uint32_t v)
{
    StarChange star;
    star.centre = mesh.vertices();
    star.onPlane = mesh.isOnPlane(u) && mesh.isOnPlane(v);
    for (const std::uint32_t f : mesh.facesOf(u)) {
        const Vec3I& t = mesh.face(f);
        for (int i = 0; i < 3; ++i) {
            const std::uint32_t a = t[i], b = t[(i + 1) % 3], c = t[(i + 2) % 3];
            if (!((a == u && b == v) || (a == v && b == u))) continue;
            star.oldFaces.push_back(f);
            star.keptFaces.push_back(f);
            star.link.push_back({b, c});
            star.keptFaces.push_back(StarChange::none);
            star.link.push_back({c, a});
        }
    }
    return star;
}

bool starOfFlip(const GuardedMesh& mesh, std::uint32_t c, std::uint32_t a, std::uint32_t b, StarChange& star)
{
    star = starOf(mesh, c);
    const auto edge = std::find(star.link.begin(), star.link.end(), std::array<std::uint32_t, 2>{a, b});
    if (edge == star.link.end()) return false;
    const std::uint32_t f = faceAt(mesh, b, a);
    if (f == StarChange::none) return false;
    const std::uint32_t d = cornerOpposite(mesh, f, b, a);
    const auto joined = mesh.neighbours(c);
    if (std::binary_search(joined.begin(), joined.end(), d) || (star.onPlane && mesh.isOnPlane(d))) return false;
    *edge = {a, d};
    star.link.push_back({d, b});
    star.oldFaces.push_back(f);
    star.keptFaces.push_back(f);
    return true;
}

namespace {

/// Makes the rim of the star's old faces its link. Returns false unless the rim passes each corner once, has two
/// corners on the plane if the centre is there, and has `more` more sides than there are faces.
bool takeRim(const GuardedMesh& mesh, int more, StarChange& star)
{
    const auto& faces = star.oldFaces;
    StarChange::Faces begins, ends;
    std::size_t ofPlane = 0;
    for (const std::uint32_t f : faces) {
        for (int i = 0; i < 3; ++i) {
            const std::uint32_t a = mesh.face(f)[i], b = mesh.face(f)[(i + 1) % 3];
            if (star.onPlane && mesh.isOnPlane(a) && mesh.isOnPlane(b)) continue;
            const auto isAcross = [&](std::uint32_t g) { return sideOf(mesh, g, b, a) >= 0; };
            if (std::any_of(faces.begin(), faces.end(), isAcross)) continue;
            star.keptFaces.push_back(star.link.size() < faces.size() ? faces[star.link.size()] : StarChange::none);
            star.link.push_back({a, b});
            begins.push_back(a);
            ends.push_back(b);
            ofPlane += std::size_t(mesh.isOnPlane(a)) + std::size_t(mesh.isOnPlane(b));
        }
    }
    for (StarChange::Faces* corners : {&begins, &ends}) {
        std::sort(corners->begin(), corners->end());
        if (std::adjacent_find(corners->begin(), corners->end()) != corners->end()) return false;
    }
    return static_cast<int>(star.link.size()) == static_cast<int>(faces.size()) + more &&
           (!star.onPlane || ofPlane == 2);
}

} // namespace

bool starOfFaces(const GuardedMesh& mesh, const StarChange::Faces& faces, bool onPlane, StarChange& star)
{
    star = StarChange{};
    star.centre = mesh.vertices();
    star.onPlane = onPlane;
    star.oldFaces = faces;
    // A disk without a vertex inside has two more sides than faces; where it ends on the plane one of them is left out.
    return takeRim(mesh, onPlane ? 1 : 2, star);
}

bool starOfPatch(const GuardedMesh& mesh, std::uint32_t centre, std::uint32_t removed, const StarChange::Faces& faces,
                 StarChange& star)
{
    star = StarChange{};
    star.centre = centre;
    star.removed = removed;
    star.onPlane = mesh.isOnPlane(centre);
    star.oldFaces = faces;
    // Every vertex inside, and a centre on the plane, takes two sides away.
    return takeRim(mesh, removed == StarChange::none ? 0 : -2, star);
}

Vec3d outward(const GuardedMesh& mesh, const StarChange& star)
{
    Vec3d normal(0.0);
    for (const std::uint32_t f : star.oldFaces) normal += areaNormal(mesh, f);
    if (star.onPlane) normal[mesh.guard().symmetry()->axis] = 0;
    const double length = normal.length();
    return length > 0 ? normal / length : Vec3d(0.0);
}

Vec3d rounded(const GuardedMesh& mesh, const StarChange& star, const Vec3d& p)
{
    const Vec3d place = mesh.guard().rounded(star.onPlane ? mesh.ontoPlane(p) : p);
    const MoveLimit* limit = mesh.limitOf(star.centre);
    return limit ? limit->onRail(place) : place;
}

} // namespace vdbcage::detail
