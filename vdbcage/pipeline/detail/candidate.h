#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <vdbcage/mesh/symmetry.h>
#include <vdbcage/mesh/topology.h>
#include <vdbcage/pipeline/detail/search.h>
#include <vdbcage/pipeline/detail/volumes.h>
#include <vdbcage/pipeline/pipeline.h>

namespace vdbcage::detail {

/// The surface that bounding cages of any face count begin with: one around a closing or its convex hull, or a simple
/// solid.
struct StartingSurface {
    CageStart kind = CageStart::closing;
    /// Of a simple solid that which it competes with; of a turned start as if it were not.
    std::shared_ptr<const Closing> closing;
    double offsetVoxels = 0; ///< by how much all of it was grown to keep the clearance
    std::shared_ptr<const Mesh> surface;
    MeshTopology topology;
};

struct KeptStart;

/// A cage and what it was made from.
struct Candidate {
    Voxels voxels;
    CageStart start = CageStart::closing;
    double offsetVoxels = 0;
    std::shared_ptr<KeptStart> from; ///< bounding only
    std::shared_ptr<const Closing> closing;
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
    std::vector<std::string> plan = {}; ///< describe() of the search's
};

} // namespace vdbcage::detail
