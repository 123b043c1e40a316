#pragma once

#include <cstddef>
#include <vector>

#include <openvdb/Types.h>
#include <vdbcage/deform/detail/coordinate_family.h>

namespace vdbcage::detail {

/// Appends the stretched normals at `corners` to `handles`. Each corner comes with the next corner of its face and the
/// one before.
///
/// The length at rest is the area of the parallelogram of the two edges, over the cage's longest side. The pose
/// multiplies it by the root mean square of the parallelogram's principal stretches. A normal is zero if its posed
/// parallelogram is flat.
void addStretchedNormals(const Mesh& cage, const std::vector<openvdb::Vec3d>& posed,
                         const std::vector<openvdb::Vec3I>& corners, std::vector<openvdb::Vec3d>& handles);

/// Appends to `reach` about how far the normals move if edges get up to twice as long.
void addNormalReach(const Mesh& cage, const std::vector<openvdb::Vec3I>& corners, std::vector<float>& reach);

/// Returns the handles of a family that has stretched normals at the corners from `cornersOf`.
template <std::vector<openvdb::Vec3I> (*cornersOf)(const Mesh& cage)>
constexpr VectorHandles stretchedNormals(std::size_t perTriangle, std::size_t perQuad)
{
    return {perTriangle, perQuad,
            [](const Mesh& cage, const std::vector<openvdb::Vec3d>& posed, const CoordinateOptions&,
               std::vector<openvdb::Vec3d>& handles) { addStretchedNormals(cage, posed, cornersOf(cage), handles); },
            [](const Mesh& cage, std::vector<float>& reach) { addNormalReach(cage, cornersOf(cage), reach); }};
}

} // namespace vdbcage::detail
