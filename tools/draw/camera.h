#pragma once

#include <array>
#include <vector>

#include <openvdb/Types.h>
#include <tools/draw/frame.h>

namespace vdbcage::draw {

enum class UpAxis { y, z };
enum class Projection { perspective, orthographic };

/// The direction of a view; its distance follows from the content of the picture.
struct View {
    double azimuthDegrees = 35;   ///< to the right of the front, which is +z (with z up: -y); any
    double elevationDegrees = 18; ///< above the horizon, in [-90, 90]
    UpAxis up = UpAxis::y;
};
inline bool operator==(const View& a, const View& b)
{
    return a.azimuthDegrees == b.azimuthDegrees && a.elevationDegrees == b.elevationDegrees && a.up == b.up;
}

/// \throw InputError if a value is out of range
void requireView(const View& view);

/// A camera that looks at `target` from `distance` away, in drawing coordinates (see Frame). Things at the target have
/// the same size in both projections. The angle of view is 22 degrees, across the shorter side of a panel.
struct Camera {
    View view;
    Projection projection = Projection::perspective;
    openvdb::Vec3d target{0};
    double distance = 6; ///< > 0; 6 sees the whole ball of radius 1
};
inline bool operator==(const Camera& a, const Camera& b)
{
    return a.view == b.view && a.projection == b.projection && a.target == b.target && a.distance == b.distance;
}

/// The nearest and farthest distances of a camera that is zoomed: from the limit of single precision to where nothing
/// is visible.
constexpr double leastDistance = 1e-5, mostDistance = 1e5;

/// Sets of points, such as those of a Geometry. None is null.
using PointSets = std::vector<const std::vector<Vec3f>*>;

/// Returns the camera nearest to the points that sees all of them with a small margin; `aspect` is width / height of
/// the panel (> 0). Exact for the points, whatever their shape, and O(n): each side of the view is pushed against the
/// points' extreme in its direction. `radius` is that of the points or more: in perspective the eye keeps twice that
/// distance, or the perspective of a rod seen from its end would be extreme. If there are no points: the default target
/// and distance.
Camera fit(const View& view, Projection projection, const PointSets& points, double aspect, double radius = 1);

/// Turns the camera around `pivot`, which keeps its place in the picture. The elevation stops at +-90 degrees; the
/// azimuth is kept in (-360, 360).
Camera orbited(const Camera& camera, double azimuthDegrees, double elevationDegrees, const openvdb::Vec3d& pivot);

/// Moves the camera so that points at the target's depth move by (x, y) in the picture: the panel is [-1, 1] both ways,
/// y up.
Camera panned(const Camera& camera, double aspect, double x, double y);

/// Divides the distance by `factor` (> 0); the point at (x, y) and at the target's depth keeps its place in the
/// picture. The distance stays in [leastDistance, mostDistance].
Camera zoomed(const Camera& camera, double aspect, double factor, double x, double y);

/// The distance of an orthographic viewpoint from the target, in camera distances: lines of sight then differ too
/// little to be visible.
constexpr double orthographicViewpoint = 1000;

/// A camera for one panel and its content. It looks along -back (x to the right, y up).
struct Eye {
    openvdb::Vec3d right, up, back; ///< unit
    openvdb::Vec3d position;        ///< of the eye; if orthographic, the middle of a plane that it looks from
    Projection projection = Projection::perspective;
    double halfWidth = 0, halfHeight = 0; ///< of the view at distance 1 in perspective, everywhere if orthographic
    double nearest = 0, farthest = 0;     ///< distances along -back; parts outside are not drawn
    /// The point that decides how surfaces are shaded: the position; if orthographic, far behind it.
    openvdb::Vec3d viewpoint;
    /// The origin of the matrices' coordinates: 0, or the target in close-ups, where single precision needs it.
    openvdb::Vec3d origin{0};
};

/// Returns the eye of a camera. `seen` are the points that will be drawn: they decide nearest and farthest. O(n).
/// \pre distance > 0, aspect > 0
Eye eyeOf(const Camera& camera, double aspect, const PointSets& seen);

/// Returns a point's place in the panel, [-1, 1] both ways, y up, and its distance along the view.
openvdb::Vec3d project(const Eye& eye, const openvdb::Vec3d& point);

/// The line of sight through (x, y) of the panel, from the eye (if orthographic, from its plane).
struct Ray {
    openvdb::Vec3d from, direction; ///< direction: unit
};
Ray rayThrough(const Eye& eye, double x, double y);

/// A matrix in OpenGL's order: column by column. It maps drawing coordinates less `Eye::origin`.
using Matrix = std::array<float, 16>;

/// A part of a panel: its middle and half its size, where the panel is [-1, 1] both ways, y up.
struct Crop {
    double x = 0, y = 0, halfWidth = 1, halfHeight = 1;
};

/// Returns the map to coordinates with the viewpoint at their origin and the axes of `eye`.
Matrix viewMatrix(const Eye& eye);

/// Returns the map to OpenGL's clip space, where the crop fills the picture.
Matrix clipMatrix(const Eye& eye, const Crop& crop);

} // namespace vdbcage::draw
