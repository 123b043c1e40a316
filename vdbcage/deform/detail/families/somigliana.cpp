// Based on: Chen, de Goes, Desbrun, "Somigliana Coordinates: an elasticity-derived approach for cage deformation",
// 2023; for the integration by parts Kupradze and others, "Three-Dimensional Problems of the Mathematical Theory of
// Elasticity and Thermoelasticity", 1979; for the closed forms see triangle_potentials.h.
// Differs: the integral of the displacements is taken by parts, which leaves Green's coordinates of the points and the
// triangles' integrals of Kelvin's solution. These need six numbers a triangle for any material, in place of nine a
// point and nine a triangle for one material. Matrices are turned by triangle, not by point: then they move along with
// the cage without a division by their sum. The scale of the cage is that of its volume.
//
// Somigliana's identity: u(x) is the integral of K t - T u over the cage, for Kelvin's solution K = (3 - 4 nu) / r +
// r r^T / r^3, over 16 pi mu (1 - nu), its traction T, and the traction t that belongs to u. By parts, -T u becomes
// Green's double layer of u, plus the integral of (1 / (4 pi r) - 2 mu K) M u, where M has the entries
// d_i n_j - n_i d_j of the tangential derivatives d. M u is constant on a triangle whose points u is linear between.

#include <algorithm>
#include <array>
#include <cmath>

#include <openvdb/math/Mat3.h>
#include <vdbcage/core/detail/longest_side.h>
#include <vdbcage/deform/detail/coordinate_family.h>
#include <vdbcage/deform/detail/families/patch_quadrature.h>
#include <vdbcage/deform/detail/triangle_potentials.h>
#include <vdbcage/deform/detail/triangles.h>

namespace vdbcage::detail {

using openvdb::Mat3d;
using openvdb::Vec3d;

namespace {

/// A triangle's frame: its normal, the direction of its first edge, and the normal cross that.
using FaceFrame = std::array<Vec3d, 3>;

Vec3d unit(const Vec3d& v)
{
    const double length = v.length();
    return length > 0 ? v / length : Vec3d(0);
}

/// Returns the frame of edges `a` and `b` from the first corner; all zero if the triangle has no area.
FaceFrame faceFrame(const Vec3d& a, const Vec3d& b)
{
    const Vec3d normal = unit(a.cross(b));
    if (normal.isZero()) return {Vec3d(0), Vec3d(0), Vec3d(0)};
    const Vec3d first = unit(a);
    return {normal, first, normal.cross(first)};
}

/// The weights of a triangle's corners, and its matrix.
struct FacePart {
    std::array<double, 3> positions{};
    std::array<double, somiglianaWeights> matrix{};
};

FacePart integrated(const PatchCorners& corners, const FaceFrame& frame)
{
    FacePart part;
    samplePatch(corners, 1e-10, [&](const PatchSample& sample) {
        const Vec3d& r = sample.point;
        const double square = r.lengthSqr();
        const double inverse = 1 / (fourPi * square * std::sqrt(square));
        const double solid = r.dot(sample.normal) * inverse;
        for (std::size_t i = 0; i < 4; ++i) part.positions[std::min<std::size_t>(i, 2)] += solid * sample.basis[i];
        const double weight = sample.normal.length() * inverse;
        std::size_t k = 0;
        for (std::size_t i = 0; i < 3; ++i) {
            for (std::size_t j = i; j < 3; ++j) part.matrix[k++] += weight * r.dot(frame[i]) * r.dot(frame[j]);
        }
    });
    return part;
}

FacePart closedForm(const PatchCorners& c, const FaceFrame& frame, bool onFace)
{
    const TrianglePotentials t = trianglePotentials({c[0], c[1], c[2]}, onFace);
    FacePart part;
    double n1 = 0, n2 = 0, s11 = t.single, s12 = 0, s22 = t.single;
    for (std::size_t i = 0; i < 3; ++i) {
        part.positions[i] = t.hatSolid[i] / fourPi;
        const Vec3d outward = t.outward(i);
        const double m1 = outward.dot(frame[1]), m2 = outward.dot(frame[2]);
        // The integral of r / |r| along the edge, in the plane.
        const double across = t.foot[i] * t.edge[i], along = c[(i + 1) % 3].length() - c[i].length();
        const double e1 = across * m1 - along * m2, e2 = across * m2 + along * m1;
        n1 -= t.height * t.edge[i] * m1;
        n2 -= t.height * t.edge[i] * m2;
        s11 -= e1 * m1;
        s12 -= 0.5 * (e1 * m2 + e2 * m1);
        s22 -= e2 * m2;
    }
    part.matrix = {t.height * t.solid, n1, n2, s11, s12, s22};
    for (double& entry : part.matrix) entry /= fourPi;
    return part;
}

FacePart facePart(const PatchCorners& corners, const FaceFrame& frame, bool onFace)
{
    return isSliver(corners[1] - corners[0], corners[2] - corners[0]) ? integrated(corners, frame)
                                                                      : closedForm(corners, frame, onFace);
}

/// A rotation around `from`, which moves to `to`.
struct Motion {
    Vec3d from{0}, to{0};
    Mat3d rotation = Mat3d::identity();
};

/// Returns the motion that brings the points `from` nearest to `to`, by `weights`: Kabsch 1976.
Motion bestMotion(const std::vector<Vec3d>& from, const std::vector<Vec3d>& to, const std::vector<double>& weights)
{
    double total = 0;
    Motion motion;
    for (std::size_t i = 0; i < from.size(); ++i) {
        total += weights[i];
        motion.from += weights[i] * from[i];
        motion.to += weights[i] * to[i];
    }
    motion.from /= total;
    motion.to /= total;
    Mat3d product = Mat3d::zero();
    for (std::size_t i = 0; i < from.size(); ++i) {
        const Vec3d a = from[i] - motion.from, b = weights[i] * (to[i] - motion.to);
        for (int r = 0; r < 3; ++r) {
            for (int c = 0; c < 3; ++c) product(r, c) += b[r] * a[c];
        }
    }
    Mat3d axes;
    Vec3d squares;
    if (!openvdb::math::diagonalizeSymmetricMatrix(product.transpose() * product, axes, squares)) return motion;
    std::array<int, 3> order{0, 1, 2};
    std::sort(order.begin(), order.end(), [&](int i, int j) { return squares[i] > squares[j]; });
    const Vec3d a = axes.col(order[0]), b = axes.col(order[1]), c = a.cross(b);
    const Vec3d turnedA = unit(product * a), rest = product * b;
    const Vec3d turnedB = unit(rest - rest.dot(turnedA) * turnedA), turnedC = turnedA.cross(turnedB);
    for (int r = 0; r < 3; ++r) motion.rotation.setRow(r, turnedA[r] * a + turnedB[r] * b + turnedC[r] * c);
    return motion;
}

/// Returns the normals of the points, by area.
std::vector<Vec3d> pointNormals(const std::vector<Vec3d>& points, const std::vector<openvdb::Vec3I>& triangles)
{
    std::vector<Vec3d> normals(points.size(), Vec3d(0));
    for (const openvdb::Vec3I& t : triangles) {
        const Vec3d normal = (points[t[1]] - points[t[0]]).cross(points[t[2]] - points[t[0]]);
        for (int k = 0; k < 3; ++k) normals[t[k]] += normal;
    }
    for (Vec3d& normal : normals) normal = unit(normal);
    return normals;
}

/// A pose of a cage, in units of its size.
class CagePose {
public:
    CagePose(const Mesh& cage, const std::vector<Vec3d>& posed, const Elasticity& elasticity)
        : triangles_(triangulateByShorterDiagonal(cage)), elasticity_(elasticity), size_(longestSide(boundingBox(cage)))
    {
        for (const Vec3d& p : cage.points) rest_.push_back(p / size_);
        for (const Vec3d& p : posed) posed_.push_back(p / size_);
        std::vector<double> areas(rest_.size(), 0.0);
        for (const openvdb::Vec3I& t : triangles_) {
            const double area = edge(rest_, t, 1).cross(edge(rest_, t, 2)).length();
            for (int k = 0; k < 3; ++k) areas[t[k]] += area;
        }
        motion_ = bestMotion(rest_, posed_, areas);
        const double volume = sixfoldVolume(rest_, triangles_);
        scale_ = volume > 0 ? std::cbrt(std::max(0.0, sixfoldVolume(posed_, triangles_) / volume)) : 1;
        for (const openvdb::Vec3I& t : triangles_) faces_.push_back(posedFace(t));
        const std::vector<double> bulges = bulging(volume);
        for (std::size_t i = 0; i < faces_.size(); ++i) faces_[i].traction = traction(faces_[i].stretch, bulges[i]);
        balance();
    }

    void addHandles(std::vector<Vec3d>& handles) const
    {
        const double nu = elasticity_.nu, share = 1 / (4 * (1 - nu));
        for (const Face& face : faces_) {
            const FaceFrame& f = face.turned;
            // In the frame: M u, and the traction without the 2 mu M u that accompanies it in Kelvin's solution.
            const Vec3d turning(-face.gradient[0][1] - face.gradient[1][2], face.gradient[0][0], face.gradient[1][0]);
            const Vec3d pull = share * (Vec3d(face.traction, 0, 0) - 2 * turning);
            const Vec3d single = (3 - 4 * nu) * pull + turning; // for 1 / r, the trace of the matrix
            const Vec3d onTrace = single[0] * f[0] + single[1] * f[1] + single[2] * f[2];
            for (std::size_t i = 0; i < 3; ++i) {
                for (std::size_t j = i; j < 3; ++j) {
                    const Vec3d both = pull[static_cast<int>(j)] * f[i] + pull[static_cast<int>(i)] * f[j];
                    handles.push_back(size_ * (i == j ? 0.5 * both + onTrace : both));
                }
            }
        }
    }

private:
    struct Face {
        FaceFrame turned; ///< its frame at rest, turned by the pose
        double area;      ///< twice that at rest
        double stretch;
        double traction;
        /// Derivatives of the place along the frame's second and third vector, in the axes of `turned`.
        std::array<Vec3d, 2> gradient;
    };

    static Vec3d edge(const std::vector<Vec3d>& points, const openvdb::Vec3I& t, int k)
    {
        return points[t[k]] - points[t[0]];
    }

    Face posedFace(const openvdb::Vec3I& t) const
    {
        Face face{};
        const Vec3d a = edge(rest_, t, 1), b = edge(rest_, t, 2);
        const FaceFrame frame = faceFrame(a, b);
        if (frame[0].isZero()) return face;
        face.area = a.cross(b).length();
        const Vec3d posedA = edge(posed_, t, 1), posedB = edge(posed_, t, 2);
        const Vec3d first = posedA / a.length(), second = (posedB - b.dot(frame[1]) * first) / b.dot(frame[2]);
        if (elasticity_.rotations == Elasticity::Rotations::global) {
            for (std::size_t i = 0; i < 3; ++i) face.turned[i] = motion_.rotation * frame[i];
            face.stretch = scale_;
        } else {
            const FaceFrame own = faceFrame(first, second);
            // The rotation in the plane nearest to the motion, whose trace is twice the mean stretch.
            const double cosine = first.dot(own[1]) + second.dot(own[2]), sine = first.dot(own[2]) - second.dot(own[1]);
            const double length = std::hypot(cosine, sine);
            if (own[0].isZero() || !(length > 0)) return face; // the posed triangle has no normal
            face.turned = {own[0], (cosine * own[1] + sine * own[2]) / length,
                           (cosine * own[2] - sine * own[1]) / length};
            face.stretch = 0.5 * length;
        }
        for (int i = 0; i < 3; ++i) {
            face.gradient[0][i] = first.dot(face.turned[static_cast<std::size_t>(i)]);
            face.gradient[1][i] = second.dot(face.turned[static_cast<std::size_t>(i)]);
        }
        return face;
    }

    /// Returns for each triangle the stretch along the normal over that in the plane, as a factor's logarithm.
    std::vector<double> bulging(double volume) const
    {
        std::vector<double> bulges(triangles_.size(), 0.0);
        if (elasticity_.localBulging > 0) {
            const std::vector<Vec3d> before = pointNormals(rest_, triangles_), after = pointNormals(posed_, triangles_);
            for (std::size_t i = 0; i < triangles_.size(); ++i) {
                const openvdb::Vec3I& t = triangles_[i];
                const auto spread = [&](const std::vector<Vec3d>& normals) {
                    const Vec3d &a = normals[t[0]], &b = normals[t[1]], &c = normals[t[2]];
                    return 2 * halfSolidAngle(a, b, c, a.dot(b.cross(c)));
                };
                const double change = spread(after) - spread(before);
                bulges[i] += elasticity_.localBulging * change / fourPi;
            }
        }
        const double scaled = volume * scale_ * scale_ * scale_;
        if (elasticity_.globalBulging > 0 && scaled > 0) {
            const std::vector<Vec3d> fitted = bestFit();
            for (std::size_t i = 0; i < triangles_.size(); ++i) {
                bulges[i] += elasticity_.globalBulging * swept(fitted, triangles_[i]) / scaled;
            }
        }
        constexpr double most = 3; // keeps a triangle that moved far from exploding
        for (double& bulge : bulges) bulge = std::clamp(bulge, -most, most);
        return bulges;
    }

    /// Returns the points at rest, scaled, turned and moved as near to the pose as possible.
    std::vector<Vec3d> bestFit() const
    {
        std::vector<Vec3d> fitted;
        for (const Vec3d& p : rest_) fitted.push_back(scale_ * (motion_.rotation * (p - motion_.from)) + motion_.to);
        return fitted;
    }

    /// Returns six times the volume that a triangle sweeps from `from` to the pose, outward.
    double swept(const std::vector<Vec3d>& from, const openvdb::Vec3I& t) const
    {
        // The flux is a polynomial of degree 2 in time: Simpson's rule is exact.
        const Vec3d motion = (posed_[t[0]] - from[t[0]]) + (posed_[t[1]] - from[t[1]]) + (posed_[t[2]] - from[t[2]]);
        const auto flux = [&](double time) {
            const auto side = [&](int k) { return (1 - time) * edge(from, t, k) + time * edge(posed_, t, k); };
            return motion.dot(side(1).cross(side(2)));
        };
        return (flux(0) + 4 * flux(0.5) + flux(1)) / 6;
    }

    /// Returns the traction of a linear material, over mu, for a stretch in the plane and one along the normal.
    double traction(double stretch, double bulge) const
    {
        const double along = stretch * std::exp(bulge);
        return 2 * (along + elasticity_.nu / (1 - 2 * elasticity_.nu) * (2 * stretch + along));
    }

    /// Changes the tractions by the least, in the sum of squares by area, so that together they are no force.
    void balance()
    {
        Mat3d normals = Mat3d::zero();
        Vec3d force(0);
        double area = 0;
        for (const Face& face : faces_) {
            const Vec3d& n = face.turned[0];
            force += face.area * face.traction * n;
            area += face.area;
            for (int r = 0; r < 3; ++r) normals.setRow(r, normals.row(r) + face.area * n[r] * n);
        }
        if (!(normals.det() > 1e-9 * area * area * area)) return; // all faces are nearly parallel
        const Vec3d excess = normals.inverse(0.0) * force;
        for (Face& face : faces_) face.traction -= face.turned[0].dot(excess);
    }

    std::vector<openvdb::Vec3I> triangles_;
    Elasticity elasticity_;
    double size_, scale_;
    std::vector<Vec3d> rest_, posed_;
    Motion motion_;
    std::vector<Face> faces_;
};

} // namespace

bool exactSomigliana(const UnitCage& cage, std::size_t face, const double (&x)[3], double (&positions)[3],
                     double (&matrix)[6])
{
    const Vec3d from(x);
    if (cage.nearestOf(face, from).distance < tooNear) return false;
    const PatchCorners c = cage.cornersFrom(cage.faces()[face], from);
    const FacePart part = facePart(c, faceFrame(c[1] - c[0], c[2] - c[0]), false);
    std::copy(part.positions.begin(), part.positions.end(), positions);
    std::copy(part.matrix.begin(), part.matrix.end(), matrix);
    return true;
}

namespace {

/// Writes the weights of the points, which are Green's, then for each triangle the integral of r r^T / |r|^3 over it,
/// over 4 pi, where r is the vector from `x`: the symmetric matrix in the triangle's frame, as nn, n1, n2, 11, 12, 22.
/// Returns false if `x` is outside of the cage. \pre the cage has triangles only
bool somiglianaRow(const UnitCage& cage, const Vec3d& x, double* row)
{
    const std::size_t count = cage.points().size();
    const UnitCage::Place nearest = cage.nearest(x);
    const bool touches = nearest.distance <= UnitCage::touching;
    std::fill(row, row + count, 0.0);
    double* const matrices = row + count;
    Vec3d missing = x;
    for (std::size_t i = 0; i < cage.faces().size(); ++i) {
        const UnitCage::Face& face = cage.faces()[i];
        const PatchCorners c = cage.cornersFrom(face, x);
        const FaceFrame frame = faceFrame(c[1] - c[0], c[2] - c[0]);
        const bool onFace = touches && cage.nearestOf(i, x).distance <= 2 * UnitCage::touching;
        const FacePart part = facePart(c, frame, onFace);
        for (std::size_t k = 0; k < 3; ++k) row[face.at[k]] += part.positions[k];
        const auto& m = part.matrix;
        std::copy(m.begin(), m.end(), matrices + somiglianaWeights * i);
        missing -= (m[0] + m[3] + m[5]) * frame[0];
    }
    return cage.completeSolidAngles(nearest, missing, row);
}

void addHandles(const Mesh& cage, const std::vector<Vec3d>& posed, const CoordinateOptions& options,
                std::vector<Vec3d>& handles)
{
    requireElasticity(options.elasticity);
    CagePose(cage, posed, options.elasticity).addHandles(handles);
}

/// Appends their distances: they are about as long at rest.
void addReach(const Mesh& cage, std::vector<float>& reach)
{
    reach.insert(reach.end(), somiglianaWeights * (cage.triangles.size() + 2 * cage.quads.size()), 4.0F);
}

constexpr FamilyInfo info{
    Coordinates::somigliana,       "somigliana", "somigliana", "Somigliana", "elastic: stretches most evenly",
    "Chen, de Goes, Desbrun 2023",
    /*isEverywhere*/ false,
    /*splitsQuads*/ true,
    /*hasResolution*/ false,
    /*hasElasticity*/ true};

} // namespace

extern constexpr CoordinateFamily somigliana{info,
                                             formulaRows<somiglianaRow>,
                                             &RowKernels::somigliana,
                                             {somiglianaWeights, 2 * somiglianaWeights, addHandles, addReach}};

} // namespace vdbcage::detail
