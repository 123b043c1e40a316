#include <vdbcage/check/detail/hollows.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>

#include <tbb/blocked_range.h>
#include <vdbcage/check/detail/box_tree.h>
#include <vdbcage/check/detail/predicates.h>
#include <vdbcage/core/detail/asker.h>
#include <vdbcage/core/detail/parallel.h>

namespace vdbcage::detail {

namespace {

/// A component that is closed.
struct Closed {
    bool isMet = false;
    Vec3d point{0.0};             ///< a point of the component, the origin for its volume
    double volume = 0, terms = 0; ///< six times the volume, by the longest edge; and the sum of its absolute terms

    /// Returns 1 if it faces outward, -1 if inward; 0 if rounding may decide, which is less for up to ten million
    /// triangles.
    int sign() const { return !(std::abs(volume) > 1e-8 * terms) ? 0 : volume > 0 ? 1 : -1; }
};

} // namespace

std::size_t countHollows(const std::vector<Vec3d>& points, const FaceTriangles& faces, const MeshTopology& topology,
                         Interrupter* interrupter)
{
    const std::vector<std::uint8_t>& isClosed = topology.componentIsCycle;
    if (std::count(isClosed.begin(), isClosed.end(), 1) < 2) return 0;
    Asker ask(interrupter);
    const auto forEachTriangle = [&](const auto& visit) {
        for (std::size_t t = 0; t < faces.size(); ++t) {
            ask();
            const std::uint32_t component = topology.faceComponent[faces.face(t)];
            if (isClosed[component] != 0 && faces.ofFirstDiagonal(t)) visit(component, faces[t]);
        }
    };
    double longest = 0;
    forEachTriangle(
        [&](std::uint32_t, const Vec3I& t) { longest = std::max(longest, (points[t[1]] - points[t[0]]).length()); });
    std::vector<Closed> components(topology.components());
    forEachTriangle([&](std::uint32_t component, const Vec3I& t) {
        Closed& here = components[component];
        if (!here.isMet) here.point = points[t[0]];
        here.isMet = true;
        const auto from = [&](int corner) { return (points[t[corner]] - here.point) / longest; };
        const double term = from(0).dot(from(1).cross(from(2)));
        here.volume += term;
        here.terms += std::abs(term);
    });
    const auto isAny = [&](int sign) {
        return std::any_of(components.begin(), components.end(), [&](const Closed& c) { return c.sign() == sign; });
    };
    if (!isAny(1) || !isAny(-1)) return 0; // as nearly always

    std::vector<Vec3I> triangles;
    std::vector<std::uint32_t> componentOf;
    forEachTriangle([&](std::uint32_t component, const Vec3I& t) {
        triangles.push_back(t);
        componentOf.push_back(component);
    });
    const BoxTree tree(points, triangles, BoxTree::Copies::keep, interrupter);
    const auto count = [&](const tbb::blocked_range<std::size_t>& range, std::size_t found) {
        for (std::size_t i = range.begin(); i < range.end(); ++i) {
            throwIfInterrupted(interrupter);
            const int sign = components[i].sign();
            if (sign == 0) continue;
            const Vec3d& p = components[i].point;
            const Box ray{p, {std::numeric_limits<double>::infinity(), p[1], p[2]}};
            int winding = 0; // of the others
            tree.inBox(ray, [&](const BoxTree::Item& item) {
                const Corners corners{points[item.corners[0]], points[item.corners[1]], points[item.corners[2]]};
                if (componentOf[item.triangle] != i) winding += rayCrossing(corners, p);
                return true;
            });
            if (winding == -sign) ++found;
        }
        return found;
    };
    return parallelReduce(tbb::blocked_range<std::size_t>(0, components.size()), std::size_t(0), count, std::plus<>());
}

} // namespace vdbcage::detail
