#pragma once

#include <vector>

#include <vdbcage/core/grids.h>
#include <vdbcage/geometry/triangle_bvh.h>
#include <vdbcage/pipeline/pipeline.h>

/// What a cage was made through, and what else is seen only when it is asked for.
namespace vdbcage::view {

/// Distances from a cage to the model.
struct DistanceMap {
    Mesh mesh;                    ///< the cage, its faces cut into small triangles
    std::vector<float> distances; ///< one a point, world units
};

/// `model` has the triangles of the model. Some 20,000 points are measured, three a face at least.
DistanceMap measureDistances(const Mesh& cage, const detail::TriangleBvh& model);

struct Intermediates {
    std::shared_ptr<const openvdb::MaskGrid> solid, closed;
    Mesh solidFaces, closedFaces; ///< their exposed faces; empty where they are too many to be drawn
    Mesh solidNodes, closedNodes; ///< a box for each node of their trees, but the root
    Mesh surface, smoothed, decimated;
    DistanceMap distance; ///< of the cage
};

/// Of the last run of `pipeline`. \throw Cancelled
Intermediates intermediatesOf(const Pipeline& pipeline, const detail::TriangleBvh& model, Interrupter* interrupter);

} // namespace vdbcage::view
