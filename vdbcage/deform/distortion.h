#pragma once

#include <optional>
#include <vector>

#include <vdbcage/core/export.h>
#include <vdbcage/mesh/mesh.h>

namespace vdbcage {

/// The distortion of a model by a pose: how its surface is stretched, and how its volume changes.
struct Distortion {
    /// Mean, by area at rest, of the triangles' symmetric Dirichlet energies over 4:
    /// (s1^2 + s2^2 + 1 / s1^2 + 1 / s2^2) / 4 for the principal stretches s1 and s2. An energy is 1 where nothing is
    /// stretched, and infinite where a triangle is posed without area.
    double mean = 1;
    double percentile99 = 1; ///< the energy that 99 % of the area at rest do not exceed
    /// Ratio, posed over rest; unset where the model has none: it is open, or its volume at rest is not positive.
    std::optional<double> volume;
};

/// Returns the distortion of a posed model. Triangles without area at rest are left out.
/// \param model at rest, as for requireUsable()
/// \param posed the model's points in the pose: as many, in the same order, finite
/// \throw InputError when there are not as many points as the model has, or one is not finite; when the model is not
/// usable, or has no area
/// Cost: O(n log n) for n triangles.
/// Based on: Smith, Schaefer, Bijective Parameterization with Free Boundaries, 2015 (the energy).
VDBCAGE_API Distortion poseDistortion(const Mesh& model, const std::vector<openvdb::Vec3d>& posed);

} // namespace vdbcage
