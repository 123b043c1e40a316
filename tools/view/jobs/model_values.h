#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include <vdbcage/deform/binding.h>

/// Values that colours of a model show about its pose, one for each of its points.
namespace vdbcage::view {

/// One value for each point of the model; null: none.
using ModelValues = std::shared_ptr<const std::vector<double>>;

/// Returns how far each point moves when some of the cage's points move by a small step, as a fraction of that step;
/// the mean over the three axes. Where only the weights of the cage's points move it, as with mean value and maximum
/// likelihood coordinates, that is the sum of their weights. Green coordinates add the effect of the faces' normals.
/// \pre `points` are points of the cage
/// Cost: three times Binding::pose.
std::vector<double> influence(const Binding& binding, const std::vector<openvdb::Index32>& points);

/// Returns how much longer lengths became around each point: the logarithm, to the base 2, of the root of the ratio of
/// its faces' areas after and before; 0 where no face has an area. Within [-4, 4].
/// \pre one of `posed` for each point of the mesh
/// Cost: O(faces).
std::vector<double> stretch(const Mesh& mesh, const std::vector<openvdb::Vec3d>& posed);

/// Returns 1 for the corners of the triangles with these indices into triangulate(mesh), 0 for other points.
std::vector<double> cornersOf(const std::vector<std::uint32_t>& triangles, const Mesh& mesh);

} // namespace vdbcage::view
