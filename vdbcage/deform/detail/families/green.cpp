// Based on: Lipman, Levin, Cohen-Or, "Green Coordinates", 2008; Thiery, Boubekeur, "Green Coordinates for Triquad Cages
// in 3D", 2022.
// Differs: the integrals over bilinear patches are integrated adaptively to a tolerance. All faces around a point
// inside cover the whole sphere; the difference of the computed solid angles from it (near edges rounding leaves 1e-16
// over the distance) belongs to the faces next to the point, so to the nearest place of the cage. This also defines
// points on the cage, as the limit from inside. Affine precision is restored at the end.

#include <algorithm>
#include <cmath>

#include <vdbcage/deform/detail/coordinate_family.h>
#include <vdbcage/deform/detail/families/patch_quadrature.h>
#include <vdbcage/deform/detail/stretched_normals.h>
#include <vdbcage/deform/detail/triangle_potentials.h>

namespace vdbcage::detail {

using openvdb::Vec3d;

namespace {

/// The weights of a face's corners and normals (a triangle has one).
struct FacePart {
    std::array<double, 4> positions{}, normals{};
};

FacePart integrated(const PatchCorners& corners)
{
    FacePart part;
    // The part left out next to the point counts only for the solid angle, which is completed at the nearest place.
    samplePatch(corners, 1e-10, [&](const PatchSample& sample) {
        const double square = sample.point.lengthSqr();
        const double inverse = 1 / (fourPi * std::sqrt(square));
        const double solid = sample.point.dot(sample.normal) / square * inverse;
        for (std::size_t i = 0; i < 4; ++i) {
            part.positions[i] += solid * sample.basis[i];
            part.normals[i] += sample.area * inverse * sample.basis[i];
        }
    });
    return part;
}

FacePart closedForm(const PatchCorners& c, bool onFace)
{
    const TrianglePotentials t = trianglePotentials({c[0], c[1], c[2]}, onFace);
    FacePart part;
    for (std::size_t i = 0; i < 3; ++i) part.positions[i] = t.hatSolid[i] / fourPi;
    part.normals[0] = t.single / (fourPi * t.area);
    return part;
}

FacePart facePart(const PatchCorners& corners, bool quad, bool onFace)
{
    if (quad) return integrated(corners);
    if (!isSliver(corners[1] - corners[0], corners[2] - corners[0])) return closedForm(corners, onFace);
    FacePart part = integrated(corners); // nearly degenerate
    part.positions[2] += part.positions[3];
    part.normals[0] += part.normals[1]; // the density of (u, v) on the triangle
    return part;
}

} // namespace

bool exactGreen(const UnitCage& cage, std::size_t face, const double (&x)[3], double (&positions)[3], double& normal)
{
    const Vec3d from(x);
    if (cage.nearestOf(face, from).distance < tooNear) return false;
    const FacePart part = facePart(cage.cornersFrom(cage.faces()[face], from), false, false);
    std::copy_n(part.positions.begin(), 3, positions);
    normal = part.normals[0];
    return true;
}

namespace {

/// Writes the points' weights, then one for each triangle, then four for each quad. Returns false if `x` is outside of
/// the cage.
bool greenRow(const UnitCage& cage, const Vec3d& x, double* row)
{
    const std::size_t count = cage.points().size();
    const UnitCage::Place nearest = cage.nearest(x);
    const bool touches = nearest.distance <= UnitCage::touching;
    std::fill(row, row + count, 0.0);
    Vec3d missing = x;
    double* normals = row + count;
    for (std::size_t i = 0; i < cage.faces().size(); ++i) {
        const UnitCage::Face& face = cage.faces()[i];
        const PatchCorners c = cage.cornersFrom(face, x);
        const bool onFace = touches && !face.quad && cage.nearestOf(i, x).distance <= 2 * UnitCage::touching;
        const FacePart part = facePart(c, face.quad, onFace);
        for (std::size_t k = 0; k < 4; ++k) row[face.at[k]] += part.positions[k];
        for (std::size_t k = 0; k < (face.quad ? 4 : 1); ++k) {
            const std::size_t next = (k + 1) % 4, before = (k + 3) % 4;
            *normals++ = part.normals[k];
            missing -= part.normals[k] * (c[next] - c[k]).cross(c[before] - c[k]);
        }
    }
    return cage.completeSolidAngles(nearest, missing, row);
}

std::vector<openvdb::Vec3I> cornersOf(const Mesh& cage)
{
    std::vector<openvdb::Vec3I> corners = cage.triangles;
    for (const openvdb::Vec4I& q : cage.quads) {
        for (int k = 0; k < 4; ++k) corners.emplace_back(q[k], q[(k + 1) % 4], q[(k + 3) % 4]);
    }
    return corners;
}

constexpr FamilyInfo info{Coordinates::green,
                          "green",
                          "qgc",
                          "Green",
                          "keeps shapes, follows the faces' normals",
                          "Lipman, Levin, Cohen-Or 2008; Thiery, Boubekeur 2022",
                          /*isEverywhere*/ false,
                          /*splitsQuads*/ false,
                          /*hasResolution*/ false,
                          /*hasElasticity*/ false};

} // namespace

extern constexpr CoordinateFamily green{info, formulaRows<greenRow>, &RowKernels::green,
                                        stretchedNormals<cornersOf>(1, 4)};

} // namespace vdbcage::detail
