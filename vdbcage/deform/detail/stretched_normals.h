#pragma once

#include <cstddef>
#include <vector>

#include <openvdb/Types.h>
#include <vdbcage/deform/detail/coordinate_family.h>

namespace vdbcage::detail {

/// Appends the stretched normals at `corners`, each with the next corner of its face and the one before, to `handles`.
///
/// The length at rest is the area of the parallelogram of the two edges, over the cage's longest side. The pose
/// multiplies it by the root mean square of the parallelogram's principal stretches. A normal is zero if its posed
/// parallelogram is flat.
void addStretchedNormals(const Mesh& cage, const std::vector<openvdb::Vec3d>& posed,
                         const std::vector<openvdb::Vec3I>& corners, std::vector<openvdb::Vec3d>& handles);

/// Appends how far they go, about, if edges get up to twice as long.
void addNormalMaxDistances(const Mesh& cage, const std::vector<openvdb::Vec3I>& corners,
                           std::vector<float>& maxDistances);

/// The handles of a family that has stretched normals at the corners that `cornersOf` finds.
template <std::vector<openvdb::Vec3I> (*cornersOf)(const Mesh& cage)>
constexpr Vectors stretchedNormals(std::size_t perTriangle, std::size_t perQuad)
{
    return {perTriangle, perQuad,
            [](const Mesh& cage, const std::vector<openvdb::Vec3d>& posed, const CoordinateOptions&,
               std::vector<openvdb::Vec3d>& handles) { addStretchedNormals(cage, posed, cornersOf(cage), handles); },
            [](const Mesh& cage, std::vector<float>& maxDistances) {
                addNormalMaxDistances(cage, cornersOf(cage), maxDistances);
            }};
}

} // namespace vdbcage::detail
