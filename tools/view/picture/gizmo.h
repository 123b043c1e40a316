#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include <openvdb/Types.h>
#include <tools/draw/camera.h>
#include <tools/draw/colour.h>
#include <tools/view/state/state.h>

/// The gizmo: handles that move, turn and scale the selection, with their places in the picture, the one under the
/// pointer, and the effect of a drag. Pixels count from the picture's top left.
namespace vdbcage::view {

/// A part of the gizmo that can be dragged.
struct Handle {
    enum class Kind : std::uint8_t {
        axis,  ///< along it, around it
        plane, ///< across it: the two other axes
        screen ///< in the plane of the picture, around the line of sight, all axes equally
    };
    Kind kind = Kind::screen;
    int axis = 0;
};
inline bool operator==(const Handle& a, const Handle& b)
{
    return a.kind == b.kind && (a.kind == Handle::Kind::screen || a.axis == b.axis);
}

/// The place of the gizmo and its view, in drawing coordinates.
struct GizmoFrame {
    draw::Eye eye;
    int width = 1, height = 1; ///< pixels of the picture
    double pixel = 1;          ///< pixels per pixel of an ordinary screen
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
/// Returns the parts from back to front. None if the origin is behind the eye or far away, or the tool has no handles.
std::vector<GizmoPart> gizmoParts(const GizmoFrame& frame, Tool tool);

/// Returns the nearest handle within some pixels of `at`; areas before strokes.
std::optional<Handle> handleAt(const std::vector<GizmoPart>& parts, double pixel, const Pixel& at);

/// Returns "x", "plane-x" (across x) or "screen".
std::string nameOf(const Handle& handle);
/// Returns a pixel where the handle can be grabbed; none: there is none, as when another handle is in front.
std::optional<Pixel> placeOf(const std::vector<GizmoPart>& parts, const std::string& name, double pixel);

/// The effect of a drag, in numbers that a user could type.
struct Amount {
    openvdb::Vec3d values{0}; ///< move: along each axis, drawing units; rotate: degrees; scale: factors of each axis
};
/// \pre tool is not select
Amount draggedAmount(const GizmoFrame& frame, Tool tool, const Handle& handle, const Pixel& from, const Pixel& to);

/// Returns the axis that a rotation by `handle` turns around.
openvdb::Vec3d rotationAxis(const GizmoFrame& frame, const Handle& handle);

} // namespace vdbcage::view
