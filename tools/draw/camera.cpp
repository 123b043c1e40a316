#include <tools/draw/camera.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

#include <vdbcage/core/detail/pi.h>
#include <vdbcage/core/error.h>

namespace vdbcage::draw {

namespace {

using openvdb::Vec3d;

constexpr double degree = detail::pi / 180;
constexpr double viewAngle = 22 * degree; // across the shorter side of a panel
constexpr double margin = 0.05;           // on each side, of the panel
// In perspective nothing nearer than this fraction of the distance is drawn, or depth would have no bits left.
constexpr double nearestShare = 0.05;
// At this distance and below, 24 bits of a coordinate are too few for a pixel.
constexpr double closeUp = 0.5;

struct Axes {
    Vec3d right, up, back;
};

Axes axesOf(const View& view)
{
    const auto turn = [&](const Vec3d& v) { return view.up == UpAxis::y ? v : Vec3d(v.x(), -v.z(), v.y()); };
    const double azimuth = std::fmod(view.azimuthDegrees, 360) * degree;
    const double elevation = view.elevationDegrees * degree;
    Axes axes;
    axes.right = turn({std::cos(azimuth), 0, -std::sin(azimuth)});
    axes.back =
        turn({std::cos(elevation) * std::sin(azimuth), std::sin(elevation), std::cos(elevation) * std::cos(azimuth)});
    axes.up = axes.back.cross(axes.right);
    return axes;
}

/// Half the size of the view at distance 1.
struct Extent {
    double halfWidth, halfHeight;
};

Extent extentOf(double aspect)
{
    const double half = std::tan(0.5 * viewAngle);
    return {half * std::max(aspect, 1.0), half * std::max(1 / aspect, 1.0)};
}

/// Returns the largest value over the points; -infinity if there are none.
template <typename Value>
double largest(const PointSets& points, const Value& value)
{
    double result = -std::numeric_limits<double>::infinity();
    for (const std::vector<Vec3f>* set : points) {
        for (const Vec3f& p : *set) result = std::max(result, value(Vec3d(p[0], p[1], p[2])));
    }
    return result;
}

struct Row {
    double x, y, z, w;
};

Row operator*(double factor, const Row& row)
{
    return {factor * row.x, factor * row.y, factor * row.z, factor * row.w};
}

Row operator-(const Row& a, const Row& b)
{
    return {a.x - b.x, a.y - b.y, a.z - b.z, a.w - b.w};
}

/// Returns the row of a matrix for the coordinate along `axis`, relative to `position`; its points are relative to
/// `origin`.
Row rowOf(const Vec3d& axis, const Vec3d& position, const Vec3d& origin)
{
    return {axis.x(), axis.y(), axis.z(), -axis.dot(position - origin)};
}

Matrix byColumns(const std::array<Row, 4>& rows)
{
    Matrix matrix{};
    for (std::size_t i = 0; i < 4; ++i) {
        matrix[i] = static_cast<float>(rows[i].x);
        matrix[4 + i] = static_cast<float>(rows[i].y);
        matrix[8 + i] = static_cast<float>(rows[i].z);
        matrix[12 + i] = static_cast<float>(rows[i].w);
    }
    return matrix;
}

double toFloatAndBack(double value)
{
    return static_cast<double>(static_cast<float>(value));
}

} // namespace

void requireView(const View& view)
{
    if (!(view.elevationDegrees >= -90 && view.elevationDegrees <= 90)) {
        std::ostringstream text;
        text << "view: the elevation is " << view.elevationDegrees << " degrees; -90 to 90 is allowed";
        throw InputError(text.str());
    }
    if (!std::isfinite(view.azimuthDegrees)) throw InputError("view", "the azimuth must be a finite number of degrees");
}

Camera fit(const View& view, Projection projection, const PointSets& points, double aspect, double radius)
{
    const auto [right, up, back] = axesOf(view);
    Camera camera{view, projection};
    const double front = largest(points, [axis = back](const Vec3d& p) { return axis.dot(p); });
    if (!std::isfinite(front)) return camera;

    // A point at (x, z) is inside the right side of the view if x - ex <= t (ez - z), that is x + t z <= ex + t ez;
    // with the left side the same for -x. Both bounds are reached when ex and ez solve the two equations. Orthographic
    // sides are parallel: there the points' part lacks t z.
    struct Bounds {
        double middle, distance;
    };
    const auto solve = [&, back = back](const Vec3d& axis, double tangent) {
        const Vec3d slope = projection == Projection::perspective ? tangent * back : Vec3d(0);
        const double plus = largest(points, [&](const Vec3d& p) { return (axis + slope).dot(p); });
        const double minus = largest(points, [&](const Vec3d& p) { return (slope - axis).dot(p); });
        return Bounds{0.5 * (plus - minus), 0.5 * (plus + minus) / tangent};
    };
    const Extent extent = extentOf(aspect);
    const Bounds x = solve(right, (1 - 2 * margin) * extent.halfWidth);
    const Bounds y = solve(up, (1 - 2 * margin) * extent.halfHeight);
    const double least = projection == Projection::perspective ? front + 2 * radius : leastDistance;
    // The target is in the plane through the origin; the distance counts from there.
    camera.target = x.middle * right + y.middle * up;
    camera.distance = std::max({x.distance, y.distance, least});
    return camera;
}

Camera orbited(const Camera& camera, double azimuthDegrees, double elevationDegrees, const Vec3d& pivot)
{
    Camera result = camera;
    View& view = result.view;
    view.azimuthDegrees = std::fmod(view.azimuthDegrees + azimuthDegrees, 360);
    view.elevationDegrees = std::clamp(view.elevationDegrees + elevationDegrees, -90.0, 90.0);
    // The pivot keeps its coordinates in the axes of the camera.
    const Axes before = axesOf(camera.view);
    const Axes after = axesOf(view);
    const Vec3d offset = camera.target - pivot;
    result.target = pivot + offset.dot(before.right) * after.right + offset.dot(before.up) * after.up +
                    offset.dot(before.back) * after.back;
    return result;
}

Camera panned(const Camera& camera, double aspect, double x, double y)
{
    const Axes axes = axesOf(camera.view);
    const Extent extent = extentOf(aspect);
    Camera result = camera;
    result.target -= camera.distance * (x * extent.halfWidth * axes.right + y * extent.halfHeight * axes.up);
    return result;
}

Camera zoomed(const Camera& camera, double aspect, double factor, double x, double y)
{
    Camera result = camera;
    result.distance = std::clamp(camera.distance / factor, leastDistance, mostDistance);
    // Brings the point at (x, y) to the middle, zooms, and brings it back.
    result.target = panned(camera, aspect, -x, -y).target;
    return panned(result, aspect, x, y);
}

Eye eyeOf(const Camera& camera, double aspect, const PointSets& seen)
{
    const auto [right, up, back] = axesOf(camera.view);
    const bool perspective = camera.projection == Projection::perspective;
    const Extent extent = extentOf(aspect);
    const double scale = perspective ? 1 : camera.distance;
    Eye eye;
    eye.right = right;
    eye.up = up;
    eye.back = back;
    eye.position = camera.target + camera.distance * back;
    eye.projection = camera.projection;
    eye.halfWidth = scale * extent.halfWidth;
    eye.halfHeight = scale * extent.halfHeight;
    eye.viewpoint = perspective ? eye.position : camera.target + orthographicViewpoint * camera.distance * back;
    if (camera.distance < closeUp) {
        for (int i = 0; i < 3; ++i) eye.origin[i] = toFloatAndBack(camera.target[i]);
    }

    const double ahead = camera.distance + back.dot(camera.target); // of the plane through 0
    const double front = largest(seen, [axis = back](const Vec3d& p) { return axis.dot(p); });
    const double rear = -largest(seen, [axis = back](const Vec3d& p) { return -axis.dot(p); });
    if (perspective) {
        eye.nearest = std::max(0.98 * (ahead - front), nearestShare * camera.distance);
        eye.farthest = std::max(1.02 * (ahead - rear), 1.01 * eye.nearest);
    } else {
        const double spare = 0.02 * std::max(front - rear, camera.distance);
        eye.nearest = ahead - front - spare;
        eye.farthest = ahead - rear + spare;
    }
    if (!std::isfinite(front)) {
        eye.nearest = nearestShare * camera.distance;
        eye.farthest = 2 * camera.distance;
    }
    return eye;
}

Vec3d project(const Eye& eye, const Vec3d& point)
{
    const Vec3d offset = point - eye.position;
    const double depth = -eye.back.dot(offset);
    const double scale = eye.projection == Projection::perspective ? depth : 1;
    return {eye.right.dot(offset) / (scale * eye.halfWidth), eye.up.dot(offset) / (scale * eye.halfHeight), depth};
}

Ray rayThrough(const Eye& eye, double x, double y)
{
    const Vec3d shift = x * eye.halfWidth * eye.right + y * eye.halfHeight * eye.up;
    if (eye.projection == Projection::orthographic) return {eye.position + shift, -eye.back};
    return {eye.position, (shift - eye.back).unit()};
}

Matrix viewMatrix(const Eye& eye)
{
    const auto row = [&](const Vec3d& axis) { return rowOf(axis, eye.viewpoint, eye.origin); };
    return byColumns({row(eye.right), row(eye.up), row(eye.back), Row{0, 0, 0, 1}});
}

Matrix clipMatrix(const Eye& eye, const Crop& crop)
{
    const auto row = [&](const Vec3d& axis) { return rowOf(axis, eye.position, eye.origin); };
    const bool perspective = eye.projection == Projection::perspective;
    const Row depth = -1.0 * row(eye.back);
    const Row w = perspective ? depth : Row{0, 0, 0, 1};
    const Row x = (1 / eye.halfWidth) * row(eye.right);
    const Row y = (1 / eye.halfHeight) * row(eye.up);
    const double range = eye.farthest - eye.nearest;
    Row z = (perspective ? eye.farthest + eye.nearest : 2) / range * depth;
    z.w -= (perspective ? 2 * eye.farthest * eye.nearest : eye.farthest + eye.nearest) / range;
    return byColumns({(1 / crop.halfWidth) * (x - crop.x * w), (1 / crop.halfHeight) * (y - crop.y * w), z, w});
}

} // namespace vdbcage::draw
