#pragma once

#include <functional>
#include <utility>
#include <vector>

#include "model.h"

namespace data {

/// Negative inside, positive outside, near the surface about the distance to it.
using Field = std::function<double(const Vec3&)>;

/// The smaller of two distances, rounded by a parabola where they differ by less than `width`.
inline double smoothMin(double a, double b, double width)
{
    const double h = width - std::fabs(a - b);
    const double least = a < b ? a : b;
    return h > 0 ? least - h * h / (4 * width) : least;
}

inline double smoothMax(double a, double b, double width)
{
    return -smoothMin(-a, -b, width);
}

/// A ball that moves along a curve and changes its radius: horns, legs, handles.
struct Knot {
    Vec3 center;
    double radius;
};

/// `knots` and, between each two, `steps` - 1 more on the Catmull-Rom spline through them.
std::vector<Knot> spline(const std::vector<Knot>& knots, int steps);

/// Distance to the hull of the moving ball, each piece between two knots being a cone with round ends.
double tubeDistance(const std::vector<Knot>& knots, const Vec3& p);

/// About the distance to the ellipsoid around `center` with the orthonormal `axes` and the half lengths `radii`.
double ellipsoidDistance(const Vec3& center, const std::array<Vec3, 3>& axes, const Vec3& radii, const Vec3& p);

constexpr std::array<Vec3, 3> upright = {Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}};

/// Clay: ellipsoids and tubes, each added to what is there or carved out of it, with a fillet of its own width.
class Clay {
public:
    void addEllipsoid(const Vec3& center, const Vec3& radii, double fillet, const std::array<Vec3, 3>& axes = upright);
    void addTube(const std::vector<Knot>& knots, double fillet);
    void carveEllipsoid(const Vec3& center, const Vec3& radii, double fillet,
                        const std::array<Vec3, 3>& axes = upright);
    void carveTube(const std::vector<Knot>& knots, double fillet);
    /// The Field.
    double operator()(const Vec3& p) const;

private:
    struct Part {
        std::vector<Knot> knots; // a tube, or empty for an ellipsoid
        std::array<Vec3, 3> axes;
        Vec3 radii;
        Vec3 center;  // of a ball around the part ...
        double reach; // ... and its radius
        double fillet;
        bool carve;
    };
    std::vector<Part> parts_;
};

/// A grid of cubes with side `cell` over the box from `low` to `high`; around `focus` it is drawn together by the
/// factor `density`, less and less up to the distance `reach` (of the grid before that).
struct Grid {
    Vec3 low, high;
    double cell;
    Vec3 focus = {0, 0, 0};
    double density = 1;
    double reach = 1;

    Vec3 operator()(int i, int j, int k) const;
};

/// The surface where `field` is zero, in quads whose corners lie on it: surface nets (Gibson 1998) on `grid`, then
/// `rounds` of moving each point towards the middle of its neighbours and back onto the surface. Features thinner
/// than two cells may be lost.
Model contour(const Field& field, const Grid& grid, int rounds);

/// Each quad as four, the new points moved onto the surface where `field` is zero.
Model subdivide(const Model& quads, const Field& field);

} // namespace data
