// Based on: Cohen-Steiner and Morvan, "Restricted Delaunay Triangulations and Normal Cycle", 2003 (curvature tensors
// from dihedral angles, for the directions that quads follow).

#include <vdbcage/bounding/detail/quads/pairing/quad_candidates.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <tuple>

#include <openvdb/math/Mat3.h>
#include <vdbcage/bounding/detail/guard/face_queries.h>
#include <vdbcage/geometry/quad_shape.h>

namespace vdbcage::detail {

namespace {

using openvdb::Mat3d;

/// Adds the curvature of an edge between faces with the normals m and n: its direction squared, by its length and
/// angle.
void addBend(Mat3d& tensor, const Vec3d& edge, const Vec3d& m, const Vec3d& n)
{
    const double length = edge.length();
    if (!(length > 0)) return;
    const double bend = std::atan2(m.cross(n).dot(edge) / length, m.dot(n)) / length;
    for (int k = 0; k < 3; ++k) {
        for (int l = 0; l < 3; ++l) tensor[k][l] += bend * edge[k] * edge[l];
    }
}

/// Adds the other half: the mirror image of the edges off the plane; the halves meet in edges on it.
void addOtherHalf(Mat3d& tensor, const GuardedMesh& surface, std::uint32_t v)
{
    const int across = surface.guard().symmetry()->axis;
    for (int k = 0; k < 3; ++k) {
        for (int l = 0; l < 3; ++l) tensor[k][l] *= (k == across) == (l == across) ? 2 : 0;
    }
    for (const std::uint32_t f : surface.facesOf(v)) {
        const Vec3I& t = surface.face(f);
        for (int i = 0; i < 3; ++i) {
            const std::uint32_t a = t[i], b = t[(i + 1) % 3];
            if ((a != v && b != v) || !surface.isOnPlane(a) || !surface.isOnPlane(b)) continue;
            const Vec3d normal = areaNormal(surface, f);
            Vec3d image = normal;
            image[across] = -image[across];
            addBend(tensor, surface.point(b) - surface.point(a), normal, image);
        }
    }
}

/// Returns the curvature of the surface around a vertex.
Mat3d curvatureTensor(const GuardedMesh& surface, std::uint32_t v)
{
    Mat3d tensor = Mat3d::zero();
    for (const std::uint32_t f : surface.facesOf(v)) {
        for (const std::uint32_t g : surface.facesOf(v)) {
            if (g <= f) continue;
            const Vec3I& t = surface.face(f);
            for (int i = 0; i < 3; ++i) {
                const std::uint32_t a = t[i], b = t[(i + 1) % 3];
                if (sideOf(surface, g, b, a) < 0) continue;
                addBend(tensor, surface.point(b) - surface.point(a), areaNormal(surface, f), areaNormal(surface, g));
            }
        }
    }
    if (surface.isOnPlane(v)) addOtherHalf(tensor, surface, v);
    return tensor;
}

/// Returns how far a quad's sides are from the directions of curvature: 0 if along them or if there are none, up to 1.
double misalignment(const std::array<Vec3d, 4>& corners, const Mat3d& tensor)
{
    Vec3d x = corners[2] - corners[0];
    Vec3d normal = x.cross(corners[3] - corners[1]);
    if (!normal.normalize(0) || !x.normalize(0)) return 0;
    const Vec3d y = normal.cross(x);
    const double xx = x.dot(tensor * x), xy = x.dot(tensor * y), yy = y.dot(tensor * y);
    const double spread = std::hypot(xx - yy, 2 * xy), sum = std::abs(xx + yy);
    if (!(spread > 0)) return 0;
    const double direction = 0.5 * std::atan2(2 * xy, xx - yy);
    double misaligned = 0, lengths = 0;
    for (std::size_t i = 0; i < 4; ++i) {
        const Vec3d side = corners[(i + 1) % 4] - corners[i];
        const double length = side.length();
        const double sine = std::sin(2 * (std::atan2(side.dot(y), side.dot(x)) - direction));
        misaligned += length * sine * sine;
        lengths += length;
    }
    return misaligned / lengths * spread / std::max(spread, sum);
}

double volumeBetweenDiagonals(const std::array<Vec3d, 4>& corners)
{
    const Vec3d both = (corners[2] - corners[0]).cross(corners[3] - corners[1]);
    return std::abs(both.dot(corners[0] - corners[1])) / 6;
}

} // namespace

std::optional<double> shapeError(const GuardedMesh& surface, std::uint32_t f, std::uint32_t g, double mergeAngleDegrees)
{
    constexpr double mostFlattened = 2.5; // times the angle that a quad may have; vertices are pushed that far
    const double angle = angleDegrees(areaNormal(surface, f), areaNormal(surface, g));
    if (!(angle <= mostFlattened * mergeAngleDegrees)) return std::nullopt;
    double deviation;
    if (!isConvexQuad(pointsOf(surface, surface.quadOf(f, g)), 0, deviation)) return std::nullopt;
    return angle + deviation;
}

std::vector<QuadCandidate> quadCandidates(const GuardedMesh& surface, double mergeAngleDegrees, double distancePerFace)
{
    constexpr double alignmentDegrees = 45, lossDegrees = 30;
    std::vector<Mat3d> tensors(surface.vertices());
    for (std::uint32_t v = 0; v < surface.vertices(); ++v) tensors[v] = curvatureTensor(surface, v);
    std::vector<QuadCandidate> candidates;
    for (const std::uint32_t f : trianglesOf(surface)) {
        for (int i = 0; i < 3; ++i) {
            const std::uint32_t g = faceAcross(surface, f, i);
            if (f >= g || surface.isInQuad(g)) continue;
            const std::optional<double> error = shapeError(surface, f, g, mergeAngleDegrees);
            if (!error) continue;
            const Vec4I ids = surface.quadOf(f, g);
            const auto corners = pointsOf(surface, ids);
            const Mat3d tensor = tensors[ids[0]] + tensors[ids[1]] + tensors[ids[2]] + tensors[ids[3]];
            const double loss = volumeBetweenDiagonals(corners) / distancePerFace;
            const double score = *error + alignmentDegrees * misalignment(corners, tensor) + lossDegrees * loss;
            candidates.push_back({score, loss, f, g});
        }
    }
    std::sort(candidates.begin(), candidates.end(), [](const QuadCandidate& a, const QuadCandidate& b) {
        return std::tie(a.score, a.f, a.g) < std::tie(b.score, b.f, b.g);
    });
    return candidates;
}

} // namespace vdbcage::detail
