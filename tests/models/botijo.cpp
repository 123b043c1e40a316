// A Spanish water jug: a hollow belly on a foot, a ring to carry it by, two ears, a mouth to fill it and a spout to
// drink from, held to the ring's foot by a strut. Genus 5: the way from mouth to spout, ring, ears and strut's gap.

#include "implicit.h"

namespace data {

namespace {

/// A closed circle of round section.
std::vector<Knot> hoop(const Vec3& center, const Vec3& axis, double radius, double thickness)
{
    const Vec3 n = normalized(axis);
    const Vec3 u{1, 0, 0}; // all axes here are in the plane of Y and Z
    const Vec3 v = cross(n, u);
    std::vector<Knot> knots;
    const int steps = 48;
    for (int i = 0; i <= steps; ++i) {
        double s = 0;
        double c = 0;
        sineCosine(2 * pi * i / steps, s, c);
        knots.push_back({center + (radius * c) * u + (radius * s) * v, thickness});
    }
    return knots;
}

/// Mouth and spout: where they start, how they run, and the rolled lip at their end.
struct Neck {
    std::vector<Knot> knots;
    double wall;
    double lip;

    Vec3 end() const { return knots.back().center; }
    Vec3 axis() const { return normalized(end() - knots[knots.size() - 2].center); }

    void add(Clay& clay) const
    {
        clay.addTube(spline(knots, 6), 2);
        const double radius = knots.back().radius;
        clay.addTube(hoop(end() + (0.45 * radius) * axis(), axis(), radius - 0.2 * lip, lip), 1.2);
    }

    /// The way through, from well inside the belly to well outside the lip.
    void carve(Clay& hollow, const Knot& start) const
    {
        std::vector<Knot> way{start};
        for (const Knot& knot : spline(knots, 6)) way.push_back({knot.center, knot.radius - wall});
        way.push_back({end() + 6.0 * axis(), knots.back().radius - wall});
        hollow.addTube(way, 1.5);
    }
};

Field makeField()
{
    Clay clay;
    clay.addEllipsoid({0, 13.5, 0}, {10.2, 9.6, 10.2}, 1); // belly
    clay.addEllipsoid({0, 8.0, 0}, {7.2, 6.4, 7.2}, 4);
    clay.addTube({{{0, 3.2, 0}, 3.4}, {{0, 2.4, 0}, 3.8}}, 3);
    clay.addTube(hoop({0, 1.1, 0}, {0, 1, 0}, 4.8, 1.5), 2.5); // foot
    clay.addTube(hoop({0, 18.8, 0}, {0, 1, 0}, 7.9, 0.9), 2);  // shoulder
    std::vector<Knot> ring;                                    // stands on the top of the belly, across
    for (int i = 0; i <= 40; ++i) {
        const double t = i / 40.0;
        double s = 0;
        double c = 0;
        sineCosine(pi * (1.28 - 1.56 * t), s, c);
        ring.push_back({{4.4 * c, 26.6 + 4.7 * s, 0}, lerp(1.05, 1.3, 4 * (t - 0.5) * (t - 0.5))});
    }
    clay.addTube(ring, 1.6);
    clay.addEllipsoid({0, 22.6, 0}, {3.6, 1.6, 2.2}, 2);
    clay.addEllipsoid({0, 31.7, 0}, {1.1, 1.2, 1.1}, 1.2);
    for (const double side : {-1.0, 1.0}) { // ears
        clay.addTube(spline({{{8.2 * side, 18.2, 0}, 1.3},
                             {{11.2 * side, 19.6, 0}, 1.05},
                             {{13.6 * side, 17.2, 0}, 1.05},
                             {{13.2 * side, 13.2, 0}, 1.05},
                             {{9.6 * side, 11.0, 0}, 1.35}},
                            8),
                     1.5);
    }
    const Neck mouth{
        {{{0, 19.0, -5.4}, 3.2}, {{0, 22.2, -7.6}, 2.6}, {{0, 24.0, -8.9}, 2.7}, {{0, 25.2, -9.8}, 2.95}}, 1.1, 0.9};
    const Neck spout{
        {{{0, 18.6, 5.6}, 2.6}, {{0, 21.2, 8.1}, 2.05}, {{0, 24.2, 10.4}, 1.8}, {{0, 27.0, 11.9}, 1.7}}, 0.95, 0.75};
    mouth.add(clay);
    spout.add(clay);
    clay.addTube(
        spline({{{0, 25.0, 10.4}, 0.9}, {{0, 26.4, 7.0}, 0.85}, {{0, 25.4, 3.6}, 0.9}, {{0, 22.4, 1.8}, 1.0}}, 6),
        1.2); // strut

    // The inside: the belly with a wall of more than a centimetre, and the two ways out.
    Clay hollow;
    hollow.addEllipsoid({0, 13.5, 0}, {9.0, 8.4, 9.0}, 1);
    hollow.addEllipsoid({0, 8.8, 0}, {5.8, 5.2, 5.8}, 4);
    mouth.carve(hollow, {{0, 15, -2.5}, 2.2});
    spout.carve(hollow, {{0, 15, 2.5}, 1.9});

    return [clay, hollow](const Vec3& p) {
        return smoothMax(smoothMax(clay(p), -hollow(p), 1), 0.25 - p.y, 1.8); // the foot stands flat
    };
}

} // namespace

Model makeBotijo()
{
    const Model quads =
        contour(makeField(), {{-22.713, -5.813, -22.313}, {23, 45, 23}, 0.745, {0, 26, 1}, 1.35, 50}, 12);
    Model triangles;
    triangles.points = quads.points;
    for (const Face& q : quads.faces) {
        triangles.addTriangle(q[0], q[1], q[2]);
        triangles.addTriangle(q[0], q[2], q[3]);
    }
    return triangles;
}

} // namespace data
