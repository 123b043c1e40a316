// Based on: Chang, Deng, Hormann, "Maximum Likelihood Coordinates", 2023: project to the unit sphere around the point,
// smooth, take the positive weights of maximum likelihood that balance.
// Differs: a face's non-negative weights of its corners are its mean value integrals, which grow without bound towards
// it, so that also bilinear faces are interpolated. The face's vector, its corners so weighted, keeps its length
// instead of being made a unit vector, so that many small faces far away count no more than one large one; and it is
// divided by the square of the face's distance, so that near faces count most. Equal lengths would make mean value
// coordinates wherever these are not negative.

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include <openvdb/math/Mat3.h>
#include <vdbcage/deform/detail/coordinate_family.h>
#include <vdbcage/deform/detail/families/mean_value.h>

namespace vdbcage::detail {

using openvdb::Vec3d;

namespace {

/// The distance, in units of the cage's longest side, below about which faces count alike.
constexpr double nearby = 0.02;

/// Finds the s for which the sum of z / (1 + s . z) over `vectors` is zero and all 1 + s . z are positive. There the
/// sum of their logarithms, which is concave, is greatest. Uses Newton's method and halves steps that go too far.
/// Returns false if there is none: all vectors are on one side of a plane.
bool balance(const std::vector<Vec3d>& vectors, Vec3d& s)
{
    const auto likelihood = [&](const Vec3d& at) {
        double sum = 0;
        for (const Vec3d& z : vectors) {
            const double factor = 1 + at.dot(z);
            if (!(factor > 0)) return -std::numeric_limits<double>::infinity();
            sum += std::log(factor);
        }
        return sum;
    };
    s = Vec3d(0);
    double value = 0;
    for (int step = 0; step < 200; ++step) {
        Vec3d gradient(0);
        openvdb::Mat3d curvature = openvdb::Mat3d::zero();
        double magnitude = 0;
        for (const Vec3d& z : vectors) {
            const Vec3d scaled = z / (1 + s.dot(z));
            gradient += scaled;
            magnitude += scaled.length();
            for (int r = 0; r < 3; ++r) {
                for (int c = 0; c < 3; ++c) curvature(r, c) += scaled[r] * scaled[c];
            }
        }
        if (gradient.length() <= 4e-16 * magnitude) return true;
        const double determinant = curvature.det();
        if (!(determinant > 0)) return false;
        const Vec3d direction = curvature.inverse(0.0) * gradient;
        const double decrement = direction.dot(gradient);
        if (decrement < 1e-9) { // so near that the full step only adds digits
            if (!(likelihood(s + direction) > -std::numeric_limits<double>::infinity())) return true;
            s += direction;
            if (decrement < 1e-28) return true;
            continue;
        }
        double length = 1;
        double next = likelihood(s + direction);
        while (!(next >= value + 0.1 * length * decrement) && length > 1e-12) {
            length *= 0.5;
            next = likelihood(s + length * direction);
        }
        s += length * direction;
        value = next;
    }
    return false;
}

/// Writes the weights, none of them negative. Returns false if `x` is outside of the cage, or if no non-negative
/// combination of the faces is balanced around it.
bool likelihoodRow(const UnitCage& cage, const Vec3d& x, double* row)
{
    const std::size_t count = cage.points().size();
    std::fill(row, row + count, 0.0);
    const UnitCage::Place nearest = cage.nearest(x);
    if (nearest.distance <= UnitCage::touching) {
        const UnitCage::Face& face = cage.faces()[nearest.face];
        for (std::size_t k = 0; k < 4; ++k) row[face.at[k]] += nearest.weights[k];
        return true;
    }
    std::vector<std::array<double, 4>> weights;
    std::vector<Vec3d> vectors;
    double winding = 0; // along every line through the point the nearest face counts most: positive if inside
    for (const UnitCage::Face& face : cage.faces()) {
        const PatchCorners c = cage.cornersFrom(face, x);
        std::array<double, 4> w = meanValueWeights(c, face.quad);
        Vec3d vector(0);
        for (std::size_t k = 0; k < 4; ++k) {
            winding += w[k];
            w[k] = std::abs(w[k]);
            vector += w[k] * c[k];
        }
        double total = 0;
        for (const double part : w) total += part;
        const double distance = vector.length() / total + nearby; // a mean over the face
        const double locality = total > 0 ? 1 / (distance * distance) : 0;
        for (double& part : w) part *= locality;
        weights.push_back(w);
        vectors.push_back(locality * vector);
    }
    Vec3d s;
    if (!(winding > 0) || !balance(vectors, s)) return false;
    double sum = 0;
    for (std::size_t i = 0; i < weights.size(); ++i) {
        const double factor = 1 / (1 + s.dot(vectors[i]));
        for (std::size_t k = 0; k < 4; ++k) {
            row[cage.faces()[i].at[k]] += factor * weights[i][k];
            sum += factor * weights[i][k];
        }
    }
    for (std::size_t i = 0; i < count; ++i) row[i] /= sum;
    return true;
}

constexpr FamilyInfo info{
    Coordinates::maximumLikelihood, "mlc", "mlc", "Likelihood", "maximum likelihood: never negative, most local",
    "Chang, Deng, Hormann 2023",
    /*isEverywhere*/ false,
    /*splitsQuads*/ false,
    /*hasResolution*/ false,
    /*hasElasticity*/ false};

} // namespace

extern constexpr CoordinateFamily maximumLikelihood{info, formulaRows<likelihoodRow>, &RowKernels::likelihood};

} // namespace vdbcage::detail
