#include <vdbcage/volume/detail/factor_at.h>

#include <sstream>

#include <vdbcage/core/detail/asker.h>
#include <vdbcage/core/error.h>

namespace vdbcage::detail {

void requireValid(const FactorRegion& region)
{
    const auto require = [](bool isRight, const char* name, const auto& value, const auto&... allowed) {
        if (isRight) return;
        std::ostringstream text;
        text << name << " of a region is " << value << "; it must be ";
        (text << ... << allowed);
        throw InputError(text.str());
    };
    // Every comparison refuses NaN.
    require(region.factor >= 0 && region.factor <= largestFactor, "the factor", region.factor, "between 0 and ",
            largestFactor);
    require(region.radius >= 0 && std::isfinite(region.radius), "the radius", region.radius, "at least 0");
    require(region.lower.isFinite(), "the place", region.lower, "finite");
    require(region.upper.isFinite(), "the upper corner", region.upper, "finite");
}

void requireValidDensity(const FactorField& field, Interrupter* interrupter)
{
    for (const FactorRegion& region : field.regions) requireValid(region);
    if (!field.grid) return;
    if (!field.grid->transform().isLinear()) throw InputError("the transform of the density must be linear");
    Asker ask(interrupter);
    for (auto value = field.grid->cbeginValueAll(); value; ++value) {
        ask();
        if (!std::isfinite(*value)) throw InputError("the density has a value that is not finite");
    }
    if (!std::isfinite(field.grid->background())) {
        throw InputError("the background of the density is not finite");
    }
}

bool contains(const FactorRegion& region, const openvdb::Vec3d& point)
{
    if (region.shape == FactorRegion::Shape::sphere) {
        return (point - region.lower).lengthSqr() <= region.radius * region.radius;
    }
    for (int axis = 0; axis < 3; ++axis) {
        if (point[axis] < region.lower[axis] || point[axis] > region.upper[axis]) return false;
    }
    return true;
}

} // namespace vdbcage::detail
