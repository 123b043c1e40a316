#pragma once

#include <cstddef>

#include <vdbcage/surface/decimate.h>
#include <vdbcage/surface/triquad.h>

namespace vdbcage::test {

inline DecimateOptions to(std::size_t faces)
{
    DecimateOptions options;
    options.faces = faces;
    return options;
}

inline BoundingTriquadOptions quads(std::size_t faces, double degrees)
{
    BoundingTriquadOptions options;
    options.faces = faces;
    options.mergeAngleDegrees = degrees;
    return options;
}

} // namespace vdbcage::test
