#include <vdbcage/mesh/detail/precision.h>

#include <charconv>
#include <cmath>
#include <cstdio>
#include <string>

#include <vdbcage/core/detail/longest_side.h>
#include <vdbcage/core/detail/nearest_float.h>
#include <vdbcage/core/detail/number_text.h>
#include <vdbcage/core/error.h>

namespace vdbcage::detail {

namespace {

/// The largest rounding to float, over the longest side. With more, voxels have no room between floats.
constexpr double largestRounding = 1e-3;

/// Returns the shift that brings the middle of `box` near the origin, in a multiple of a power of ten.
std::string shiftOf(const openvdb::BBoxd& box, double side)
{
    const double unit = std::pow(10, std::ceil(std::log10(side)));
    std::string text;
    for (int axis = 0; axis < 3; ++axis) {
        const double shift = 0.0 - unit * std::round(box.getCenter()[axis] / unit); // no -0
        char digits[400];                                                           // of the largest double
        const char* const end = std::to_chars(digits, digits + sizeof digits, shift, std::chars_format::fixed).ptr;
        text += (axis == 0 ? "(" : ", ") + std::string(digits, static_cast<std::size_t>(end - digits));
    }
    return text + ")";
}

} // namespace

bool areFloats(Precision precision, const openvdb::BBoxd& box)
{
    return precision == Precision::float32 || (precision == Precision::automatic && fitsFloat(box));
}

void requireHeld(Precision precision, const openvdb::BBoxd& box)
{
    if (precision != Precision::float32) return;
    const std::string formats = "; .obj, .off and .ply files hold float64";
    if (isBeyondFloat(box)) {
        throw InputError("model", "it is too large or too small for float32" + formats);
    }
    const double side = longestSide(box), rounding = floatRounding(box) / side;
    if (rounding <= largestRounding) return;
    char percent[32];
    std::snprintf(percent, sizeof percent, "%.2g", 100 * rounding);
    throw InputError("model", "it is so far from the origin that float32 rounds coordinates by up to " +
                                  std::string(percent) + " % of its longest side; at most " +
                                  numberText(100 * largestRounding) + " % is allowed: move it by " +
                                  shiftOf(box, side) + " first" + formats);
}

Mesh asFloats(Mesh mesh)
{
    for (openvdb::Vec3d& point : mesh.points) point = nearestFloat(point);
    return mesh;
}

} // namespace vdbcage::detail
