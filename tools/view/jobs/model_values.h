#pragma once

#include <cstdint>
#include <vector>

#include <vdbcage/deform/binding.h>

/// What colours of a model tell about its pose: a value for each of its points.
namespace vdbcage::view {

/// How far each point goes when some of the cage's points move by a small step, as a part of that step; the mean over
/// the three axes. Where the weights of the cage's points are all that moves it, as by mean value and maximum
/// likelihood coordinates, that is the sum of their weights. Green coordinates add what the faces' normals do. \pre
/// `points` are numbers of points of the cage Cost: three times Binding::pose.
std::vector<double> influence(const Binding& binding, const std::vector<openvdb::Index32>& points);

/// How much longer lengths became around each point: the logarithm, to the base 2, of the root of how much larger the
/// area of its faces became; 0 where no face has an area. Within [-4, 4].
/// \pre one of `posed` for each point of the mesh
/// Cost: O(faces).
std::vector<double> stretch(const Mesh& mesh, const std::vector<openvdb::Vec3d>& posed);

/// 1 for the corners of the triangles that are named by their indices into triangulate(mesh), 0 for other points.
std::vector<double> cornersOf(const std::vector<std::uint32_t>& triangles, const Mesh& mesh);

} // namespace vdbcage::view
