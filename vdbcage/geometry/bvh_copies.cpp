#include <vdbcage/geometry/bvh_copies.h>

#include <algorithm>
#include <functional>
#include <unordered_set>
#include <utility>

#include <vdbcage/core/detail/asker.h>

namespace vdbcage::detail {

namespace {

Corners sorted(Corners t)
{
    std::sort(t.begin(), t.end(), [](const Vec3d& a, const Vec3d& b) { return a < b; });
    return t;
}

// Returns the same value for any order of the corners, and for zeros of either sign.
std::size_t hashOf(const Corners& t)
{
    std::size_t sum = 0;
    for (const Vec3d& p : t) {
        std::size_t hash = 0;
        for (int axis = 0; axis < 3; ++axis) hash = (hash ^ std::hash<double>()(p[axis])) * 0x9e3779b97f4a7c15U;
        sum += hash ^ hash >> 29U;
    }
    return sum;
}

} // namespace

LeafRef* dropCopies(const BvhTriangles& triangles, LeafRef* first, LeafRef* last, Interrupter* interrupter)
{
    const auto hash = [&](const LeafRef* ref) {
        std::size_t sum = 0;
        for (std::uint32_t i = 0; i < ref->count; ++i) sum = 31 * sum + hashOf(triangles.corners(ref->triangle + i));
        return sum;
    };
    const auto same = [&](const LeafRef* a, const LeafRef* b) {
        if (a->count != b->count) return false;
        for (std::uint32_t i = 0; i < a->count; ++i) {
            if (sorted(triangles.corners(a->triangle + i)) != sorted(triangles.corners(b->triangle + i))) return false;
        }
        return true;
    };
    std::unordered_set<const LeafRef*, decltype(hash), decltype(same)> kept(16, hash, same);
    LeafRef* end = first;
    Asker ask(interrupter);
    for (LeafRef* ref = first; ref != last; ++ref) {
        ask();
        std::swap(*end, *ref);
        if (kept.insert(end).second) ++end;
    }
    for (LeafRef* ref = end; ref != last; ++ref) ref->count = 0; // a leaf of no items, in no node
    return end;
}

} // namespace vdbcage::detail
