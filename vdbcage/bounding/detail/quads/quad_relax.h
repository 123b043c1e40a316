#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <vdbcage/bounding/detail/quads/quad_shape_term.h>
#include <vdbcage/core/interrupter.h>

/// Operators that move the vertices of quads to where both distance and shape are better, while the guard holds the
/// triangles.
namespace vdbcage::detail {

/// Returns the integral of the distance over a mean face, a quad counted once: the unit of the weights of shapes.
double distancePerPolygon(const GuardedMesh& surface, const QuadTable& table, double areaPerSample,
                          Interrupter* interrupter);

/// Returns the number of quads that are not fit.
std::size_t countUnfit(const GuardedMesh& surface, const QuadTable& table);

/// The weight of a quad that is not fit, in parts of the distance of a mean quad.
constexpr double unfitWeight = 8;

/// The weights of the shape while connectivity changes, in parts of the distance of a mean quad.
constexpr ShapeWeights usualShape{0.35, 0.15, 0, 0.35, unfitWeight};
/// Returns the weights times the distance of a mean quad.
ShapeWeights scaled(const ShapeWeights& weights, double distance);
/// Returns the term of the surface as it is now. `weights` are parts of the distance of a mean quad.
QuadShapeTerm shapeTerm(const GuardedMesh& surface, const QuadTable& table, const ShapeWeights& weights,
                        double areaPerSample, Interrupter* interrupter);

/// Returns the area for each sample of the distance.
double areaPerSample(const GuardedMesh& surface);

/// Tightens all vertices or some, with `usualShape`.
void relaxQuads(GuardedMesh& surface, const QuadTable& table, int sweeps, Interrupter* interrupter);
void relaxQuads(GuardedMesh& surface, const QuadTable& table, const std::vector<std::uint32_t>& vertices, int sweeps,
                Interrupter* interrupter);

/// Tightens with the quads' shape. `weights` are parts of the distance of a mean quad of the surface as it is now.
void relaxQuads(GuardedMesh& surface, const QuadTable& table, const ShapeWeights& weights, int sweeps,
                Interrupter* interrupter);

/// Moves some vertices, each once, along the surface to where the table's quads around them are nearer to
/// parallelograms. That makes quads convex where no small step does.
void straighten(GuardedMesh& surface, const QuadTable& table, const std::vector<std::uint32_t>& vertices,
                Interrupter* interrupter);

} // namespace vdbcage::detail
