#include <vdbcage/bounding/detail/joint_rings.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include <vdbcage/bounding/detail/loop_split.h>
#include <vdbcage/bounding/detail/quad_relax.h>

namespace vdbcage::detail {

namespace {

constexpr double pi = 3.14159265358979323846;
constexpr double leastCosine = 0.5; // of a ring's normal and the limb

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
    winding.height = std::abs(middle.dot(winding.normal));
    return winding;
}

} // namespace

JointRings::JointRings(const std::vector<Joint>& joints, const GuardModel& guard)
{
    for (const Joint& joint : joints) {
        Joint here{guard.scaled(joint.place), joint.axis};
        if (here.axis) here.axis->normalize(0);
        if (const auto& plane = guard.symmetry(); plane && here.place[plane->axis] < plane->offset) {
            here.place = guard.mirrored(here.place);
            if (here.axis) (*here.axis)[plane->axis] *= -1;
        }
        joints_.push_back(here);
    }
}

std::vector<JointRings::Ring> JointRings::ringsAround(const GuardedMesh& surface, const QuadTable& table,
                                                      const std::vector<QuadLoop>& loops, const Joint& joint,
                                                      double reach) const
{
    const double longest = 4 * std::sqrt(static_cast<double>(table.count()));
    std::vector<std::pair<const QuadLoop*, Winding>> around;
    for (const QuadLoop& loop : loops) {
        if (static_cast<double>(loop.quads.size()) > longest) continue;
        const auto winding = windingAround(polygonOf(surface, loop), joint.place);
        if (!winding || winding->height > std::max(1.0, reach) * winding->radius) continue;
        if (joint.axis && std::abs(winding->normal.dot(*joint.axis)) < leastCosine) continue;
        around.emplace_back(&loop, *winding);
    }
    std::vector<Ring> rings;
    const auto shortest = std::min_element(
        around.begin(), around.end(), [](const auto& a, const auto& b) { return a.second.length < b.second.length; });
    for (const auto& [loop, winding] : around) {
        if (winding.height > reach * winding.radius || winding.radius > 2 * shortest->second.radius) continue;
        if (std::abs(winding.normal.dot(shortest->second.normal)) < leastCosine) continue;
        rings.push_back({loop, winding.height, winding.radius});
    }
    return rings;
}

std::vector<std::size_t> JointRings::count(const GuardedMesh& surface, const QuadTable& table, double reach) const
{
    const std::vector<QuadLoop> loops = straightLoops(table);
    std::vector<std::size_t> counts;
    for (const Joint& joint : joints_) counts.push_back(ringsAround(surface, table, loops, joint, reach).size());
    return counts;
}

bool JointRings::areKept(const std::vector<std::size_t>& before, const std::vector<std::size_t>& after)
{
    for (std::size_t i = 0; i < before.size(); ++i) {
        if (after[i] < std::min(before[i], wanted)) return false;
    }
    return true;
}

const QuadLoop* JointRings::nextToSplit(const GuardedMesh& surface, const QuadTable& table,
                                        const std::vector<QuadLoop>& loops, std::size_t joint) const
{
    constexpr double near = 0.8, far = 3; // nearer than is asked: vertices still move
    if (ringsAround(surface, table, loops, joints_[joint], near).size() >= wanted) return nullptr;
    const std::vector<Ring> rings = ringsAround(surface, table, loops, joints_[joint], far);
    const auto next =
        std::min_element(rings.begin(), rings.end(), [](const Ring& a, const Ring& b) { return a.height < b.height; });
    return next == rings.end() ? nullptr : next->loop;
}

void addRings(GuardedMesh& surface, QuadTable& table, const JointRings& rings, Interrupter* interrupter)
{
    constexpr int mostSplits = 4, sweeps = 2; // of one joint
    for (std::size_t joint = 0; joint < rings.joints(); ++joint) {
        for (int i = 0; i < mostSplits; ++i) {
            throwIfInterrupted(interrupter);
            const std::vector<QuadLoop> loops = straightLoops(table);
            const QuadLoop* const loop = rings.nextToSplit(surface, table, loops, joint);
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
