#pragma once

#include <array>
#include <vector>

#include <openvdb/Types.h>
#include <tools/draw/frame.h>

namespace vdbcage::draw {

enum class UpAxis { y, z };
enum class Projection { perspective, orthographic };

/// From where one looks; how far away follows from what there is to see.
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

/// Looks at `target` from `distance` away, in drawing coordinates (see Frame). What is at the target has the same size
/// in both projections. The angle of view is 22 degrees, across the shorter side of a panel.
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

/// Nearest and farthest that a camera comes when it is zoomed: from where single precision ends to where nothing is
/// seen.
constexpr double leastDistance = 1e-5, mostDistance = 1e5;

/// Positions that belong together, such as those of a Geometry. None is null.
using PointSets = std::vector<const std::vector<Vec3f>*>;

/// The camera nearest to the points that sees all of them with a small margin; `aspect` is width / height of the panel
/// (> 0). Exact for the points, whatever their shape, and O(n): each side of the view is pushed against the points'
/// extreme in its direction. `radius` is that of the points or more: in perspective the eye keeps twice that distance,
/// or a rod seen from its end would be all perspective. Without points: the default target and distance.
Camera fit(const View& view, Projection projection, const PointSets& points, double aspect, double radius = 1);

/// Turns the camera around `pivot`, which stays where it is in the picture. The elevation stops at +-90 degrees; the
/// azimuth is kept in (-360, 360).
Camera orbited(const Camera& camera, double azimuthDegrees, double elevationDegrees, const openvdb::Vec3d& pivot);

/// Moves the camera so that what is at the target's depth moves by (x, y) in the picture: the panel is [-1, 1] both
/// ways, y up.
Camera panned(const Camera& camera, double aspect, double x, double y);

/// Divides the distance by `factor` (> 0) and keeps the place in the picture of what is at the target's depth at (x,
/// y). The distance stays in [leastDistance, mostDistance].
Camera zoomed(const Camera& camera, double aspect, double factor, double x, double y);

/// So many distances from the target is an orthographic viewpoint: lines of sight then differ by less than what is
/// seen.
constexpr double orthographicViewpoint = 1000;

/// A camera for one panel and for what is seen there. It looks along -back (x to the right, y up).
struct Eye {
    openvdb::Vec3d right, up, back; ///< unit
    openvdb::Vec3d position;        ///< of the eye; in orthographic of the middle of a plane that it looks from
    Projection projection = Projection::perspective;
    double halfWidth = 0, halfHeight = 0; ///< of what it sees at distance 1 in perspective, everywhere in orthographic
    double nearest = 0, farthest = 0;     ///< distances along -back; what is outside is not drawn
    /// From where surfaces look as they do: the position, in orthographic far behind it.
    openvdb::Vec3d viewpoint;
    /// What the matrices count coordinates from: 0, or the target in close-ups, where single precision needs it.
    openvdb::Vec3d origin{0};
};

/// `seen` is what will be drawn: it decides nearest and farthest. O(n). \pre distance > 0, aspect > 0
Eye eyeOf(const Camera& camera, double aspect, const PointSets& seen);

/// A point's place in the panel, [-1, 1] both ways, y up, and its distance along the view.
openvdb::Vec3d project(const Eye& eye, const openvdb::Vec3d& point);

/// The line of what is seen at (x, y) of the panel, from the eye (in orthographic from its plane).
struct Ray {
    openvdb::Vec3d from, direction; ///< direction: unit
};
Ray rayThrough(const Eye& eye, double x, double y);

/// As OpenGL takes it: column by column. It maps drawing coordinates less `Eye::origin`.
using Matrix = std::array<float, 16>;

/// A part of a panel: its middle and half its size, where the panel is [-1, 1] both ways, y up.
struct Crop {
    double x = 0, y = 0, halfWidth = 1, halfHeight = 1;
};

/// To coordinates with the viewpoint at their origin, of Eye's axes.
Matrix viewMatrix(const Eye& eye);

/// To OpenGL's clip space, where the crop fills the picture.
Matrix clipMatrix(const Eye& eye, const Crop& crop);

} // namespace vdbcage::draw
