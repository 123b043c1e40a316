#include "implicit.h"

namespace data {

namespace {

/// Turns the head and neck: the further from the neck's root, the more.
struct Pose {
    Vec3 root;
    double yaw;  // radians to the animal's left
    double tilt; // radians of the head to its side

    Vec3 operator()(const Vec3& p) const
    {
        const Vec3 d = p - root;
        double sy = 0;
        double cy = 0;
        double st = 0;
        double ct = 0;
        const double part = smoothStep(-6, 34, 0.6 * d.y + 0.6 * d.z);
        sineCosine(part * tilt, st, ct);
        sineCosine(part * yaw, sy, cy);
        const Vec3 tilted{ct * d.x - st * d.y, st * d.x + ct * d.y, d.z};
        return root + Vec3{cy * tilted.x + sy * tilted.z, tilted.y, cy * tilted.z - sy * tilted.x};
    }
};

const Pose pose{{0, 70, 32}, 0.38, 0.05};

std::vector<Knot> posed(std::vector<Knot> knots)
{
    for (Knot& knot : knots) knot.center = pose(knot.center);
    return knots;
}

/// Orthonormal axes in the turned head: the third along `along`, the first near `flat`.
std::array<Vec3, 3> posedAxes(const Vec3& center, const Vec3& flat, const Vec3& along)
{
    const Vec3 z = normalized(pose(center + 0.01 * normalized(along)) - pose(center));
    const Vec3 side = pose(center + 0.01 * normalized(flat)) - pose(center);
    const Vec3 x = normalized(side - dot(side, z) * z);
    return {x, cross(z, x), z};
}

void addHeadEllipsoid(Clay& clay, const Vec3& center, const Vec3& radii, double fillet, const Vec3& along)
{
    clay.addEllipsoid(pose(center), radii, fillet, posedAxes(center, {1, 0, 0}, along));
}

/// `fetlock` is the joint above the hoof.
void addHoof(Clay& clay, const Vec3& fetlock)
{
    // Two toes that lean forward; the ground cuts them flat.
    for (const double side : {-1.0, 1.0}) {
        clay.addTube({{fetlock + Vec3{0.9 * side, -1.5, 0.6}, 2.3},
                      {{fetlock.x + 1.6 * side, 3.2, fetlock.z + 2.6}, 2.5},
                      {{fetlock.x + 1.95 * side, 0.6, fetlock.z + 4.4}, 2.6}},
                     1.2);
    }
    for (const double side : {-1.0, 1.0}) // dew claws
        clay.addTube({{fetlock + Vec3{1.3 * side, -0.4, -1.8}, 1.7}, {fetlock + Vec3{1.5 * side, -1.6, -2.6}, 1.5}},
                     1.5);
}

/// `x` is the place across, `step` moves the hoof along the stride.
void addForeleg(Clay& clay, double x, double step)
{
    const double s = x < 0 ? -1 : 1;
    clay.addEllipsoid({x - 1.5 * s, 61, 24}, {6.2, 17, 10}, 7);
    clay.addTube(spline({{{x - 1.0 * s, 57, 26}, 8.2},
                         {{x, 46, 22.5 + 0.1 * step}, 6.6},
                         {{x, 38, 23.5 + 0.35 * step}, 5.2},
                         {{x - 0.2 * s, 31, 24.5 + 0.6 * step}, 4.0}},
                        3),
                 5);
    const Vec3 knee{x - 0.3 * s, 27.5, 25 + 0.7 * step};
    const Vec3 fetlock{x - 0.3 * s, 8.6, 24 + step};
    clay.addEllipsoid(knee, {3.7, 4.4, 4.0}, 4);
    clay.addTube({{knee, 3.4}, {lerp(knee, fetlock, 0.45), 2.7}, {fetlock, 2.8}}, 2.5);
    clay.addEllipsoid(fetlock, {3.1, 3.2, 3.3}, 2);
    addHoof(clay, fetlock);
}

void addHindLeg(Clay& clay, double x, double step)
{
    const double s = x < 0 ? -1 : 1;
    clay.addEllipsoid({x - 2.6 * s, 58, -29}, {7.8, 18, 14}, 8,
                      {Vec3{1, 0, 0}, Vec3{0, 0.96, -0.28}, Vec3{0, 0.28, 0.96}});
    const Vec3 hock{x - 0.4 * s, 29.5, -40 + 0.7 * step};
    clay.addTube(spline({{{x - 1.5 * s, 55, -26}, 10},
                         {{x, 45.5, -23 + 0.2 * step}, 7.6},
                         {{x, 38, -29.5 + 0.4 * step}, 5.6},
                         {{x - 0.2 * s, 33.0, -36 + 0.6 * step}, 4.0},
                         {hock, 3.5}},
                        3),
                 5);
    const Vec3 fetlock{x - 0.4 * s, 8.6, -35.5 + step};
    clay.addTube({{hock + Vec3{0, 2.2, -1.6}, 2.3}, {hock, 3.4}}, 2);
    clay.addTube({{hock, 3.4}, {lerp(hock, fetlock, 0.45), 2.7}, {fetlock, 2.9}}, 2.5);
    clay.addEllipsoid(fetlock, {3.1, 3.2, 3.3}, 2);
    addHoof(clay, fetlock);
}

void addTorso(Clay& clay)
{
    clay.addEllipsoid({0, 60, 17}, {14, 19.5, 24}, 8);   // rib cage
    clay.addEllipsoid({0, 59, -6}, {15, 15.5, 26}, 12);  // belly
    clay.addEllipsoid({0, 63, -26}, {12.5, 15, 18}, 12); // rump
    clay.addTube(spline({{{0, 75, 22}, 6.5}, {{0, 72.5, 2}, 7}, {{0, 72, -20}, 7}, {{0, 67.5, -38}, 5}}, 4), 9); // back
    clay.addEllipsoid({0, 54, 33}, {9.5, 12, 10}, 8); // breast
    clay.addTube(spline({{{0, 69, -42}, 3.8}, {{0, 69.8, -47}, 3.1}, {{0, 67, -52}, 2.6}, {{0, 61, -54.5}, 1.5}}, 4),
                 3); // tail
}

void addEar(Clay& clay, double s)
{
    const Vec3 center{12.2 * s, 101.2, 54.5};
    const Vec3 along{1.0 * s, 0.18, -0.35};
    const Vec3 flat{0, 0.45, 0.9};
    const auto axes = posedAxes(center, flat, along);
    clay.addEllipsoid(pose(center), {2.4, 3.7, 7.8}, 2, axes);
    // The cup: the side that looks forward is hollow.
    const Vec3 front = pose(center) + 2.6 * axes[0];
    clay.carveEllipsoid(front + 0.3 * axes[2], {2.2, 2.6, 6.2}, 2, axes);
}

/// Most of a circle that leans outward; its rings are thicker than what is between them.
void addHorn(Clay& clay, double s)
{
    std::vector<Knot> horn;
    const int steps = 84;
    for (int i = 0; i <= steps; ++i) {
        const double t = static_cast<double>(i) / steps;
        double sn = 0;
        double cs = 0;
        sineCosine(-0.30 + 2.95 * t, sn, cs);
        const double radius = lerp(25, 20, t);
        const double ring = 0.38 * (1 - t * t) * cosine(2 * pi * 12 * t);
        horn.push_back({pose({(3.5 + 3 * t + 14 * t * t) * s, 108 + radius * sn, 37.5 + radius * cs}),
                        lerp(3.9, 1.3, smoothStep(-0.2, 1.1, t)) + ring});
    }
    clay.addTube(horn, 1.2);
}

void addHead(Clay& clay)
{
    clay.addTube(posed(spline({{{0, 64, 27}, 14}, {{0, 75, 39}, 11.4}, {{0, 86, 48.5}, 9.0}, {{0, 97, 55}, 7.2}}, 4)),
                 9);
    addHeadEllipsoid(clay, {0, 99.5, 60}, {6.3, 6.8, 8.6}, 4, {0, -0.25, 1});                                // skull
    clay.addTube(posed(spline({{{0, 98.5, 63}, 5.4}, {{0, 95, 71}, 4.3}, {{0, 91.8, 78.5}, 3.5}}, 4)), 4);   // nose
    clay.addTube(posed(spline({{{0, 92.5, 59}, 4.8}, {{0, 90, 67}, 3.8}, {{0, 87.6, 75.5}, 2.7}}, 4)), 3);   // jaw
    addHeadEllipsoid(clay, {0, 90.8, 79.6}, {3.7, 3.2, 3.0}, 1.5, {0, -0.45, 1});                            // muzzle
    clay.addTube(posed(spline({{{0, 86.5, 71}, 2.5}, {{0, 81, 70.5}, 2.2}, {{0, 75, 67.5}, 1.0}}, 4)), 1.5); // beard
    for (const double s : {-1.0, 1.0}) {
        addHorn(clay, s);
        addEar(clay, s);
        // Eye: a ball in a shallow socket, below a brow.
        clay.carveEllipsoid(pose({7.0 * s, 99.8, 66.8}), {1.7, 2.4, 3.2}, 2,
                            posedAxes({6 * s, 100, 66}, {1, 0, 0}, {0, -0.4, 1}));
        clay.addTube(
            posed({{{3.8 * s, 103.2, 66.0}, 1.4}, {{5.9 * s, 102.3, 65.2}, 1.3}, {{6.3 * s, 101.3, 62.5}, 1.1}}), 1.6);
        addHeadEllipsoid(clay, {5.2 * s, 99.9, 66.0}, {1.7, 1.6, 2.0}, 0.5, {0, -0.4, 1});
        // Nostril and mouth.
        clay.carveTube(posed({{{1.6 * s, 92.4, 82.6}, 0.7}, {{3.0 * s, 93.5, 81.2}, 0.8}}), 1.2);
        clay.carveTube(posed({{{0, 88.6, 82.4}, 0.5},
                              {{2.7 * s, 88.6, 80.8}, 0.55},
                              {{4.3 * s, 89.6, 75}, 0.5},
                              {{5.0 * s, 90.6, 71}, 0.3}}),
                       1.3);
    }
}

Field makeField()
{
    Clay clay;
    addTorso(clay);
    addHead(clay);
    addForeleg(clay, 9.5, 5);
    addForeleg(clay, -9.5, -3);
    addHindLeg(clay, 9.5, -5);
    addHindLeg(clay, -9.5, 4);
    return [clay](const Vec3& p) { return smoothMax(clay(p), -p.y, 1.8); };
}

Model makeNet(const Field& field, double cell)
{
    // Not round numbers: no point of the grid lies on the animal's middle plane or on the ground.
    return contour(field, {{-70.37, -4.63, -64.41}, {80, 180, 150}, cell, {8, 96, 68}, 2, 110}, 12);
}

} // namespace

Model makeCreature()
{
    return makeNet(makeField(), 1.42);
}

Model makeCreature2m()
{
    const Field field = makeField();
    return subdivide(subdivide(subdivide(makeNet(field, 1.54), field), field), field);
}

} // namespace data
