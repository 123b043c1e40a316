#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include <openvdb/Types.h>
#include <tools/draw/camera.h>
#include <tools/draw/colour.h>
#include <tools/view/state/state.h>

/// Handles that move, turn and scale what is selected: where they are seen, which one is under the pointer, and what a
/// drag of it amounts to. Pixels count from the picture's top left.
namespace vdbcage::view {

/// What one grabs.
struct Handle {
    enum class Kind : std::uint8_t {
        axis,  ///< along it, around it
        plane, ///< across it: the two other axes
        screen ///< in the plane of the picture, around the line of sight, all axes alike
    };
    Kind kind = Kind::screen;
    int axis = 0;
};
inline bool operator==(const Handle& a, const Handle& b)
{
    return a.kind == b.kind && (a.kind == Handle::Kind::screen || a.axis == b.axis);
}

/// Where the handles are and how they are seen. In drawing coordinates.
struct GizmoFrame {
    draw::Eye eye;
    int width = 1, height = 1; ///< pixels of the picture
    double pixel = 1;          ///< pixels that a length of 1 has on an ordinary screen
    openvdb::Vec3d origin{0};
    std::array<openvdb::Vec3d, 3> axes{}; ///< orthonormal
};

using Pixel = std::array<double, 2>;

Pixel pixelOf(const GizmoFrame& frame, const openvdb::Vec3d& point);

/// A stroke or an area of the gizmo.
struct GizmoPart {
    Handle handle;
    std::vector<Pixel> line;
    bool isFilled = false; ///< an area: `line` is its border
    draw::Colour colour{};
};
/// From the back to the front. None if the origin is behind the eye or far away, or the tool has no handles.
std::vector<GizmoPart> gizmoParts(const GizmoFrame& frame, Tool tool);

/// What is within some pixels of `at`, the nearest; areas before strokes.
std::optional<Handle> handleAt(const std::vector<GizmoPart>& parts, double pixel, const Pixel& at);

/// "x", "plane-x" (across x) or "screen".
std::string nameOf(const Handle& handle);
/// Where a handle can be grabbed; none: nowhere, as when another is in front.
std::optional<Pixel> placeOf(const std::vector<GizmoPart>& parts, const std::string& name, double pixel);

/// What a drag amounts to, in numbers that a user could type.
struct Amount {
    openvdb::Vec3d values{0}; ///< move: along each axis, drawing units; rotate: degrees; scale: factors of each axis
    int count = 1;            ///< how many of them a user can set
};
/// \pre tool is not select
Amount draggedAmount(const GizmoFrame& frame, Tool tool, const Handle& handle, const Pixel& from, const Pixel& to);

/// The axis that a rotation by `handle` turns around.
openvdb::Vec3d rotationAxis(const GizmoFrame& frame, const Handle& handle);

} // namespace vdbcage::view
