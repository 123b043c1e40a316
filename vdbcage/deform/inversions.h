#pragma once

#include <cstdint>
#include <vector>

#include <vdbcage/core/export.h>
#include <vdbcage/core/interrupter.h>
#include <vdbcage/deform/binding.h>

namespace vdbcage {

/// For each of `poses` (positions of the cage's points) the triangles that it turns inside out. They are sorted indices
/// into triangulate(model). `binding` binds the points of `model`.
///
/// A triangle is inside out if the point just below its middle (by 1e-4 of the model's longest side) is posed above it.
/// So turning, moving and stretching invert nothing, and mirroring everything, by the families that reproduce it (not
/// Green). Rounding decides on triangles that are posed flat. Those thinner at rest than 1e-6 of the cage are left out.
/// The same for any number of threads.
/// \throw InputError the binding has another number of points than the model; a pose another than the cage; a model
/// that is not usable; one of the two points is where the family is not defined
/// \throw Cancelled
/// Cost: binding two points a triangle, whatever the number of poses, and posing them.
VDBCAGE_API std::vector<std::vector<std::uint32_t>>
invertedTriangles(const Binding& binding, const Mesh& model, const std::vector<std::vector<openvdb::Vec3d>>& poses,
                  Interrupter* interrupter = nullptr);

} // namespace vdbcage
