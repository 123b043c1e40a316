#pragma once

#include <optional>
#include <vector>

#include <vdbcage/core/export.h>
#include <vdbcage/mesh/mesh.h>

namespace vdbcage {

/// How a pose stretches a model's surface, and what becomes of its volume.
struct Distortion {
    /// The symmetric Dirichlet energy of a triangle, over 4: (s1^2 + s2^2 + 1 / s1^2 + 1 / s2^2) / 4 for the principal
    /// stretches s1 and s2. It is 1 where nothing is stretched, and infinite where a triangle is posed without area.
    /// The mean by area at rest.
    double mean = 1;
    double percentile99 = 1; ///< what 99 % of the area at rest do not exceed
    /// Posed over rest; unset where the model has none: it is open, or its volume at rest is not positive.
    std::optional<double> volume;
};

/// How a model whose points are posed at `posed` is distorted. Triangles without area at rest are left out.
/// \throw InputError not as many points as the model has; one not finite; the model is not usable, or has no area
/// Cost: O(n log n) for n triangles.
/// Based on: Smith, Schaefer, Bijective Parameterization with Free Boundaries, 2015 (the energy).
VDBCAGE_API Distortion poseDistortion(const Mesh& model, const std::vector<openvdb::Vec3d>& posed);

} // namespace vdbcage
