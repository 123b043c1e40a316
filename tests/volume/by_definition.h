#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdlib>
#include <vector>

#include <vdbcage/volume/morphology.h>

#include "volume/masks.h"

/// Dilation and erosion as they are defined: slow, and plain to see.
namespace vdbcage::test {

inline bool isInElement(const Coord& d, double radius, StructuringElement element)
{
    if (element == StructuringElement::cube)
        return std::max({std::abs(d.x()), std::abs(d.y()), std::abs(d.z())}) <= radius;
    return d.x() * d.x() + d.y() * d.y() + d.z() * d.z() <= radius * radius;
}

inline std::vector<Coord> offsets(double radius, StructuringElement element)
{
    std::vector<Coord> result;
    const CoordBBox box = grown(CoordBBox(Coord(0), Coord(0)), static_cast<int>(radius));
    for (auto c = box.begin(); c; ++c) {
        if (isInElement(*c, radius, element)) result.push_back(*c);
    }
    return result;
}

/// The box of the result leaves room for an erosion by the same radius.
inline DenseSet dilatedByDefinition(const DenseSet& set, double radius, StructuringElement element)
{
    DenseSet result(grown(set.box(), 2 * static_cast<int>(radius) + 1));
    const auto voxels = offsets(radius, element);
    for (auto c = set.box().begin(); c; ++c) {
        if (!set[*c]) continue;
        for (const Coord& d : voxels) result.set(*c + d, true);
    }
    return result;
}

/// \pre `set` leaves a border of empty voxels as wide as the radius
inline DenseSet erodedByDefinition(const DenseSet& set, double radius, StructuringElement element)
{
    std::vector<std::ptrdiff_t> steps;
    const Coord first = set.box().min();
    const Coord middle = first + Coord(static_cast<int>(radius));
    for (const Coord& d : offsets(radius, element)) {
        steps.push_back(static_cast<std::ptrdiff_t>(set.index(middle + d)) -
                        static_cast<std::ptrdiff_t>(set.index(middle)));
    }
    DenseSet result(set.box());
    for (auto c = set.box().begin(); c; ++c) {
        if (!set[*c]) continue;
        const char* const bits = set.bits().data() + set.index(*c);
        result.set(*c, std::all_of(steps.begin(), steps.end(), [&](std::ptrdiff_t step) { return bits[step] != 0; }));
    }
    return result;
}

} // namespace vdbcage::test
