#include <vdbcage/deform/detail/unit_cage.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include <openvdb/math/Mat3.h>
#include <vdbcage/core/detail/longest_side.h>
#include <vdbcage/core/error.h>
#include <vdbcage/mesh/topology.h>

namespace vdbcage::detail {

using openvdb::Vec3d;

namespace {

struct Weights {
    std::array<double, 4> at{};
    double distance = std::numeric_limits<double>::infinity();
};

Vec3d blend(const PatchCorners& corners, const std::array<double, 4>& weights)
{
    Vec3d sum(0);
    for (std::size_t i = 0; i < 4; ++i) sum += weights[i] * corners[i];
    return sum;
}

std::array<double, 4> bilinear(double u, double v)
{
    return {(1 - u) * (1 - v), u * (1 - v), u * v, (1 - u) * v};
}

void consider(const PatchCorners& corners, const std::array<double, 4>& weights, Weights& best)
{
    const double distance = blend(corners, weights).length();
    if (distance < best.distance) best = {weights, distance};
}

/// Tries the point of an edge that is nearest to the origin.
void considerEdge(const PatchCorners& corners, std::size_t i, std::size_t j, Weights& best)
{
    const Vec3d edge = corners[j] - corners[i];
    const double square = edge.lengthSqr();
    const double t = square > 0 ? std::clamp(-corners[i].dot(edge) / square, 0.0, 1.0) : 0;
    std::array<double, 4> weights{};
    weights[i] = 1 - t;
    weights[j] = t;
    consider(corners, weights, best);
}

void considerInsideTriangle(const PatchCorners& c, Weights& best)
{
    const Vec3d normal = (c[1] - c[0]).cross(c[2] - c[0]);
    const double square = normal.lengthSqr();
    if (!(square > 0)) return;
    const double w0 = normal.dot(c[1].cross(c[2])) / square, w1 = normal.dot(c[2].cross(c[0])) / square;
    if (w0 > 0 && w1 > 0 && w0 + w1 < 1) consider(c, {w0, w1, 1 - w0 - w1, 0}, best);
}

/// Runs Newton's method from the best of a few places.
void considerInsidePatch(const PatchCorners& c, Weights& best)
{
    double u = 0.5, v = 0.5, least = std::numeric_limits<double>::infinity();
    for (int i = 1; i <= 7; i += 2) {
        for (int j = 1; j <= 7; j += 2) {
            const double square = blend(c, bilinear(i / 8.0, j / 8.0)).lengthSqr();
            if (square < least) {
                least = square;
                u = i / 8.0;
                v = j / 8.0;
            }
        }
    }
    const Vec3d twist = c[0] - c[1] + c[2] - c[3];
    for (int step = 0; step < 30; ++step) {
        const Vec3d p = blend(c, bilinear(u, v));
        const Vec3d pu = (c[1] - c[0]) + v * twist, pv = (c[3] - c[0]) + u * twist;
        const double gu = p.dot(pu), gv = p.dot(pv);
        const double huu = pu.lengthSqr(), hvv = pv.lengthSqr();
        double huv = pu.dot(pv) + p.dot(twist);
        if (!(huu * hvv > huv * huv)) huv = pu.dot(pv); // not convex here: Gauss-Newton
        const double determinant = huu * hvv - huv * huv;
        if (!(determinant > 0)) break;
        const double du = (huv * gv - hvv * gu) / determinant, dv = (huv * gu - huu * gv) / determinant;
        u = std::clamp(u + du, 0.0, 1.0);
        v = std::clamp(v + dv, 0.0, 1.0);
        if (std::abs(du) + std::abs(dv) < 1e-15) break;
    }
    consider(c, bilinear(u, v), best);
}

Weights nearestToOrigin(const PatchCorners& corners, bool quad)
{
    Weights best;
    if (quad) {
        for (std::size_t i = 0; i < 4; ++i) considerEdge(corners, i, (i + 1) % 4, best);
        considerInsidePatch(corners, best);
    } else {
        for (std::size_t i = 0; i < 3; ++i) considerEdge(corners, i, (i + 1) % 3, best);
        considerInsideTriangle(corners, best);
    }
    return best;
}

void requireClosed(const Mesh& cage)
{
    const MeshTopology topology = analyzeTopology(cage);
    if (topology.isCycle()) return;
    throw InputError("cage", "it is not closed and oriented (" + std::to_string(topology.boundaryEdges) +
                                 " boundary edges, " + std::to_string(topology.misorientedEdges) +
                                 " edges whose faces disagree); vdbcage repair may help");
}

} // namespace

UnitCage::UnitCage(const Mesh& cage)
{
    requireUsable(cage, "cage");
    requireClosed(cage);
    const openvdb::BBoxd box = boundingBox(cage);
    centre_ = 0.5 * box.min() + 0.5 * box.max();
    size_ = longestSide(box);
    for (const openvdb::Vec3I& t : cage.triangles) faces_.push_back({{t[0], t[1], t[2], t[2]}, false});
    for (const openvdb::Vec4I& q : cage.quads) faces_.push_back({{q[0], q[1], q[2], q[3]}, true});

    std::vector<bool> used(cage.points.size());
    double volume = 0; // six times the volume; a bilinear patch has the mean of its two splits
    points_.resize(cage.points.size(), Vec3d(0));
    for (const Face& face : faces_) {
        for (const openvdb::Index32 i : face.at) {
            used[i] = true;
            points_[i] = scaled(cage.points[i]);
        }
    }
    for (const Face& face : faces_) {
        const PatchCorners c = cornersFrom(face, Vec3d(0));
        volume += 0.5 * (c[0].dot(c[1].cross(c[2])) + c[0].dot(c[2].cross(c[3])) + c[0].dot(c[1].cross(c[3])) +
                         c[1].dot(c[2].cross(c[3])));
    }
    if (volume < 0) throw InputError("cage", "it faces inward; turn its faces around");

    Vec3d mean(0);
    const auto count = static_cast<double>(std::count(used.begin(), used.end(), true));
    for (const Vec3d& p : points_) mean += p / count;
    openvdb::Mat3d spread = openvdb::Mat3d::zero();
    for (std::size_t i = 0; i < points_.size(); ++i) {
        if (!used[i]) continue;
        const Vec3d d = points_[i] - mean;
        for (int r = 0; r < 3; ++r) {
            for (int c = 0; c < 3; ++c) spread(r, c) += d[r] * d[c];
        }
    }
    if (!(volume > 1e-14) || !(spread.det() > 1e-24)) {
        throw InputError("cage", "it is flat; it must have a volume to deform what is in it");
    }
    const openvdb::Mat3d inverse = spread.inverse(0.0);
    restoring_.assign(points_.size(), Vec3d(0));
    for (std::size_t i = 0; i < points_.size(); ++i) {
        if (used[i]) restoring_[i] = inverse * (points_[i] - mean);
    }
}

PatchCorners UnitCage::cornersFrom(const Face& face, const Vec3d& x) const
{
    return {points_[face.at[0]] - x, points_[face.at[1]] - x, points_[face.at[2]] - x, points_[face.at[3]] - x};
}

UnitCage::Place UnitCage::nearestOf(std::size_t face, const Vec3d& x) const
{
    const Weights weights = nearestToOrigin(cornersFrom(faces_[face], x), faces_[face].quad);
    return {face, weights.at, weights.distance};
}

UnitCage::Place UnitCage::nearest(const Vec3d& x) const
{
    Place best;
    best.distance = std::numeric_limits<double>::infinity();
    for (std::size_t face = 0; face < faces_.size(); ++face) {
        const PatchCorners c = cornersFrom(faces_[face], x);
        const Vec3d middle = 0.25 * (c[0] + c[1] + c[2] + c[3]);
        double squaredRadius = 0;
        for (const Vec3d& corner : c) squaredRadius = std::max(squaredRadius, (corner - middle).lengthSqr());
        const double sum = best.distance + std::sqrt(squaredRadius);
        if (middle.lengthSqr() >= sum * sum) continue; // its sphere is farther away
        const Place place = nearestOf(face, x);
        if (place.distance < best.distance) best = place;
    }
    return best;
}

bool UnitCage::completeSolidAngles(const Place& nearest, Vec3d missing, double* weights) const
{
    double lacking = 1;
    for (std::size_t i = 0; i < points_.size(); ++i) lacking -= weights[i];
    if (nearest.distance > touching && std::abs(lacking) > 0.5) return false;
    for (std::size_t k = 0; k < 4; ++k) weights[faces_[nearest.face].at[k]] += lacking * nearest.weights[k];
    for (std::size_t i = 0; i < points_.size(); ++i) missing -= weights[i] * points_[i];
    restore(missing, weights);
    return true;
}

void UnitCage::restore(const Vec3d& missing, double* weights) const
{
    for (std::size_t i = 0; i < restoring_.size(); ++i) weights[i] += restoring_[i].dot(missing);
}

} // namespace vdbcage::detail
