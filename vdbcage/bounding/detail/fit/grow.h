#pragma once

#include <cstdint>

#include <vdbcage/bounding/detail/fit/demands.h>
#include <vdbcage/bounding/detail/guard/guarded_mesh.h>
#include <vdbcage/core/interrupter.h>

/// Grows a surface that may cut a model until it bounds it.
namespace vdbcage::detail {

/// The patience with places that do not get on.
struct GrowthPace {
    int patience;  ///< rounds until their surroundings are smoothed
    int mostRings; ///< of these surroundings, at most
};

/// Moves the vertices of a surface until it bounds its guard's model and all its quads are made. Its faces never meet
/// each other on the way, and a face that is clear of the model stays so. Returns whether it bounds; if not, the faces
/// that still cut are those that mayCut().
/// \param surface of triangles; each two from `firstOfQuads` on are to be a quad
/// \param finder of the same model
/// \throw Cancelled
/// Based on: shared ideas of Sacht et al., Nested Cages, 2015 (the cage gives way step by step), and of Li et al.,
/// Incremental Potential Contact, 2020 (no step makes faces meet).
/// Differs: the model does not move. The parts of it that are outside, and the faces that it cuts, pull the cage; each
/// vertex is placed among its contacts, and quads that are in the way are two triangles for a while.
bool grow(GuardedMesh& surface, std::uint32_t firstOfQuads, const GrowthPace& pace, DemandFinder& finder,
          Interrupter* interrupter);

} // namespace vdbcage::detail
