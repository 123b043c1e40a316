#include <vdbcage/deform/detail/point_checks.h>

#include <vdbcage/core/detail/number_text.h>
#include <vdbcage/core/error.h>

namespace vdbcage::detail {

using openvdb::Vec3d;

std::string toText(const Vec3d& p)
{
    return "(" + numberText(p.x()) + ", " + numberText(p.y()) + ", " + numberText(p.z()) + ")";
}

void requireFinite(const std::vector<Vec3d>& points, const char* what)
{
    for (std::size_t i = 0; i < points.size(); ++i) {
        if (!points[i].isFinite()) {
            throw InputError(what, "point " + std::to_string(i) + " is " + toText(points[i]) +
                                       "; coordinates must be finite");
        }
    }
}

void requireCount(const char* what, std::size_t count, std::size_t needed, const char* of)
{
    if (count != needed) {
        throw InputError(what, "it has " + std::to_string(count) + " points; " + of + " has " + std::to_string(needed));
    }
}

} // namespace vdbcage::detail
