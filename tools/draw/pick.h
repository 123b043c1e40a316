#pragma once

#include <cstddef>
#include <optional>

#include <tools/draw/camera.h>
#include <tools/draw/geometry.h>
#include <tools/draw/renderer.h>

namespace vdbcage::draw {

/// The point where a ray meets a face.
struct Hit {
    double distance = 0;  ///< along the ray
    std::size_t face = 0; ///< of the mesh, triangles first
    openvdb::Vec3d point; ///< in drawing coordinates
};

/// Returns the first hit of a face, from either side, that the section does not cut off. O(faces): some 10 ns each.
/// Rounded: a ray that passes a face by less than 1e-9 of its size meets it, so that no edge is missed.
std::optional<Hit> nearestHit(const Ray& ray, const Geometry& geometry, const std::optional<Section>& section = {});

} // namespace vdbcage::draw
