#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <vdbcage/bounding/detail/quads/quad_shape_term.h>
#include <vdbcage/core/interrupter.h>

/// Moving the vertices of quads to where both distance and shape are better, while the guard holds their triangles.
namespace vdbcage::detail {

/// The integral of the distance over a mean face, a quad counted once: what the weights of shapes are parts of.
double distancePerPolygon(const GuardedMesh& surface, const QuadTable& table, double areaPerSample,
                          Interrupter* interrupter);

/// How many quads are not fit, and what one counts for in parts of the distance of a mean quad.
std::size_t countUnfit(const GuardedMesh& surface, const QuadTable& table);
constexpr double unfitWeight = 8;

/// The weights of the shape while loops come and go, in parts of the distance of a mean quad; and those of a surface.
constexpr ShapeWeights usualShape{0.35, 0.15, 0, 0.35, unfitWeight};
ShapeWeights scaled(const ShapeWeights& weights, double distance);
/// The term of the surface as it is now, with weights that are parts of the distance of a mean quad.
QuadShapeTerm shapeTerm(const GuardedMesh& surface, const QuadTable& table, const ShapeWeights& weights,
                        double areaPerSample, Interrupter* interrupter);

/// The area for each sample of the distance.
double areaPerSample(const GuardedMesh& surface);

/// tighten() with the shape that quads have while loops come and go, all vertices or some.
void relaxQuads(GuardedMesh& surface, const QuadTable& table, int sweeps, Interrupter* interrupter);
void relaxQuads(GuardedMesh& surface, const QuadTable& table, const std::vector<std::uint32_t>& vertices, int sweeps,
                Interrupter* interrupter);

/// tighten() with the quads' shape. `weights` are parts of the distance of a mean quad as the surface is now.
void relaxQuads(GuardedMesh& surface, const QuadTable& table, const ShapeWeights& weights, int sweeps,
                Interrupter* interrupter);

/// Moves some vertices, each once, along the surface to where the quads of a table around them are nearer to
/// parallelograms. That gets quads convex that are not, which no small step does.
void straighten(GuardedMesh& surface, const QuadTable& table, const std::vector<std::uint32_t>& vertices,
                Interrupter* interrupter);

} // namespace vdbcage::detail
