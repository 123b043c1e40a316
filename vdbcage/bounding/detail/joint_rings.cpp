#include <vdbcage/bounding/detail/joint_rings.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include <vdbcage/bounding/detail/loop_split.h>
#include <vdbcage/bounding/detail/quad_relax.h>

namespace vdbcage::detail {

namespace {

constexpr double pi = 3.14159265358979323846;
constexpr double leastCosine = 0.5; // of a ring's normal and the limb
constexpr double ringWidth = 0.5;   // of the limb's radius: three are near the joint

/// A loop as a polygon: the middles of its rungs.
std::vector<Vec3d> polygonOf(const GuardedMesh& surface, const QuadLoop& loop)
{
    std::vector<Vec3d> polygon;
    for (const auto& [a, b] : loop.rungs) polygon.push_back(0.5 * (surface.point(a) + surface.point(b)));
    if (!loop.isClosed()) { // from the plane of symmetry to the plane
        for (std::size_t i = loop.rungs.size() - 1; i-- > 1;) polygon.push_back(surface.guard().mirrored(polygon[i]));
    }
    return polygon;
}

/// How a loop lies to a point that it goes around once, seen along its normal.
struct Winding {
    Vec3d normal;
    double height, radius, length;
};

std::optional<Winding> windingAround(const std::vector<Vec3d>& polygon, const Vec3d& point)
{
    Vec3d area(0.0), middle(0.0);
    double length = 0;
    const std::size_t n = polygon.size();
    for (std::size_t i = 0; i < n; ++i) {
        const Vec3d p = polygon[i] - point, q = polygon[(i + 1) % n] - point;
        area += 0.5 * p.cross(q);
        middle += p / static_cast<double>(n);
        length += (q - p).length();
    }
    Winding winding{area, 0, std::sqrt(area.length() / pi), length};
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

std::vector<JointRings::Ring> JointRings::ringsAround(const std::vector<QuadLoop>& loops, const Joint& joint,
                                                      double reach) const
{
    const double longest = 4 * std::sqrt(static_cast<double>(surface_.copies() * table_.count()));
    std::vector<std::pair<const QuadLoop*, Winding>> around;
    for (const QuadLoop& loop : loops) {
        if (static_cast<double>(loop.quads.size()) > longest) continue;
        const auto winding = windingAround(polygonOf(surface_, loop), joint.place);
        if (!winding || std::abs(winding->height) > std::max(1.0, reach) * winding->radius) continue;
        if (joint.axis && std::abs(winding->normal.dot(*joint.axis)) < leastCosine) continue;
        around.emplace_back(&loop, *winding);
    }
    std::vector<Ring> rings;
    const auto shortest = std::min_element(
        around.begin(), around.end(), [](const auto& a, const auto& b) { return a.second.length < b.second.length; });
    for (const auto& [loop, winding] : around) {
        const Vec3d axis = shortest->second.normal;
        const double cosine = winding.normal.dot(axis);
        if (std::abs(winding.height) > reach * winding.radius || std::abs(cosine) < leastCosine) continue;
        if (winding.radius > 2 * shortest->second.radius) continue;
        rings.push_back({loop, cosine > 0 ? winding.height : -winding.height, winding.radius, axis});
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
    for (const Joint& joint : surface_.guard().joints()) counts.push_back(ringsAround(loops, joint, 1).size());
    return counts;
}

bool JointRings::areKept(const std::vector<std::size_t>& before, const std::vector<std::size_t>& after)
{
    for (std::size_t i = 0; i < before.size(); ++i) {
        if (after[i] < std::min(before[i], wanted)) return false;
    }
    return true;
}

std::vector<JointRings::Hold> JointRings::holds() const
{
    std::vector<Hold> holds;
    if (!mayHaveRings()) return holds;
    const std::vector<QuadLoop> loops = straightLoops(table_);
    struct Sum {
        Hold hold;
        const Joint* of;
        int count;
    };
    std::map<std::uint32_t, Sum> sums;
    for (const Joint& joint : surface_.guard().joints()) {
        std::vector<Ring> rings = ringsAround(loops, joint, 1);
        if (rings.empty()) continue;
        if (rings.size() > wanted) rings.erase(rings.begin() + wanted, rings.end());
        std::stable_sort(rings.begin(), rings.end(), [](const Ring& a, const Ring& b) { return a.height < b.height; });
        const Vec3d& axis = rings[0].axis;
        double radius = rings[0].radius;
        for (const Ring& ring : rings) radius = std::min(radius, ring.radius);
        const double width = ringWidth * radius;
        for (std::size_t i = 0; i < rings.size(); ++i) {
            const double place = static_cast<double>(i) - 0.5 * static_cast<double>(rings.size() - 1);
            const double middle = axis.dot(joint.place) + place * width;
            for (const Rung& rung : rings[i].loop->rungs) {
                const bool isUp = axis.dot(surface_.point(rung[0])) > axis.dot(surface_.point(rung[1]));
                for (const std::size_t end : {0U, 1U}) {
                    const double offset = (end == 0) == isUp ? middle + 0.5 * width : middle - 0.5 * width;
                    const Sum first{Hold{rung[end], axis, 0, radius}, &joint, 0};
                    Sum& sum = sums.try_emplace(rung[end], first).first->second;
                    if (sum.of != &joint) continue; // another one holds it
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

std::optional<QuadLoop> JointRings::nextToSplit(const Joint& joint) const
{
    constexpr double near = 0.9, far = 3; // nearer than is asked: vertices still move
    const std::vector<QuadLoop> loops = straightLoops(table_);
    if (ringsAround(loops, joint, near).size() >= wanted) return std::nullopt;
    const std::vector<Ring> rings = ringsAround(loops, joint, far);
    if (rings.empty()) return std::nullopt;
    return *rings.front().loop;
}

void addRings(GuardedMesh& surface, QuadTable& table, Interrupter* interrupter)
{
    constexpr int mostSplits = 4, sweeps = 2; // of one joint
    for (const Joint& joint : surface.guard().joints()) {
        for (int i = 0; i < mostSplits; ++i) {
            throwIfInterrupted(interrupter);
            const std::optional<QuadLoop> loop = JointRings(surface, table).nextToSplit(joint);
            if (!loop) break;
            GuardedMesh changed = surface;
            QuadTable changedTable = table;
            const std::vector<std::uint32_t> middle = splitLoop(changed, changedTable, *loop);
            if (middle.empty()) break;
            relaxQuads(changed, changedTable, middle, sweeps, interrupter);
            surface = std::move(changed);
            table = std::move(changedTable);
        }
    }
}

} // namespace vdbcage::detail
