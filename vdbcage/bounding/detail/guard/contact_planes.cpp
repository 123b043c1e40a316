#include <vdbcage/bounding/detail/guard/contact_planes.h>

#include <algorithm>
#include <cmath>

#include <vdbcage/geometry/triangle_pair.h>

namespace vdbcage::detail {

namespace {

/// The first contact of a triangle whose corner 0 moves in a straight line.
struct Impact {
    double time = 1;   ///< 0 to 1
    Vec3d normal{0.0}; ///< of the plane through the contact that the corner must stay above, any length
    double weight = 0; ///< of the corner at the contact
};

} // namespace

bool addImpacts(const GuardModel& guard, const Corners& now, const Vec3d& to, bool corner, double clearance,
                std::vector<HalfSpace>& halfSpaces)
{
    const Vec3d &c = now[0], &a = now[1], &b = now[2];
    const Vec3d step = to - c, across = b - a;
    Impact face, edge, vertex;
    const auto meetFace = [&](const Vec3d& p) {
        const Vec3d arm = p - a, normal = across.cross(arm);
        const double time = -normal.dot(c - a) / normal.dot(step);
        if (!(time > 0 && time < face.time)) return;
        const Vec3d at = c + time * step, up = across.cross(at - a), n = across.cross(up);
        const double weight = n.dot(arm) / n.dot(at - a);
        const Vec3d foot = arm - weight * (at - a);
        const double along = foot.dot(across);
        if (weight > 0 && weight <= 1 && along >= 0 && along <= (1 - weight) * across.dot(across)) {
            face = {time, normal, weight};
        }
    };
    const auto meetEdge = [&](const Vec3d& first, const Vec3d& second) { // the edge from a to the corner
        const Vec3d p = first - a, q = second - a, normal = p.cross(q);
        const double time = -normal.dot(c - a) / normal.dot(step);
        if (!(time > 0 && time < edge.time)) return;
        const Vec3d arm = c + time * step - a;
        const double s = arm.cross(p).dot(normal), t = arm.cross(q).dot(normal);
        const double weight = p.cross(q - p).dot(normal) / arm.cross(q - p).dot(normal);
        if ((s > 0) != (t > 0) && weight > 0 && weight <= 1) edge = {time, normal, weight};
    };
    const auto meetCorner = [&](const Corners& m) {
        const Vec3d normal = (m[1] - m[0]).cross(m[2] - m[0]);
        const double time = normal.dot(m[0] - c) / normal.dot(step);
        if (!(time > 0 && time < vertex.time)) return;
        const Vec3d at = c + time * step;
        for (std::size_t i = 0; i < 3; ++i) {
            if (!((m[(i + 1) % 3] - m[i]).cross(at - m[i]).dot(normal) >= 0)) return;
        }
        vertex = {time, normal, 1};
    };
    const TriangleBvh& tree = guard.tree();
    tree.traverse(tree.near({a, c, to}), [&](const TriangleBvh::Item& item) {
        const Corners m = tree.corners(item);
        for (std::size_t i = 0; i < 3; ++i) meetEdge(m[i], m[(i + 1) % 3]);
        if (corner) meetCorner(m);
        return true;
    });
    // The face of a long way meets much of the model: once something stops it, only the way up to there counts.
    double way = 1;
    TriangleBvh::Query query = tree.inTetrahedron({c, to, a, b});
    tree.traverse(query, [&](const TriangleBvh::Item& item) {
        for (const Vec3d& p : tree.corners(item)) meetFace(p);
        if (face.time < 0.9 * way) {
            way = face.time;
            query = tree.inTetrahedron({c, c + way * step, a, b});
        }
        return true;
    });
    const std::size_t before = halfSpaces.size();
    for (const Impact& impact : {face, edge, vertex}) {
        if (!(impact.weight > 0)) continue;
        Vec3d normal = impact.normal / impact.normal.length();
        if (normal.dot(step) > 0) normal = -normal;
        const double offset = normal.dot(c + impact.time * step) + clearance / impact.weight;
        const double least = std::min(offset, normal.dot(c));
        if (normal.dot(to) < least - 1e-3 * clearance) halfSpaces.push_back({normal, least});
    }
    return halfSpaces.size() > before;
}

void addApproach(const Corners& star, const Corners& other, const Vec3d& at, double clearance,
                 std::vector<HalfSpace>& halfSpaces)
{
    const Nearness near = nearness(star, other);
    const double distance = std::sqrt(near.squaredDistance);
    const double weight = barycentric(near.onFirst, star)[0];
    if (!(distance > 0) || !(weight > 1e-6)) return;
    const Vec3d apart = (near.onFirst - near.onSecond) / distance;
    halfSpaces.push_back({apart, apart.dot(at) + (clearance - distance) / weight});
}

void addReach(const MoveLimit& limit, const Vec3d& to, std::vector<HalfSpace>& halfSpaces)
{
    const Vec3d way = to - limit.home;
    const double length = way.length();
    if (!(length > limit.radius)) return;
    const Vec3d inward = way / -length;
    halfSpaces.push_back({inward, inward.dot(limit.nearest(to))});
}

void restrictToPlane(int axis, double offset, std::vector<HalfSpace>& halfSpaces)
{
    constexpr double leastSine = 1e-6;
    Vec3d across(0.0);
    across[axis] = 1;
    std::size_t kept = 0;
    for (const HalfSpace& h : halfSpaces) {
        const double height = h.normal.dot(across);
        const Vec3d normal = h.normal - height * across;
        const double length = normal.length();
        if (!(length > leastSine)) continue;
        halfSpaces[kept++] = {normal / length, (h.offset - height * offset) / length};
    }
    halfSpaces.resize(kept);
}

} // namespace vdbcage::detail
