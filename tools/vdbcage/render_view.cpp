#include <tools/vdbcage/render_view.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

#include <vdbcage/core/error.h>

namespace vdbcage::render {

namespace {

using openvdb::Vec3d;

constexpr double degree = 3.14159265358979323846 / 180;
constexpr double viewAngle = 22 * degree; // across the shorter side of a panel
constexpr double margin = 0.05;           // on each side, of the panel
// The eye keeps this distance (the model's radius is 1), or a rod seen from its end would be all perspective.
constexpr double leastDistance = 2;

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

/// The coordinate along `axis`, counted from the eye.
Row rowOf(const Eye& eye, const Vec3d& axis)
{
    return {axis.x(), axis.y(), axis.z(), -axis.dot(eye.position)};
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

/// The largest value over the geometries' points.
template <typename Value>
double largest(const std::vector<const Geometry*>& geometries, const Value& value)
{
    double result = -std::numeric_limits<double>::infinity();
    for (const Geometry* geometry : geometries) {
        for (const Corner& corner : geometry->corners) {
            result = std::max(result, value(Vec3d(corner.position[0], corner.position[1], corner.position[2])));
        }
    }
    return result;
}

Vec3d turn(const View& view, const Vec3d& v)
{
    return view.up == UpAxis::y ? v : Vec3d(v.x(), -v.z(), v.y());
}

} // namespace

void requireView(const View& view)
{
    if (!(view.elevationDegrees >= -90 && view.elevationDegrees <= 90)) {
        std::ostringstream text;
        text << "view: the elevation is " << view.elevationDegrees << " degrees; -90 to 90 is allowed";
        throw InputError(text.str());
    }
    if (!std::isfinite(view.azimuthDegrees)) throw InputError("view: the azimuth must be a finite number of degrees");
}

Eye fitEye(const View& view, const std::vector<const Geometry*>& geometries, double aspect)
{
    const double azimuth = std::fmod(view.azimuthDegrees, 360) * degree;
    const double elevation = view.elevationDegrees * degree;
    Eye eye;
    eye.right = turn(view, {std::cos(azimuth), 0, -std::sin(azimuth)});
    eye.back = turn(
        view, {std::cos(elevation) * std::sin(azimuth), std::sin(elevation), std::cos(elevation) * std::cos(azimuth)});
    eye.up = eye.back.cross(eye.right);
    const double half = std::tan(0.5 * viewAngle);
    eye.halfWidth = half * std::max(aspect, 1.0);
    eye.halfHeight = half * std::max(1 / aspect, 1.0);

    // A point at (x, z) is inside the right side of the view if x - ex <= t (ez - z), that is x + t z <= ex + t ez;
    // with the left side the same for -x. Both hold with equality when ex and ez solve the two equations.
    struct Bounds {
        double middle, distance;
    };
    const auto solve = [&](const Vec3d& axis, double tangent) {
        const double plus = largest(geometries, [&](const Vec3d& p) { return (axis + tangent * eye.back).dot(p); });
        const double minus = largest(geometries, [&](const Vec3d& p) { return (tangent * eye.back - axis).dot(p); });
        return Bounds{0.5 * (plus - minus), 0.5 * (plus + minus) / tangent};
    };
    const Bounds x = solve(eye.right, (1 - 2 * margin) * eye.halfWidth);
    const Bounds y = solve(eye.up, (1 - 2 * margin) * eye.halfHeight);
    const double front = largest(geometries, [&](const Vec3d& p) { return eye.back.dot(p); });
    const double rear = -largest(geometries, [&](const Vec3d& p) { return -eye.back.dot(p); });
    const double distance = std::max({x.distance, y.distance, front + leastDistance});
    eye.position = x.middle * eye.right + y.middle * eye.up + distance * eye.back;
    eye.nearest = 0.98 * (distance - front);
    eye.farthest = 1.02 * (distance - rear);
    return eye;
}

Matrix viewMatrix(const Eye& eye)
{
    return byColumns({rowOf(eye, eye.right), rowOf(eye, eye.up), rowOf(eye, eye.back), Row{0, 0, 0, 1}});
}

Matrix clipMatrix(const Eye& eye, const Crop& crop)
{
    const Row depth = -1.0 * rowOf(eye, eye.back);
    const Row x = (1 / eye.halfWidth) * rowOf(eye, eye.right);
    const Row y = (1 / eye.halfHeight) * rowOf(eye, eye.up);
    const double range = eye.farthest - eye.nearest;
    Row z = (eye.farthest + eye.nearest) / range * depth;
    z.w -= 2 * eye.farthest * eye.nearest / range;
    return byColumns(
        {(1 / crop.halfWidth) * (x - crop.x * depth), (1 / crop.halfHeight) * (y - crop.y * depth), z, depth});
}

} // namespace vdbcage::render
