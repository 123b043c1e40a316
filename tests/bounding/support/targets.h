#pragma once

#include <cstddef>

#include <vdbcage/bounding/decimate.h>
#include <vdbcage/bounding/quad_loops.h>
#include <vdbcage/bounding/triquad.h>

namespace vdbcage::test {

inline BoundingDecimateOptions to(std::size_t faces, Effort effort = Effort::fair)
{
    return {faces, effort};
}

inline BoundingTriquadOptions quads(std::size_t faces, double degrees)
{
    BoundingTriquadOptions options;
    options.faces = faces;
    options.mergeAngleDegrees = degrees;
    return options;
}

inline QuadLoopsOptions loops(std::size_t faces)
{
    QuadLoopsOptions options;
    options.faces = faces;
    return options;
}

} // namespace vdbcage::test
