// Based on: Ju, Schaefer, Warren, "Mean Value Coordinates for Closed Triangular Meshes", 2005; Thiery, Memari,
// Boubekeur, "Mean Value Coordinates for Quad Cages in 3D", 2018.
// Differs: the integrals over bilinear patches, which have no closed form, are integrated adaptively instead of
// approximated; so are those of triangles seen nearly edge-on, where the closed form cancels. Affine precision lost by
// rounding and integration is restored at the end.

#include <vdbcage/deform/detail/families/mean_value.h>

#include <algorithm>
#include <cmath>

#include <vdbcage/deform/detail/coordinate_family.h>
#include <vdbcage/deform/detail/families/patch_quadrature.h>

namespace vdbcage::detail {

using openvdb::Vec3d;

namespace {

std::array<double, 4> integrated(const PatchCorners& corners)
{
    std::array<double, 4> weights{};
    // Pieces of the least size matter only to points that count as on the cage.
    samplePatch(corners, 0.01 * UnitCage::touching, [&](const PatchSample& sample) {
        const double square = sample.point.lengthSqr();
        const double value = sample.point.dot(sample.normal) / (square * square);
        for (std::size_t i = 0; i < 4; ++i) weights[i] += value * sample.basis[i];
    });
    return weights;
}

/// Computes the weights. Returns false if the closed form would cancel.
bool closedForm(const PatchCorners& c, std::array<double, 4>& weights)
{
    std::array<Vec3d, 3> crosses; // of the edge opposite the corner
    Vec3d mean(0);                // the integral of the direction
    double widest = 0;
    for (std::size_t i = 0; i < 3; ++i) {
        const Vec3d &from = c[(i + 1) % 3], &to = c[(i + 2) % 3];
        crosses[i] = from.cross(to);
        const double length = crosses[i].length();
        const double angle = std::atan2(length, from.dot(to));
        widest = std::max(widest, angle);
        if (length > 0) mean += 0.5 * angle / length * crosses[i];
    }
    const double determinant = c[0].dot(crosses[0]);
    const double product = c[0].length() * c[1].length() * c[2].length();
    if (!(std::abs(determinant) > 1e-3 * widest * widest * product || (mean.length() > 0.05 && determinant != 0))) {
        return false;
    }
    for (std::size_t i = 0; i < 3; ++i) weights[i] = mean.dot(crosses[i]) / determinant;
    weights[3] = 0;
    return true;
}

} // namespace

std::array<double, 4> meanValueWeights(const PatchCorners& corners, bool quad)
{
    std::array<double, 4> weights;
    if (!quad && closedForm(corners, weights)) return weights;
    weights = integrated(corners);
    if (!quad) {
        weights[2] += weights[3];
        weights[3] = 0;
    }
    return weights;
}

bool exactMeanValue(const UnitCage& cage, std::size_t face, const double (&x)[3], double (&weights)[4])
{
    const Vec3d from(x);
    if (cage.nearestOf(face, from).distance < tooNear) return false;
    const UnitCage::Face& f = cage.faces()[face];
    const std::array<double, 4> exact = meanValueWeights(cage.cornersFrom(f, from), f.quad);
    std::copy(exact.begin(), exact.end(), weights);
    return true;
}

namespace {

/// Writes the weights; they exist everywhere.
bool meanValueRow(const UnitCage& cage, const Vec3d& x, double* row)
{
    const std::size_t count = cage.points().size();
    std::fill(row, row + count, 0.0);
    const auto add = [&](const UnitCage::Face& face, const std::array<double, 4>& weights) {
        for (std::size_t i = 0; i < 4; ++i) row[face.at[i]] += weights[i];
    };
    const UnitCage::Place nearest = cage.nearest(x);
    if (nearest.distance <= UnitCage::touching) {
        add(cage.faces()[nearest.face], nearest.weights);
    } else {
        for (const UnitCage::Face& face : cage.faces()) {
            add(face, meanValueWeights(cage.cornersFrom(face, x), face.quad));
        }
    }
    double sum = 0;
    for (std::size_t i = 0; i < count; ++i) sum += row[i];
    Vec3d missing = x;
    for (std::size_t i = 0; i < count; ++i) {
        row[i] /= sum;
        missing -= row[i] * cage.points()[i];
    }
    cage.restore(missing, row);
    return true;
}

constexpr FamilyInfo info{Coordinates::meanValue,
                          "mvc",
                          "qmvc",
                          "Mean value",
                          "smooth, and anywhere; can be negative",
                          "Ju, Schaefer, Warren 2005; Thiery, Memari, Boubekeur 2018",
                          /*isEverywhere*/ true,
                          /*splitsQuads*/ false,
                          /*hasResolution*/ false,
                          /*hasElasticity*/ false};

} // namespace

extern constexpr CoordinateFamily meanValue{info, formulaRows<meanValueRow>, &RowKernels::meanValue};

} // namespace vdbcage::detail
