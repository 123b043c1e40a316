// What gives way to what in the stars of a GuardedMesh, by how its vertices are joined. Whether the guard allows a
// star is asked in guarded_surface.cpp.

#include <algorithm>

#include <vdbcage/bounding/detail/guarded_mesh.h>

namespace vdbcage::detail {

StarChange GuardedMesh::starOf(std::uint32_t v) const
{
    StarChange star;
    star.centre = v;
    star.onPlane = isOnPlane(v);
    star.alternates = alternatesOf_[v].size();
    star.oldFaces.assign(facesOf_[v].begin(), facesOf_[v].end());
    star.oldFaces.insert(star.oldFaces.end(), alternatesOf_[v].begin(), alternatesOf_[v].end());
    star.keptFaces = star.oldFaces;
    for (const std::uint32_t f : star.oldFaces) {
        const Vec3I& t = faces_[f];
        const int i = t[0] == v ? 0 : t[1] == v ? 1 : 2;
        star.link.push_back({t[(i + 1) % 3], t[(i + 2) % 3]});
    }
    return star;
}

bool GuardedMesh::starOf(std::uint32_t keep, std::uint32_t remove, StarChange& star) const
{
    // Link condition: the ends have two common neighbours, no more (on the plane of symmetry, where the half ends,
    // one), and something is left.
    const bool keepOnPlane = isOnPlane(keep), removeOnPlane = isOnPlane(remove);
    const auto a = neighbours(keep), b = neighbours(remove);
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
        for (const std::uint32_t f : facesOf_[v]) {
            const Vec3I& t = faces_[f];
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
    // From the plane to the plane, off it on the way.
    std::size_t onPlane = 0;
    for (const auto& edge : star.link) onPlane += std::size_t(isOnPlane(edge[0])) + std::size_t(isOnPlane(edge[1]));
    return onPlane == 2 && star.link.size() >= 2;
}

StarChange GuardedMesh::starOfSplit(std::uint32_t u, std::uint32_t v) const
{
    StarChange star;
    star.centre = vertices();
    star.onPlane = isOnPlane(u) && isOnPlane(v);
    for (const std::uint32_t f : facesOf_[u]) {
        const Vec3I& t = faces_[f];
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

bool GuardedMesh::starOfFlip(std::uint32_t c, std::uint32_t a, std::uint32_t b, StarChange& star) const
{
    star = starOf(c);
    const auto edge = std::find(star.link.begin(), star.link.end(), std::array<std::uint32_t, 2>{a, b});
    if (edge == star.link.end()) return false;
    for (const std::uint32_t f : facesOf_[b]) {
        const Vec3I& t = faces_[f];
        const int i = t[0] == b ? 0 : t[1] == b ? 1 : 2;
        if (t[(i + 1) % 3] != a) continue;
        const std::uint32_t d = t[(i + 2) % 3];
        const auto joined = neighbours(c);
        if (std::binary_search(joined.begin(), joined.end(), d) || (star.onPlane && isOnPlane(d))) return false;
        *edge = {a, d};
        star.link.push_back({d, b});
        star.oldFaces.push_back(f);
        star.keptFaces.push_back(f);
        return true;
    }
    return false;
}

bool GuardedMesh::starOfFaces(const StarChange::Faces& faces, bool onPlane, StarChange& star) const
{
    star = StarChange{};
    star.centre = vertices();
    star.onPlane = onPlane;
    star.oldFaces = faces;
    const auto isSide = [&](std::uint32_t f, std::uint32_t a, std::uint32_t b) {
        const Vec3I& t = faces_[f];
        return (t[0] == a && t[1] == b) || (t[1] == a && t[2] == b) || (t[2] == a && t[0] == b);
    };
    StarChange::Faces begins, ends;
    std::size_t ofPlane = 0;
    for (const std::uint32_t f : faces) {
        for (int i = 0; i < 3; ++i) {
            const std::uint32_t a = faces_[f][i], b = faces_[f][(i + 1) % 3];
            if (onPlane && isOnPlane(a) && isOnPlane(b)) continue;
            if (std::any_of(faces.begin(), faces.end(), [&](std::uint32_t g) { return isSide(g, b, a); })) continue;
            star.keptFaces.push_back(star.link.size() < faces.size() ? faces[star.link.size()] : StarChange::none);
            star.link.push_back({a, b});
            begins.push_back(a);
            ends.push_back(b);
            ofPlane += std::size_t(isOnPlane(a)) + std::size_t(isOnPlane(b));
        }
    }
    // A disk without a vertex inside has two sides more than faces, and goes through each corner once; where it ends on
    // the plane one of them is left out, and no alternates have an end there.
    for (StarChange::Faces* corners : {&begins, &ends}) {
        std::sort(corners->begin(), corners->end());
        if (std::adjacent_find(corners->begin(), corners->end()) != corners->end()) return false;
    }
    return star.link.size() == faces.size() + (onPlane ? 1 : 2) && (!onPlane || ofPlane == 2);
}

} // namespace vdbcage::detail
