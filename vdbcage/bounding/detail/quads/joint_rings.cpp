#include <vdbcage/bounding/detail/quads/joint_rings.h>

#include <algorithm>
#include <cmath>
#include <map>

#include <vdbcage/core/detail/pi.h>

namespace vdbcage::detail {

namespace {

constexpr double leastCosine = 0.5; // of a ring's normal and the limb
// In radii of the limb:
constexpr double widest = 2;         // of a ring
constexpr double reach = 1, far = 3; // of a ring's plane from the joint; of the loops that may become a ring
constexpr double ringWidth = 0.6;    // three rings are near the joint

/// Returns a loop as a polygon: the middles of its rungs.
std::vector<Vec3d> polygonOf(const GuardedMesh& surface, const QuadLoop& loop)
{
    std::vector<Vec3d> polygon;
    for (const auto& [a, b] : loop.rungs) polygon.push_back(0.5 * (surface.point(a) + surface.point(b)));
    if (!loop.isClosed()) { // from the plane of symmetry to the plane
        for (std::size_t i = loop.rungs.size() - 1; i-- > 1;) polygon.push_back(surface.guard().mirrored(polygon[i]));
    }
    return polygon;
}

/// The position of a loop relative to a point that it goes around once, seen along its normal.
struct Winding {
    Vec3d normal;
    double height, radius;
};

std::optional<Winding> windingAround(const std::vector<Vec3d>& polygon, const Vec3d& point)
{
    Vec3d area(0.0), middle(0.0);
    const std::size_t n = polygon.size();
    for (std::size_t i = 0; i < n; ++i) {
        const Vec3d p = polygon[i] - point, q = polygon[(i + 1) % n] - point;
        area += 0.5 * p.cross(q);
        middle += p / static_cast<double>(n);
    }
    Winding winding{area, 0, std::sqrt(area.length() / pi)};
    if (!winding.normal.normalize(0)) return std::nullopt;
    double angle = 0;
    for (std::size_t i = 0; i < n; ++i) {
        Vec3d p = polygon[i] - point, q = polygon[(i + 1) % n] - point;
        p -= p.dot(winding.normal) * winding.normal;
        q -= q.dot(winding.normal) * winding.normal;
        angle += std::atan2(winding.normal.dot(p.cross(q)), p.dot(q));
    }
    if (!(std::abs(angle - 2 * pi) < 1)) return std::nullopt;
    winding.height = middle.dot(winding.normal);
    return winding;
}

} // namespace

std::vector<JointRings::Ring> JointRings::ringsAround(const std::vector<QuadLoop>& loops, const Limb& limb,
                                                      double radii) const
{
    const double longest = 4 * std::sqrt(static_cast<double>(surface_.copies() * table_.count()));
    std::vector<Ring> rings;
    for (const QuadLoop& loop : loops) {
        if (static_cast<double>(loop.quads.size()) > longest) continue;
        const auto winding = windingAround(polygonOf(surface_, loop), limb.place);
        if (!winding || winding->radius > widest * limb.radius) continue;
        const double cosine = winding->normal.dot(limb.axis);
        if (std::abs(winding->height) > radii * limb.radius || std::abs(cosine) < leastCosine) continue;
        rings.push_back({&loop, cosine > 0 ? winding->height : -winding->height});
    }
    std::stable_sort(rings.begin(), rings.end(),
                     [](const Ring& a, const Ring& b) { return std::abs(a.height) < std::abs(b.height); });
    return rings;
}

std::vector<std::size_t> JointRings::count() const
{
    std::vector<std::size_t> counts;
    if (!mayHaveRings()) return counts;
    const std::vector<QuadLoop> loops = straightLoops(table_);
    for (const Limb& limb : surface_.wishes().limbs()) counts.push_back(ringsAround(loops, limb, reach).size());
    return counts;
}

bool JointRings::areKept(const std::vector<std::size_t>& before, const std::vector<std::size_t>& after)
{
    for (std::size_t i = 0; i < before.size(); ++i) {
        if (after[i] < std::min(before[i], wanted)) return false;
    }
    return true;
}

std::vector<PlaneHold> JointRings::holds() const
{
    std::vector<PlaneHold> holds;
    if (!mayHaveRings()) return holds;
    const std::vector<QuadLoop> loops = straightLoops(table_);
    struct Sum {
        PlaneHold hold;
        const Limb* of;
        int count;
    };
    std::map<std::uint32_t, Sum> sums;
    for (const Limb& limb : surface_.wishes().limbs()) {
        std::vector<Ring> rings = ringsAround(loops, limb, far);
        if (rings.size() > wanted) rings.erase(rings.begin() + wanted, rings.end());
        std::stable_sort(rings.begin(), rings.end(), [](const Ring& a, const Ring& b) { return a.height < b.height; });
        const Vec3d& axis = limb.axis;
        const double width = ringWidth * limb.radius;
        for (std::size_t i = 0; i < rings.size(); ++i) {
            const double place = static_cast<double>(i) - 0.5 * static_cast<double>(rings.size() - 1);
            const double middle = axis.dot(limb.place) + place * width;
            for (const Rung& rung : rings[i].loop->rungs) {
                const bool isUp = axis.dot(surface_.point(rung[0])) > axis.dot(surface_.point(rung[1]));
                for (const std::size_t end : {0U, 1U}) {
                    const double offset = (end == 0) == isUp ? middle + 0.5 * width : middle - 0.5 * width;
                    const Sum first{PlaneHold{rung[end], axis, 0, limb.radius}, &limb, 0};
                    Sum& sum = sums.try_emplace(rung[end], first).first->second;
                    if (sum.of != &limb) continue; // another limb holds it
                    sum.hold.offset += offset;
                    ++sum.count;
                }
            }
        }
    }
    for (auto& [vertex, sum] : sums) {
        sum.hold.offset /= sum.count;
        holds.push_back(sum.hold);
    }
    return holds;
}

std::vector<QuadLoop> JointRings::toSplit(const Limb& limb) const
{
    constexpr double near = 0.9 * reach; // vertices still move
    const std::vector<QuadLoop> loops = straightLoops(table_);
    std::vector<QuadLoop> nearest;
    if (ringsAround(loops, limb, near).size() >= wanted) return nearest;
    for (const Ring& ring : ringsAround(loops, limb, far)) nearest.push_back(*ring.loop);
    return nearest;
}

} // namespace vdbcage::detail
