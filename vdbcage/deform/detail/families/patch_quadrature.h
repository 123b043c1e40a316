#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include <openvdb/math/Vec3.h>
#include <vdbcage/deform/detail/gauss.h>
#include <vdbcage/deform/detail/unit_cage.h>

namespace vdbcage::detail {

/// One sample of a bilinear patch p(u, v), where (u, v) is in the unit square.
struct PatchSample {
    openvdb::Vec3d point;
    openvdb::Vec3d normal;       ///< dp/du x dp/dv, times `area`
    std::array<double, 4> basis; ///< of the corners
    double area;                 ///< du dv
};

/// Integrates functions over a bilinear patch: calls `visit` with samples to be summed up. The relative error is about
/// 1e-9.
///
/// The functions must be smooth in u and v except where the patch comes close to the origin, such as powers of the
/// distance times polynomials.
///
/// The patch is halved until each piece can be integrated by a Gauss rule of known accuracy. For a function of u that
/// is analytic within the ellipse around [-1, 1] whose half axes have the sum r, the error of n Gauss points is
/// r^(-2n). On a line of half length s at the distance d from the origin, the distance to the origin has its zeros at
/// complex u no nearer to the line than d / s. The ellipse through them has r = d / s + sqrt(1 + (d / s)^2), or more.
///
/// Pieces smaller than `least`, in the units of the corners, are left out.
template <typename Visit>
void samplePatch(const PatchCorners& corners, double least, const Visit& visit)
{
    using openvdb::Vec3d;
    struct Piece {
        PatchCorners c;
        double u, v, du, dv;
    };
    constexpr double digits = 9 * 2.302585092994046; // of the tolerance
    constexpr double caution = 0.8;                  // the function grows towards the ellipse
    constexpr int leastPoints = 4;                   // exact for polynomial functions
    // Ten times as many as the nearest points of regular patches need. Where the corners and the origin are in line, a
    // whole curve of u and v is at the origin; such a patch has no area, and its weights are almost zero.
    constexpr int mostSplits = 10000;

    std::array<Piece, 256> stack;
    std::size_t top = 0;
    int splits = 0;
    stack[top++] = {corners, 0, 0, 1, 1};
    while (top > 0) {
        const Piece piece = stack[--top];
        const PatchCorners& c = piece.c;
        const Vec3d middle = 0.25 * (c[0] + c[1] + c[2] + c[3]);
        const double away = middle.length();
        double radius = 0, front = away;
        for (const Vec3d& corner : c) {
            radius = std::max(radius, (corner - middle).length());
            if (away > 0) front = std::min(front, corner.dot(middle) / away);
        }
        if (radius < least) continue;
        const double distance = std::max({away - radius, front, 0.0});
        const double halfU = 0.5 * std::max((c[1] - c[0]).length(), (c[2] - c[3]).length());
        const double halfV = 0.5 * std::max((c[3] - c[0]).length(), (c[2] - c[1]).length());
        const auto points = [&](double halfLength) {
            const double ratio = caution * distance;
            if (ratio < 0.5 * halfLength) return mostGaussPoints + 1;
            if (ratio > 100 * halfLength) return leastPoints;
            const double r = ratio / halfLength;
            const double needed = std::ceil(digits / (2 * std::asinh(r))); // asinh(r) = log(r + sqrt(1 + r^2))
            return std::max(leastPoints, static_cast<int>(needed));
        };
        const int inU = points(halfU), inV = points(halfV);
        if (std::max(inU, inV) > mostGaussPoints && top + 2 <= stack.size() && splits < mostSplits) {
            ++splits;
            Piece a = piece, b = piece;
            if (halfU > halfV) {
                a.du = b.du = 0.5 * piece.du;
                b.u += a.du;
                a.c[1] = b.c[0] = 0.5 * (c[0] + c[1]);
                a.c[2] = b.c[3] = 0.5 * (c[3] + c[2]);
            } else {
                a.dv = b.dv = 0.5 * piece.dv;
                b.v += a.dv;
                a.c[3] = b.c[0] = 0.5 * (c[0] + c[3]);
                a.c[2] = b.c[1] = 0.5 * (c[1] + c[2]);
            }
            stack[top++] = a;
            stack[top++] = b;
            continue;
        }
        const int pointsU = std::min(inU, mostGaussPoints), pointsV = std::min(inV, mostGaussPoints);
        const GaussRule &ruleU = gaussRule(pointsU), &ruleV = gaussRule(pointsV);
        for (std::size_t j = 0; j < static_cast<std::size_t>(pointsV); ++j) {
            const double t = ruleV.at[j], v = piece.v + t * piece.dv;
            const Vec3d from = c[0] + t * (c[3] - c[0]), along = c[1] + t * (c[2] - c[1]) - from;
            for (std::size_t i = 0; i < static_cast<std::size_t>(pointsU); ++i) {
                const double s = ruleU.at[i], u = piece.u + s * piece.du;
                const double weight = ruleU.weight[i] * ruleV.weight[j];
                const Vec3d across = (1 - s) * (c[3] - c[0]) + s * (c[2] - c[1]);
                visit(PatchSample{from + s * along,
                                  weight * along.cross(across),
                                  {(1 - u) * (1 - v), u * (1 - v), u * v, (1 - u) * v},
                                  weight * piece.du * piece.dv});
            }
        }
    }
}

} // namespace vdbcage::detail
