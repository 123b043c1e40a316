// What gives way to what in the fans of a GuardedSurface, by how its vertices are joined. Whether the guard allows a
// fan is asked in guarded_surface.cpp.

#include <algorithm>

#include <vdbcage/surface/detail/guarded_surface.h>

namespace vdbcage::detail {

Fan GuardedSurface::fanOf(std::uint32_t v) const
{
    Fan fan;
    fan.centre = v;
    fan.onPlane = isOnPlane(v);
    fan.others = othersOf_[v].size();
    fan.oldFaces.assign(facesOf_[v].begin(), facesOf_[v].end());
    fan.oldFaces.insert(fan.oldFaces.end(), othersOf_[v].begin(), othersOf_[v].end());
    fan.keptFaces = fan.oldFaces;
    for (const std::uint32_t f : fan.oldFaces) {
        const Vec3I& t = faces_[f];
        const int i = t[0] == v ? 0 : t[1] == v ? 1 : 2;
        fan.rim.push_back({t[(i + 1) % 3], t[(i + 2) % 3]});
    }
    return fan;
}

bool GuardedSurface::fanOf(std::uint32_t keep, std::uint32_t remove, Fan& fan) const
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
    fan = Fan{};
    fan.centre = keep;
    fan.onPlane = keepOnPlane || removeOnPlane;
    if (common != (keepOnPlane && removeOnPlane ? 1U : 2U)) return false;
    if (!fan.onPlane && a.size() + b.size() < 8) return false;
    fan.removed = remove;
    for (const std::uint32_t v : {keep, remove}) {
        for (const std::uint32_t f : facesOf_[v]) {
            const Vec3I& t = faces_[f];
            const bool both =
                (t[0] == keep || t[1] == keep || t[2] == keep) && (t[0] == remove || t[1] == remove || t[2] == remove);
            if (both) {
                if (v == keep) fan.oldFaces.push_back(f);
                continue;
            }
            fan.oldFaces.push_back(f);
            fan.keptFaces.push_back(f);
            const int i = t[0] == v ? 0 : t[1] == v ? 1 : 2;
            fan.rim.push_back({t[(i + 1) % 3], t[(i + 2) % 3]});
        }
    }
    if (!fan.onPlane) return fan.rim.size() >= 3;
    // From the plane to the plane, off it on the way.
    std::size_t onPlane = 0;
    for (const auto& edge : fan.rim) onPlane += std::size_t(isOnPlane(edge[0])) + std::size_t(isOnPlane(edge[1]));
    return onPlane == 2 && fan.rim.size() >= 2;
}

Fan GuardedSurface::fanOfSplit(std::uint32_t u, std::uint32_t v) const
{
    Fan fan;
    fan.centre = vertices();
    fan.onPlane = isOnPlane(u) && isOnPlane(v);
    for (const std::uint32_t f : facesOf_[u]) {
        const Vec3I& t = faces_[f];
        for (int i = 0; i < 3; ++i) {
            const std::uint32_t a = t[i], b = t[(i + 1) % 3], c = t[(i + 2) % 3];
            if (!((a == u && b == v) || (a == v && b == u))) continue;
            fan.oldFaces.push_back(f);
            fan.keptFaces.push_back(f);
            fan.rim.push_back({b, c});
            fan.keptFaces.push_back(Fan::none);
            fan.rim.push_back({c, a});
        }
    }
    return fan;
}

bool GuardedSurface::fanOfFlip(std::uint32_t c, std::uint32_t a, std::uint32_t b, Fan& fan) const
{
    fan = fanOf(c);
    const auto edge = std::find(fan.rim.begin(), fan.rim.end(), std::array<std::uint32_t, 2>{a, b});
    if (edge == fan.rim.end()) return false;
    for (const std::uint32_t f : facesOf_[b]) {
        const Vec3I& t = faces_[f];
        const int i = t[0] == b ? 0 : t[1] == b ? 1 : 2;
        if (t[(i + 1) % 3] != a) continue;
        const std::uint32_t d = t[(i + 2) % 3];
        const auto joined = neighbours(c);
        if (std::binary_search(joined.begin(), joined.end(), d) || (fan.onPlane && isOnPlane(d))) return false;
        *edge = {a, d};
        fan.rim.push_back({d, b});
        fan.oldFaces.push_back(f);
        fan.keptFaces.push_back(f);
        return true;
    }
    return false;
}

bool GuardedSurface::fanOfFaces(const Fan::Faces& faces, bool onPlane, Fan& fan) const
{
    fan = Fan{};
    fan.centre = vertices();
    fan.onPlane = onPlane;
    fan.oldFaces = faces;
    const auto isSide = [&](std::uint32_t f, std::uint32_t a, std::uint32_t b) {
        const Vec3I& t = faces_[f];
        return (t[0] == a && t[1] == b) || (t[1] == a && t[2] == b) || (t[2] == a && t[0] == b);
    };
    Fan::Faces begins, ends;
    std::size_t ofPlane = 0;
    for (const std::uint32_t f : faces) {
        for (int i = 0; i < 3; ++i) {
            const std::uint32_t a = faces_[f][i], b = faces_[f][(i + 1) % 3];
            if (onPlane && isOnPlane(a) && isOnPlane(b)) continue;
            if (std::any_of(faces.begin(), faces.end(), [&](std::uint32_t g) { return isSide(g, b, a); })) continue;
            fan.keptFaces.push_back(fan.rim.size() < faces.size() ? faces[fan.rim.size()] : Fan::none);
            fan.rim.push_back({a, b});
            begins.push_back(a);
            ends.push_back(b);
            ofPlane += std::size_t(isOnPlane(a)) + std::size_t(isOnPlane(b));
        }
    }
    // A disk without a vertex inside has two sides more than faces, and goes through each corner once; where it ends on
    // the plane one of them is left out, and no others have an end there.
    for (Fan::Faces* corners : {&begins, &ends}) {
        std::sort(corners->begin(), corners->end());
        if (std::adjacent_find(corners->begin(), corners->end()) != corners->end()) return false;
    }
    return fan.rim.size() == faces.size() + (onPlane ? 1 : 2) && (!onPlane || ofPlane == 2);
}

} // namespace vdbcage::detail
