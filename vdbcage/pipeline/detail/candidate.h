#pragma once

#include <memory>
#include <optional>
#include <string>

#include <vdbcage/bounding/detail/triangles/recorded_decimation.h>
#include <vdbcage/mesh/symmetry.h>
#include <vdbcage/mesh/topology.h>
#include <vdbcage/pipeline/detail/search.h>
#include <vdbcage/pipeline/detail/volumes.h>
#include <vdbcage/pipeline/pipeline.h>

namespace vdbcage::detail {

/// What bounding cages of any face count begin with: a surface around a closing or its convex hull, or a simple solid.
struct StartingSurface {
    CageStart kind = CageStart::closing;
    std::shared_ptr<Closing>
        closing; ///< of a simple solid that which it competes with; of a turned start as if it were not
    bool turned = false;
    double offsetVoxels = 0; ///< by how much all of it was grown to keep the clearance
    std::shared_ptr<const Mesh> surface;
    MeshTopology topology;
    std::optional<RecordedDecimation> decimation; ///< once it was asked for
    bool isUsed = true;                           ///< in this run
};

/// A cage and what it was made from.
struct Candidate {
    Voxels voxels;
    CageStart start = CageStart::closing;
    double offsetVoxels = 0;
    std::shared_ptr<StartingSurface> from; ///< bounding only
    std::shared_ptr<Closing> closing;
    std::shared_ptr<const Mesh> surface;
    MeshTopology topology; ///< of the surface
    Mesh decimated, smoothed, cage;
    CageCheck check;
    double looseness = 0; ///< its mean distance, as the density counts it
    double sideShare = 1; ///< shareOfSide()
    bool boundsAsFloats = false;
    bool repaired = false;
    std::optional<double> minAngle = {}; ///< degrees, that the guard kept
    std::optional<Symmetry> symmetry = {};
    std::optional<TiltedSymmetry> tiltedSymmetry = {};
    std::string noSymmetry = {};
};

} // namespace vdbcage::detail
