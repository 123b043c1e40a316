#include <tools/edit/motion.h>

#include <cmath>
#include <cstddef>
#include <string>

#include <vdbcage/core/detail/number_text.h>
#include <vdbcage/core/detail/pi.h>
#include <vdbcage/core/error.h>

namespace vdbcage::edit {

namespace {

using openvdb::Vec3d;

struct Turn {
    double sine, cosine;
};

/// Returns sine and cosine by the remainder to the nearest multiple of 90 degrees, which is exact.
Turn turnBy(double degrees)
{
    constexpr double radiansPerDegree = detail::pi / 180;
    int quarters = 0;
    const double rest = std::remquo(degrees, 90.0, &quarters) * radiansPerDegree;
    const double sine = std::sin(rest), cosine = std::cos(rest);
    switch (quarters & 3) { // the last bits are right for negative numbers too
    case 0:
        return {sine, cosine};
    case 1:
        return {cosine, -sine};
    case 2:
        return {-sine, -cosine};
    default:
        return {-cosine, sine};
    }
}

void fail(const std::string& problem)
{
    throw InputError("motion", problem);
}

void requireFinite(const Vec3d& v, const char* name)
{
    if (v.isFinite()) return;
    fail(std::string(name) + " is (" + detail::numberText(v.x()) + ", " + detail::numberText(v.y()) + ", " +
         detail::numberText(v.z()) + "); numbers must be finite");
}

void requireUnit(const Vec3d& axis)
{
    constexpr double rounding = 1e-6;
    const double length = axis.length();
    if (std::abs(length - 1) <= rounding) return;
    fail("an axis has the length " + detail::numberText(length) + "; it must be 1");
}

void requireValid(const Move& move)
{
    requireFinite(move.by, "the move");
}

void requireValid(const Rotate& rotate)
{
    requireFinite(rotate.pivot, "the pivot");
    requireUnit(rotate.axis);
    if (!std::isfinite(rotate.degrees))
        fail("the angle is " + detail::numberText(rotate.degrees) + "; it must be finite");
}

void requireValid(const Scale& scale)
{
    constexpr double rounding = 1e-6;
    requireFinite(scale.pivot, "the pivot");
    requireFinite(scale.factors, "the factor");
    for (std::size_t i = 0; i < 3; ++i) {
        requireUnit(scale.axes[i]);
        if (std::abs(scale.axes[i].dot(scale.axes[(i + 1) % 3])) > rounding) fail("its axes are not at right angles");
    }
}

/// Return the displacement of a point.
Vec3d shiftOf(const Vec3d&, double weight, const Move& move)
{
    return weight * move.by;
}

Vec3d shiftOf(const Vec3d& point, double weight, const Rotate& rotate)
{
    // Rodrigues' formula, less the point: no turn makes a shift of exactly 0.
    const Turn turn = turnBy(weight * rotate.degrees);
    const Vec3d across = rotate.axis.cross(point - rotate.pivot);
    return turn.sine * across + (1 - turn.cosine) * rotate.axis.cross(across);
}

Vec3d shiftOf(const Vec3d& point, double weight, const Scale& scale)
{
    const Vec3d arm = point - scale.pivot;
    Vec3d shift(0.0);
    for (int i = 0; i < 3; ++i) {
        const Vec3d& axis = scale.axes[static_cast<std::size_t>(i)];
        shift += weight * (scale.factors[i] - 1) * axis.dot(arm) * axis;
    }
    return shift;
}

} // namespace

std::vector<Vec3d> moved(const std::vector<Vec3d>& points, const std::vector<double>& weights, const Motion& motion)
{
    if (weights.size() != points.size()) {
        fail(std::to_string(weights.size()) + " weights were given for " + std::to_string(points.size()) +
             " points; one for each is needed");
    }
    for (const double weight : weights) {
        if (!(weight >= 0 && weight <= 1)) fail("a weight is " + detail::numberText(weight) + "; it must be 0 to 1");
    }
    return std::visit(
        [&](const auto& of) {
            requireValid(of);
            std::vector<Vec3d> result = points;
            for (std::size_t i = 0; i < points.size(); ++i) {
                if (weights[i] > 0) result[i] += shiftOf(points[i], weights[i], of);
            }
            return result;
        },
        motion);
}

} // namespace vdbcage::edit
