#include <tools/view/picture/gizmo.h>

#include <algorithm>
#include <cmath>

#include <vdbcage/core/detail/pi.h>

namespace vdbcage::view {

namespace {

using openvdb::Vec3d;

// Pixels on an ordinary screen.
constexpr double armLength = 84, planeFrom = 26, planeTo = 46, headLength = 12, headWidth = 5, boxHalf = 5,
                 centreRadius = 8, ringRadius = 72, screenRingRadius = 86, grip = 7;
constexpr std::array<draw::Colour, 3> axisColours{
    {{0.86F, 0.24F, 0.22F}, {0.27F, 0.62F, 0.22F}, {0.20F, 0.42F, 0.88F}}};
constexpr draw::Colour screenColour{0.30F, 0.31F, 0.33F};
/// The least sine of the angle between an axis and the line of sight for its arm, and of that between a plane and the
/// line of sight for its square: others cannot be dragged.
constexpr double leastSine = 0.12;

/// The farthest distance whose pixels single precision can express, in drawing units: the model has about 2.
constexpr double farthestOrigin = 1e6;

Vec3d towardsEye(const GizmoFrame& frame)
{
    if (frame.eye.projection == draw::Projection::orthographic) return frame.eye.back;
    const Vec3d away = frame.eye.position - frame.origin;
    const double length = away.length();
    // A pivot can be anywhere, even in the eye, or so far away that its square is no number.
    return length > 0 && std::isfinite(length) ? away / length : frame.eye.back;
}

/// Returns the length in space of a pixel at the origin.
double lengthOfPixel(const GizmoFrame& frame)
{
    const bool isPerspective = frame.eye.projection == draw::Projection::perspective;
    const double depth = isPerspective ? (frame.eye.position - frame.origin).dot(frame.eye.back) : 1;
    return 2 * frame.eye.halfHeight * depth / frame.height;
}

draw::Ray rayAt(const GizmoFrame& frame, const Pixel& at)
{
    return draw::rayThrough(frame.eye, 2 * at[0] / frame.width - 1, 1 - 2 * at[1] / frame.height);
}

/// Returns the point where a line of sight meets the plane through the origin with the normal.
std::optional<Vec3d> onPlane(const GizmoFrame& frame, const Vec3d& normal, const Pixel& at)
{
    const draw::Ray ray = rayAt(frame, at);
    const double slope = ray.direction.dot(normal);
    if (std::abs(slope) < 1e-6) return std::nullopt;
    return ray.from + ray.direction * ((frame.origin - ray.from).dot(normal) / slope);
}

/// Returns the place along the axis through the origin that is nearest to a line of sight.
double onAxis(const GizmoFrame& frame, const Vec3d& axis, const Pixel& at)
{
    const draw::Ray ray = rayAt(frame, at);
    const double slope = axis.dot(ray.direction);
    const double determinant = 1 - slope * slope;
    if (determinant < 1e-6) return 0;
    const Vec3d between = frame.origin - ray.from;
    return (slope * between.dot(ray.direction) - between.dot(axis)) / determinant;
}

double distanceToSegment(const Pixel& p, const Pixel& a, const Pixel& b)
{
    const double x = b[0] - a[0], y = b[1] - a[1], squared = x * x + y * y;
    double t = squared > 0 ? ((p[0] - a[0]) * x + (p[1] - a[1]) * y) / squared : 0;
    t = std::clamp(t, 0.0, 1.0);
    return std::hypot(p[0] - a[0] - t * x, p[1] - a[1] - t * y);
}

bool isInside(const std::vector<Pixel>& border, const Pixel& p)
{
    bool inside = false;
    for (std::size_t i = 0, j = border.size() - 1; i < border.size(); j = i++) {
        const Pixel &a = border[i], &b = border[j];
        if ((a[1] > p[1]) != (b[1] > p[1]) && p[0] < (b[0] - a[0]) * (p[1] - a[1]) / (b[1] - a[1]) + a[0]) {
            inside = !inside;
        }
    }
    return inside;
}

class Builder {
public:
    Builder(const GizmoFrame& frame, std::vector<GizmoPart>& parts)
        : frame_(frame), parts_(parts), unit_(lengthOfPixel(frame) * frame.pixel), eye_(towardsEye(frame))
    {
    }

    void addArms(bool hasBoxes)
    {
        for (const int k : backToFront()) {
            const Vec3d& axis = axisOf(k);
            if (axis.cross(eye_).length() < leastSine) continue;
            const Pixel tip = at(axis * armLength);
            add({Handle::Kind::axis, k}, {at(axis * (centreRadius + 4)), tip}, false);
            add({Handle::Kind::axis, k}, hasBoxes ? box(tip) : head(at(Vec3d(0)), tip), true);
        }
        for (int k = 0; k < 3; ++k) {
            if (std::abs(axisOf(k).dot(eye_)) < leastSine) continue;
            const Vec3d &u = axisOf((k + 1) % 3), &v = axisOf((k + 2) % 3);
            add({Handle::Kind::plane, k},
                {at(u * planeFrom + v * planeFrom), at(u * planeTo + v * planeFrom), at(u * planeTo + v * planeTo),
                 at(u * planeFrom + v * planeTo)},
                true);
        }
        addCircle({Handle::Kind::screen, 0}, frame_.eye.right, frame_.eye.up, centreRadius, true);
    }

    void addRings()
    {
        addCircle({Handle::Kind::screen, 0}, frame_.eye.right, frame_.eye.up, screenRingRadius, false);
        for (const int k : backToFront()) {
            // Only the half in front is drawn: the ball that one imagines hides the other one.
            const Vec3d &u = axisOf((k + 1) % 3), &v = axisOf((k + 2) % 3);
            std::vector<Pixel> line;
            constexpr int steps = 96;
            // It starts where the ring passes behind, so that the visible part is one stroke.
            const double start = std::atan2(v.dot(eye_), u.dot(eye_)) + detail::pi;
            for (int i = 0; i <= steps; ++i) {
                const double angle = start + 2 * detail::pi * i / steps;
                const Vec3d side = u * std::cos(angle) + v * std::sin(angle);
                if (side.dot(eye_) >= -1e-9) line.push_back(at(side * ringRadius));
            }
            add({Handle::Kind::axis, k}, std::move(line), false);
        }
    }

private:
    const Vec3d& axisOf(int k) const { return frame_.axes[static_cast<std::size_t>(k)]; }
    Pixel at(const Vec3d& pixels) const { return pixelOf(frame_, frame_.origin + pixels * unit_); }

    std::array<int, 3> backToFront() const
    {
        std::array<int, 3> order{0, 1, 2};
        std::sort(order.begin(), order.end(), [&](int a, int b) { return axisOf(a).dot(eye_) < axisOf(b).dot(eye_); });
        return order;
    }

    void add(const Handle& handle, std::vector<Pixel> line, bool isFilled)
    {
        const bool isScreen = handle.kind == Handle::Kind::screen;
        parts_.push_back({handle, std::move(line), isFilled,
                          isScreen ? screenColour : axisColours[static_cast<std::size_t>(handle.axis)]});
    }

    void addCircle(const Handle& handle, const Vec3d& u, const Vec3d& v, double radius, bool isFilled)
    {
        std::vector<Pixel> line;
        constexpr int steps = 48;
        for (int i = 0; i < steps + (isFilled ? 0 : 1); ++i) {
            const double angle = 2 * detail::pi * i / steps;
            line.push_back(at((u * std::cos(angle) + v * std::sin(angle)) * radius));
        }
        add(handle, std::move(line), isFilled);
    }

    std::vector<Pixel> head(const Pixel& from, const Pixel& tip) const
    {
        const double x = tip[0] - from[0], y = tip[1] - from[1], length = std::max(1e-9, std::hypot(x, y));
        const Pixel along{x / length * frame_.pixel, y / length * frame_.pixel};
        const auto place = [&](double ahead, double aside) {
            return Pixel{tip[0] + ahead * along[0] - aside * along[1], tip[1] + ahead * along[1] + aside * along[0]};
        };
        return {place(headLength, 0), place(0, headWidth), place(0, -headWidth)};
    }

    std::vector<Pixel> box(const Pixel& tip) const
    {
        const double half = boxHalf * frame_.pixel;
        return {{tip[0] - half, tip[1] - half},
                {tip[0] + half, tip[1] - half},
                {tip[0] + half, tip[1] + half},
                {tip[0] - half, tip[1] + half}};
    }

    const GizmoFrame& frame_;
    std::vector<GizmoPart>& parts_;
    double unit_; ///< length in space of a pixel on an ordinary screen
    Vec3d eye_;
};

} // namespace

Pixel pixelOf(const GizmoFrame& frame, const Vec3d& point)
{
    const Vec3d seen = draw::project(frame.eye, point);
    return {(seen.x() + 1) / 2 * frame.width, (1 - seen.y()) / 2 * frame.height};
}

std::vector<GizmoPart> gizmoParts(const GizmoFrame& frame, Tool tool)
{
    std::vector<GizmoPart> parts;
    const Vec3d away = frame.eye.position - frame.origin;
    const bool isBehind = frame.eye.projection == draw::Projection::perspective && !(away.dot(frame.eye.back) > 0);
    const bool isFar = !(away.length() < farthestOrigin);
    if (isBehind || isFar || tool == Tool::select) return parts;
    Builder builder(frame, parts);
    if (tool == Tool::rotate) {
        builder.addRings();
    } else {
        builder.addArms(tool == Tool::scale);
    }
    return parts;
}

std::optional<Handle> handleAt(const std::vector<GizmoPart>& parts, double pixel, const Pixel& at)
{
    std::optional<Handle> found;
    for (const GizmoPart& part : parts) { // the last one is in front
        if (part.isFilled && isInside(part.line, at)) found = part.handle;
    }
    if (found) return found;
    double least = grip * pixel;
    for (const GizmoPart& part : parts) {
        for (std::size_t i = 0; i + 1 < part.line.size(); ++i) {
            const double distance = distanceToSegment(at, part.line[i], part.line[i + 1]);
            if (distance > least) continue;
            least = distance;
            found = part.handle;
        }
    }
    return found;
}

std::string nameOf(const Handle& handle)
{
    if (handle.kind == Handle::Kind::screen) return "screen";
    return std::string(handle.kind == Handle::Kind::plane ? "plane-" : "") + "xyz"[handle.axis];
}

std::optional<Pixel> placeOf(const std::vector<GizmoPart>& parts, const std::string& name, double pixel)
{
    for (const GizmoPart& part : parts) {
        if (nameOf(part.handle) != name) continue;
        std::vector<Pixel> places = part.line;
        Pixel middle{};
        for (const Pixel& p : part.line) {
            for (std::size_t k = 0; k < 2; ++k) middle[k] += p[k] / static_cast<double>(part.line.size());
        }
        if (part.isFilled) places.insert(places.begin(), middle);
        for (const Pixel& place : places) {
            const auto handle = handleAt(parts, pixel, place);
            if (handle && *handle == part.handle) return place;
        }
    }
    return std::nullopt;
}

Vec3d rotationAxis(const GizmoFrame& frame, const Handle& handle)
{
    return handle.kind == Handle::Kind::screen ? towardsEye(frame) : frame.axes[static_cast<std::size_t>(handle.axis)];
}

namespace {

Amount movedAmount(const GizmoFrame& frame, const Handle& handle, const Pixel& from, const Pixel& to)
{
    Amount amount;
    if (handle.kind == Handle::Kind::axis) {
        const Vec3d& axis = frame.axes[static_cast<std::size_t>(handle.axis)];
        amount.values[handle.axis] = onAxis(frame, axis, to) - onAxis(frame, axis, from);
        return amount;
    }
    const Vec3d normal =
        handle.kind == Handle::Kind::plane ? frame.axes[static_cast<std::size_t>(handle.axis)] : frame.eye.back;
    const auto a = onPlane(frame, normal, from), b = onPlane(frame, normal, to);
    if (!a || !b) return amount;
    for (int k = 0; k < 3; ++k) {
        const bool isAcross = handle.kind == Handle::Kind::plane && k == handle.axis;
        amount.values[k] = isAcross ? 0 : (*b - *a).dot(frame.axes[static_cast<std::size_t>(k)]);
    }
    return amount;
}

Amount turnedAmount(const GizmoFrame& frame, const Handle& handle, const Pixel& from, const Pixel& to)
{
    const Vec3d axis = rotationAxis(frame, handle);
    const double facing = axis.dot(towardsEye(frame));
    const Pixel centre = pixelOf(frame, frame.origin);
    double degrees = 0;
    if (std::abs(facing) > 0.2) {
        // The ring turns as a wheel seen from one of its sides.
        const double x0 = from[0] - centre[0], y0 = from[1] - centre[1], x1 = to[0] - centre[0], y1 = to[1] - centre[1];
        degrees = -std::atan2(x0 * y1 - y0 * x1, x0 * x1 + y0 * y1) * 180 / detail::pi * (facing > 0 ? 1 : -1);
    } else {
        // The ring turns as a wheel seen from its edge: its part nearest to the eye follows the pointer.
        const Vec3d way = axis.cross(towardsEye(frame));
        const double x = way.dot(frame.eye.right), y = -way.dot(frame.eye.up),
                     length = std::max(1e-9, std::hypot(x, y));
        const double pixels = ((to[0] - from[0]) * x + (to[1] - from[1]) * y) / length;
        degrees = pixels / (ringRadius * frame.pixel) * 180 / detail::pi;
    }
    Amount amount;
    amount.values[0] = degrees;
    return amount;
}

Amount scaledAmount(const GizmoFrame& frame, const Handle& handle, const Pixel& from, const Pixel& to)
{
    Amount amount;
    amount.values = Vec3d(1);
    if (handle.kind == Handle::Kind::axis) {
        const Vec3d& axis = frame.axes[static_cast<std::size_t>(handle.axis)];
        const double start = onAxis(frame, axis, from);
        if (std::abs(start) > 1e-12) amount.values[handle.axis] = onAxis(frame, axis, to) / start;
        return amount;
    }
    // A start within some pixels of the centre would scale wildly.
    const Pixel centre = pixelOf(frame, frame.origin);
    const double start = std::max(20 * frame.pixel, std::hypot(from[0] - centre[0], from[1] - centre[1]));
    const double end =
        start + std::hypot(to[0] - centre[0], to[1] - centre[1]) - std::hypot(from[0] - centre[0], from[1] - centre[1]);
    for (int k = 0; k < 3; ++k) {
        if (handle.kind != Handle::Kind::plane || k != handle.axis) amount.values[k] = end / start;
    }
    return amount;
}

} // namespace

Amount draggedAmount(const GizmoFrame& frame, Tool tool, const Handle& handle, const Pixel& from, const Pixel& to)
{
    if (tool == Tool::move) return movedAmount(frame, handle, from, to);
    return tool == Tool::rotate ? turnedAmount(frame, handle, from, to) : scaledAmount(frame, handle, from, to);
}

} // namespace vdbcage::view
