#pragma once

#include <vector>

#include <vdbcage/core/grids.h>
#include <vdbcage/geometry/triangle_bvh.h>
#include <vdbcage/pipeline/pipeline.h>

/// The stages of a cage, and other data that is shown only on request.
namespace vdbcage::view {

/// Distances from a cage to the model.
struct DistanceMap {
    Mesh mesh;                    ///< the cage, its faces cut into small triangles
    std::vector<float> distances; ///< one per point, world units
};

/// Measures some 20,000 points, at least three per triangle of the cage. `model` has the model's triangles.
DistanceMap measureDistances(const Mesh& cage, const detail::TriangleBvh& model);

struct Intermediates {
    std::shared_ptr<const openvdb::MaskGrid> solid, closed;
    Mesh solidFaces, closedFaces; ///< their exposed faces; empty where they are too many to draw
    Mesh solidNodes, closedNodes; ///< a box for each node of their trees, except the root
    Mesh surface, smoothed, decimated;
    DistanceMap distance; ///< of the cage
};

/// Returns those of the last run of `pipeline`. \throw Cancelled
Intermediates intermediatesOf(const Pipeline& pipeline, const detail::TriangleBvh& model, Interrupter* interrupter);

} // namespace vdbcage::view
