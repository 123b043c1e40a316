#include <vdbcage/surface/detail/meetings.h>

#include <algorithm>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/intersections.h>

namespace vdbcage::detail {

namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;

Kernel::Point_3 exact(const Vec3d& p)
{
    return {p[0], p[1], p[2]};
}

} // namespace

Meetings::Meetings(Mesh& mesh) : mesh_(mesh), around_(mesh.points.size())
{
    std::uint32_t face = 0;
    for (const Vec3I& t : mesh.triangles) triangles_.push_back({t, face++, 0});
    for (const openvdb::Vec4I& q : mesh.quads) {
        triangles_.push_back({{q[0], q[1], q[2]}, face, 0});
        triangles_.push_back({{q[0], q[2], q[3]}, face, 0});
        triangles_.push_back({{q[1], q[2], q[3]}, face, 1});
        triangles_.push_back({{q[1], q[3], q[0]}, face++, 1});
    }
    std::vector<Box> boxes;
    for (std::uint32_t i = 0; i < triangles_.size(); ++i) {
        for (int k = 0; k < 3; ++k) around_[triangles_[i].corners[k]].push_back(i);
        boxes.push_back(boxOf(i));
        degenerate_.push_back(hasNoArea(cornersOf(i)));
    }
    tree_ = DynamicBvh(std::move(boxes));
}

std::vector<Meetings::Pair> Meetings::pairs(Interrupter* interrupter) const
{
    std::vector<Pair> result;
    for (std::uint32_t i = 0; i < triangles_.size() && result.size() < most; ++i) {
        throwIfInterrupted(interrupter);
        forEachMeeting(i, [&](std::uint32_t other) {
            if (i < other && result.size() < most) result.push_back({i, other});
        });
    }
    std::sort(result.begin(), result.end());
    return result;
}

void Meetings::move(std::uint32_t point, const Vec3d& place)
{
    mesh_.points[point] = place;
    for (const std::uint32_t i : around_[point]) {
        tree_.update(i, boxOf(i));
        degenerate_[i] = hasNoArea(cornersOf(i));
    }
    tree_.refit();
}

Box Meetings::boxOf(std::uint32_t triangle) const
{
    return Box::of(cornersOf(triangle));
}

bool Meetings::isEdge(std::uint32_t face, std::uint32_t a, std::uint32_t b) const
{
    if (face < mesh_.triangles.size()) return true; // any two of its corners are an edge
    const openvdb::Vec4I& q = mesh_.quads[face - mesh_.triangles.size()];
    for (int i = 0; i < 4; ++i) {
        if ((q[i] == a && q[(i + 1) % 4] == b) || (q[i] == b && q[(i + 1) % 4] == a)) return true;
    }
    return false;
}

bool Meetings::meet(std::uint32_t a, std::uint32_t b) const
{
    const SplitTriangle &first = triangles_[a], &second = triangles_[b];
    const bool sameFace = first.face == second.face;
    if (a == b || (sameFace && first.diagonal != second.diagonal) || isDegenerate(b)) return false;
    const Vec3I &s = first.corners, &t = second.corners;
    std::array<int, 3> inS{}, inT{}; // places of the shared corners
    std::size_t shared = 0;
    for (int i = 0; i < 3; ++i) {
        for (int k = 0; k < 3; ++k) {
            if (s[i] != t[k]) continue;
            inS[shared] = i;
            inT[shared++] = k;
        }
    }
    const auto place = [&](std::uint32_t point) { return exact(mesh_.points[point]); };
    const auto whole = [&](const Vec3I& x) { return Kernel::Triangle_3(place(x[0]), place(x[1]), place(x[2])); };
    const auto opposite = [&](const Vec3I& x, int corner) {
        return Kernel::Segment_3(place(x[(corner + 1) % 3]), place(x[(corner + 2) % 3]));
    };
    switch (shared) {
    case 0:
        return CGAL::do_intersect(whole(s), whole(t));
    case 1:
        return CGAL::do_intersect(whole(s), opposite(t, inT[0])) || CGAL::do_intersect(whole(t), opposite(s, inS[0]));
    case 2: {
        const std::uint32_t u = s[inS[0]], v = s[inS[1]];
        // A diagonal of one face lies on the other.
        if (!sameFace && !(isEdge(first.face, u, v) && isEdge(second.face, u, v))) return true;
        const Kernel::Point_3 x = place(s[3 - inS[0] - inS[1]]), y = place(t[3 - inT[0] - inT[1]]);
        return CGAL::coplanar(place(u), place(v), x, y) &&
               CGAL::coplanar_orientation(place(u), place(v), x, y) == CGAL::POSITIVE;
    }
    default:
        return true;
    }
}

} // namespace vdbcage::detail
