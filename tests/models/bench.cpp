// A park bench: wooden slats on three cast iron frames with scrolls, bolted. Every part is a closed skin of quads of
// its own; parts touch and run through each other, as modellers leave them.

#include <algorithm>

#include "implicit.h"

namespace data {

namespace {

using Frame = std::array<Vec3, 3>;

/// The surface of a grid of `size` cells, its corner points mapped by `place`; outward for a map that keeps hands.
template <class Place>
Model makeGridBox(const std::array<int, 3>& size, const Place& place)
{
    Model model;
    std::vector<int> known(static_cast<std::size_t>((size[0] + 1) * (size[1] + 1) * (size[2] + 1)), -1);
    const auto point = [&](const std::array<int, 3>& p) {
        int& index = known[static_cast<std::size_t>((p[0] * (size[1] + 1) + p[1]) * (size[2] + 1) + p[2])];
        if (index < 0) index = model.addPoint(place(p));
        return index;
    };
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const std::size_t u = (axis + 1) % 3;
        const std::size_t v = (axis + 2) % 3;
        for (const int end : {0, size[axis]}) {
            for (int i = 0; i < size[u]; ++i) {
                for (int j = 0; j < size[v]; ++j) {
                    std::array<int, 3> p{};
                    p[axis] = end;
                    int corners[4];
                    for (int c = 0; c < 4; ++c) {
                        p[u] = i + (c == 1 || c == 2);
                        p[v] = j + (c > 1);
                        corners[c] = point(p);
                    }
                    if (end == 0)
                        model.addQuad(corners[3], corners[2], corners[1], corners[0]);
                    else
                        model.addQuad(corners[0], corners[1], corners[2], corners[3]);
                }
            }
        }
    }
    return model;
}

/// A box around `center` with the half lengths `half` along the axes of `frame` and edges rounded by `radius`:
/// `flat` cells along each axis between the roundings, 2 `bevel` cells in each rounding.
Model makeRoundedBox(const Vec3& center, const Frame& frame, const Vec3& half, double radius,
                     const std::array<int, 3>& flat, int bevel)
{
    const std::array<double, 3> halves{half.x, half.y, half.z};
    // Where the grid lines are on each axis; in the roundings at even angles.
    std::array<std::vector<double>, 3> lines;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const double inner = halves[axis] - radius;
        const auto bulge = [&](int i) {
            const double turn = pi / 4 * i / bevel;
            return radius * sine(turn) / cosine(turn);
        };
        for (int i = bevel; i > 0; --i) lines[axis].push_back(-inner - bulge(i));
        for (int i = 0; i <= flat[axis]; ++i) lines[axis].push_back(lerp(-inner, inner, 1.0 * i / flat[axis]));
        for (int i = 1; i <= bevel; ++i) lines[axis].push_back(inner + bulge(i));
    }
    return makeGridBox({flat[0] + 2 * bevel, flat[1] + 2 * bevel, flat[2] + 2 * bevel}, [&](const auto& index) {
        std::array<double, 3> core{};
        std::array<double, 3> out{};
        double size = 0;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const double x = lines[axis][static_cast<std::size_t>(index[axis])];
            core[axis] = clamp(x, radius - halves[axis], halves[axis] - radius);
            out[axis] = x - core[axis];
            size += out[axis] * out[axis];
        }
        Vec3 p = center;
        for (std::size_t axis = 0; axis < 3; ++axis)
            p = p + (core[axis] + radius * out[axis] / std::sqrt(size)) * frame[axis];
        return p;
    });
}

/// The same curve in `steps` pieces of even length.
std::vector<Knot> resample(const std::vector<Knot>& knots, int steps)
{
    std::vector<double> reached{0};
    for (std::size_t i = 1; i < knots.size(); ++i)
        reached.push_back(reached.back() + length(knots[i].center - knots[i - 1].center));
    std::vector<Knot> result;
    std::size_t i = 1;
    for (int k = 0; k <= steps; ++k) {
        const double goal = reached.back() * k / steps;
        while (i + 1 < knots.size() && reached[i] < goal) ++i;
        const double t = clamp((goal - reached[i - 1]) / (reached[i] - reached[i - 1]), 0, 1);
        result.push_back(
            {lerp(knots[i - 1].center, knots[i].center, t), lerp(knots[i - 1].radius, knots[i].radius, t)});
    }
    return result;
}

/// A bar along a curve in the plane across `normal`. Its section is between a square and a disc, `depth` to either side
/// along `normal` and the knot's radius to either side in the plane, with `cells` by `cells` quads on each end.
Model makeBar(const std::vector<Knot>& curve, const Vec3& normal, double depth, int cells, int steps)
{
    const std::vector<Knot> knots = resample(curve, steps);
    return makeGridBox({cells, cells, steps}, [&](const std::array<int, 3>& p) {
        const std::size_t i = static_cast<std::size_t>(p[2]);
        const Vec3& before = knots[i == 0 ? 0 : i - 1].center;
        const Vec3& after = knots[std::min(i + 1, knots.size() - 1)].center;
        const Vec3 along = normalized(after - before);
        const Vec3 aside = cross(along, normal);
        const double u = 2.0 * p[0] / cells - 1;
        const double v = 2.0 * p[1] / cells - 1;
        const double reach = std::max(std::fabs(u), std::fabs(v)); // 1 on the skin, less within an end
        const double size = std::sqrt(u * u + v * v);
        const double shrink = size > 0 ? lerp(1, lerp(1, reach / size, 0.7), reach) : 1;
        const double dome = (p[2] == 0 ? -0.5 : p[2] == steps ? 0.5 : 0) * (1 - reach * reach);
        const double width = knots[i].radius;
        return knots[i].center + (u * shrink * depth) * normal + (v * shrink * width) * aside + (dome * width) * along;
    });
}

/// Goes on from the end of a curve in the plane across X as a spiral that turns by `angle`, towards the left as seen
/// from +X if positive, its radius of curvature going from `start` to `end` and its half width to `width`.
void addScroll(std::vector<Knot>& curve, double angle, double start, double end, double width)
{
    const int steps = 48;
    const Vec3 tip = curve.back().center;
    Vec3 heading = normalized(tip - curve[curve.size() - 2].center);
    const double from = curve.back().radius;
    double s = 0;
    double c = 0;
    sineCosine(angle / steps, s, c);
    for (int i = 0; i < steps; ++i) {
        const double t = (i + 0.5) / steps;
        heading = {0, c * heading.y + s * heading.z, c * heading.z - s * heading.y};
        const double advance = lerp(start, end, t) * std::fabs(angle) / steps;
        curve.push_back({curve.back().center + advance * heading, lerp(from, width, t)});
    }
}

std::vector<Knot> reversed(std::vector<Knot> curve)
{
    std::reverse(curve.begin(), curve.end());
    return curve;
}

struct Place {
    double y, z, width;
};

std::vector<Knot> curveThrough(const std::vector<Place>& places)
{
    std::vector<Knot> knots;
    for (const Place& place : places) knots.push_back({{0, place.y, place.z}, place.width});
    return spline(knots, 10);
}

// The side view: Y up, Z to the front.
const std::vector<Place> seatRail = {
    {41.5, -21, 1.3}, {40.2, -12, 1.3}, {40.2, 0, 1.3}, {41.6, 12, 1.3}, {42.8, 21, 1.3}};
const std::vector<Place> backPost = {
    {40, -21.5, 1.5}, {52, -22.5, 1.5}, {66, -26, 1.4}, {80, -31, 1.3}, {88, -34.5, 1.2}};

Model makeFrame(bool withArm)
{
    const Vec3 across{1, 0, 0};
    Model model;
    const auto add = [&](const std::vector<Knot>& curve, double depth, int steps) {
        model.append(makeBar(curve, across, depth, 3, steps));
    };
    // Back: from the scroll at the top down to the scroll of the foot.
    std::vector<Knot> back = reversed(curveThrough(backPost));
    const std::vector<Knot> leg =
        curveThrough({{40, -21.5, 1.5}, {30, -22, 1.5}, {18, -25, 1.5}, {8, -30.5, 1.4}, {4.0, -35, 1.3}});
    back.insert(back.end(), leg.begin() + 1, leg.end());
    addScroll(back, 4.9, 4.2, 1.7, 0.7);
    back = reversed(back);
    addScroll(back, 4.9, 3.6, 1.6, 0.7);
    add(back, 1.6, 210);

    std::vector<Knot> front = curveThrough(
        {{41, 20, 1.5}, {34, 23.5, 1.6}, {24, 22.5, 1.5}, {14, 20.5, 1.4}, {7, 23.5, 1.3}, {3.4, 28.5, 1.2}});
    addScroll(front, -4.9, 4.2, 1.7, 0.7);
    add(front, 1.6, 109);

    add(curveThrough(seatRail), 1.4, 62);

    // Between the legs: a bow, and on it a double scroll.
    add(curveThrough({{17, -25.5, 1.0}, {22, -13, 1.1}, {23.5, -1, 1.1}, {21.5, 10, 1.1}, {17, 21, 1.0}}), 1.1, 66);
    for (const double side : {-1.0, 1.0}) {
        std::vector<Knot> scroll =
            curveThrough({{23.5, -1 + 1.0 * side, 1.0}, {30, -1 + 2.2 * side, 1.0}, {36, -1 + 4.6 * side, 1.0}});
        addScroll(scroll, -5.4 * side, 5.2, 1.5, 0.55);
        add(scroll, 1.0, 66);
    }
    if (!withArm) return model;

    std::vector<Knot> arm =
        curveThrough({{65.5, -26.5, 1.2}, {67.5, -16, 1.3}, {66.5, -2, 1.4}, {65.0, 12, 1.4}, {65.2, 20, 1.4}});
    addScroll(arm, -5.2, 4.6, 1.6, 0.7);
    add(arm, 2.1, 104);
    add(curveThrough({{42, 15, 1.2}, {48, 20.0, 1.2}, {54, 19.5, 1.1}, {59, 15, 1.1}, {64.5, 14, 1.1}}), 1.2, 40);
    std::vector<Knot> curl = curveThrough({{42, -6, 1.0}, {47, -9.5, 1.0}, {53, -9, 1.0}, {58, -4.5, 1.0}});
    addScroll(curl, -5.4, 5.4, 1.6, 0.55);
    add(curl, 1.0, 62);
    return model;
}

/// Point and direction on a curve at the part `t` of its length; the direction is level or upward.
void onCurve(const std::vector<Place>& places, double t, Vec3& at, Vec3& along)
{
    const std::vector<Knot> knots = resample(curveThrough(places), 1000);
    const std::size_t i = static_cast<std::size_t>(clamp(t, 0, 1) * 999);
    at = knots[i].center;
    along = normalized(knots[i + 1].center - knots[i].center);
}

constexpr double frameAt[] = {-58, 0, 58};

/// A slat that lies on the frames, and a bolt head above each.
void addSlat(Model& model, const Vec3& at, const Vec3& along, double halfWidth)
{
    const Vec3 x{1, 0, 0};
    const Vec3 up = cross(along, x);
    const double halfThickness = 1.4;
    const Vec3 center = at + (1.2 + halfThickness) * up; // sunk into the frame by a millimetre
    model.append(makeRoundedBox(center, {x, up, along}, {75, halfThickness, halfWidth}, 0.55, {80, 2, 5}, 2));
    for (const double place : frameAt) {
        const Vec3 head = center + halfThickness * up + place * x;
        model.append(makeRoundedBox(head, {0.9 * x, 0.42 * up, 0.9 * along}, {1, 1, 1}, 0.8, {1, 1, 1}, 2));
    }
}

} // namespace

Model makeBench()
{
    Model model;
    for (const double place : frameAt) {
        Model frame = makeFrame(place != 0);
        for (Vec3& p : frame.points) p.x += place;
        model.append(frame);
    }
    for (const double y : {10.0, 23.5}) { // rods from frame to frame
        const double z = y < 12 ? -28.7 : -1;
        const int steps = 75;
        model.append(makeBar({{{-61, y, z}, 0.9}, {{61, y, z}, 0.9}}, {0, 1, 0}, 0.9, 3, steps));
    }
    Vec3 at;
    Vec3 along;
    for (int i = 0; i < 7; ++i) {
        onCurve(seatRail, lerp(0.09, 0.96, i / 6.0), at, along);
        addSlat(model, at, along, 2.55);
    }
    for (int i = 0; i < 5; ++i) {
        onCurve(backPost, lerp(0.27, 0.955, i / 4.0), at, along);
        addSlat(model, at, -1 * along, 3.3);
    }
    // A plate on the uppermost slat.
    const Vec3 x{1, 0, 0};
    const Vec3 out = cross(x, along);
    model.append(makeRoundedBox(at + 4.05 * out, {x, along, out}, {7, 2.0, 0.3}, 0.2, {13, 7, 1}, 1));
    double ground = 0;
    for (const Vec3& p : model.points) ground = std::min(ground, p.y);
    for (Vec3& p : model.points) p.y -= ground;
    return model;
}

} // namespace data
