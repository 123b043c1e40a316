#pragma once

#include <array>
#include <vector>

#include <openvdb/math/Vec3.h>
#include <tools/vdbcage/render.h>
#include <tools/vdbcage/render_geometry.h>

namespace vdbcage::render {

/// As OpenGL takes it: column by column.
using Matrix = std::array<float, 16>;

/// An eye that looks along -z of its own coordinates (x to the right, y up), in a frame's units.
struct Eye {
    openvdb::Vec3d right, up, back; ///< unit
    openvdb::Vec3d position;
    double halfWidth = 0, halfHeight = 0; ///< of what it sees at distance 1
    double nearest = 0, farthest = 0;     ///< distances
};

/// A part of a panel: its middle and half its size, where the panel is [-1, 1] both ways, y up.
struct Crop {
    double x = 0, y = 0, halfWidth = 1, halfHeight = 1;
};

/// \throw InputError if a value is out of range
void requireView(const View& view);

/// The eye nearest to the geometries that sees all of them with a small margin; `aspect` is width / height of the
/// panel. Exact for the points and O(n): each side of the view is pushed against the points' extreme in its direction.
Eye fitEye(const View& view, const std::vector<const Geometry*>& geometries, double aspect);

/// From the frame to the eye's coordinates.
Matrix viewMatrix(const Eye& eye);

/// From the frame to OpenGL's clip space, where the crop fills the picture.
Matrix clipMatrix(const Eye& eye, const Crop& crop);

} // namespace vdbcage::render
