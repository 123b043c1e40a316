#include <vdbcage/deform/distortion.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include <vdbcage/core/error.h>
#include <vdbcage/deform/detail/triangles.h>
#include <vdbcage/mesh/topology.h>

namespace vdbcage {

using openvdb::Vec3d;

namespace {

/// Returns the energy of a triangle with sides `a` and `b` that are posed at `posedA` and `posedB`; `area` is twice its
/// area.
double energyOf(const Vec3d& a, const Vec3d& b, double area, const Vec3d& posedA, const Vec3d& posedB)
{
    // The squares of the principal stretches are the eigenvalues of the metric; the energy needs only their sum and
    // product. The sum is over the dual basis of the sides.
    const double aa = a.dot(a), ab = a.dot(b), bb = b.dot(b);
    const double sum =
        (posedA.dot(posedA) * bb - 2 * posedA.dot(posedB) * ab + posedB.dot(posedB) * aa) / (area * area);
    const double product = posedA.cross(posedB).lengthSqr() / (area * area);
    return product > 0 ? 0.25 * (sum + sum / product) : std::numeric_limits<double>::infinity();
}

} // namespace

Distortion poseDistortion(const Mesh& model, const std::vector<Vec3d>& posed)
{
    requireUsable(model, "model");
    if (posed.size() != model.points.size()) {
        throw InputError("posed points", "there are " + std::to_string(posed.size()) + "; the model has " +
                                             std::to_string(model.points.size()));
    }
    for (std::size_t i = 0; i < posed.size(); ++i) {
        if (!posed[i].isFinite()) throw InputError("posed points", "point " + std::to_string(i) + " is not finite");
    }
    const std::vector<openvdb::Vec3I> triangles = triangulate(model);
    std::vector<std::pair<double, double>> energies; // and areas
    double whole = 0;
    for (const openvdb::Vec3I& t : triangles) {
        const Vec3d a = model.points[t[1]] - model.points[t[0]], b = model.points[t[2]] - model.points[t[0]];
        const double area = a.cross(b).length();
        const Vec3d posedA = posed[t[1]] - posed[t[0]], posedB = posed[t[2]] - posed[t[0]];
        const double energy = energyOf(a, b, area, posedA, posedB);
        if (!(area > 0) || std::isnan(energy)) continue;
        energies.emplace_back(energy, area);
        whole += area;
    }
    if (!(whole > 0)) throw InputError("model", "its faces have no area");
    std::sort(energies.begin(), energies.end());
    Distortion distortion;
    distortion.mean = 0;
    double below = 0;
    for (const auto& [energy, area] : energies) {
        distortion.mean += energy * (area / whole);
        if (below < 0.99 * whole) distortion.percentile99 = energy;
        below += area;
    }
    const double volume = detail::sixfoldVolume(model.points, triangles);
    if (analyzeTopology(model).isCycle() && volume > 0) {
        distortion.volume = detail::sixfoldVolume(posed, triangles) / volume;
    }
    return distortion;
}

} // namespace vdbcage
