#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <vdbcage/mesh/symmetry.h>
#include <vdbcage/mesh/topology.h>
#include <vdbcage/pipeline/detail/search_policy.h>
#include <vdbcage/pipeline/detail/stages/volumes.h>
#include <vdbcage/pipeline/pipeline.h>

namespace vdbcage::detail {

/// Returns whether a start is a solid other than a closing or its hull. Such a one is a cage already.
constexpr bool isSimpleSolid(CageStart kind)
{
    return kind == CageStart::orientedBox || kind == CageStart::tetrahedron;
}

/// The surface from which bounding cages of any face count are made: one around a closing or its convex hull, or a
/// simple solid.
struct StartingSurface {
    CageStart kind = CageStart::closing;
    /// For a simple solid the closing that it competes with; for a turned start the closing without the turn.
    std::shared_ptr<const Closing> closing;
    double offsetVoxels = 0; ///< by which all of it was grown to keep the clearance
    std::shared_ptr<const Mesh> surface;
    MeshTopology topology;
};

struct KeptStart;

/// A start, and later the cage made of it.
struct Candidate {
    Voxels voxels;
    CageStart startKind = CageStart::closing;
    double offsetVoxels = 0;
    std::shared_ptr<KeptStart> keptStart; ///< bounding only
    std::shared_ptr<const Closing> closing;
    std::shared_ptr<const Mesh> surface;
    MeshTopology topology; ///< of the surface
    Mesh decimated, smoothed, cage;
    CageCheck check;
    double looseness = 0; ///< the cage's mean distance, weighted by the density
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
