// A surface alone does not tell which side of it was inside, and where it folds it depends on the eye which fold is the
// wrong one. The sign of the Jacobian of the deformation does; here it is taken with the posed triangle as two of its
// columns, so that folds finer than the deformation's own count too.

#include <vdbcage/deform/inversions.h>

#include <algorithm>

#include <vdbcage/core/error.h>
#include <vdbcage/deform/detail/bound_cage.h>

namespace vdbcage {

using openvdb::Vec3d;

namespace {

constexpr double below = 1e-4;
constexpr double thinnest = 1e-6;
constexpr std::size_t pieceSize = 1 << 15; // triangles whose weights are in memory together

Vec3d areaNormal(const std::vector<Vec3d>& points, const openvdb::Vec3I& t)
{
    return (points[t[1]] - points[t[0]]).cross(points[t[2]] - points[t[0]]);
}

double longestEdge(const std::vector<Vec3d>& points, const openvdb::Vec3I& t)
{
    return std::max({(points[t[1]] - points[t[0]]).length(), (points[t[2]] - points[t[1]]).length(),
                     (points[t[0]] - points[t[2]]).length()});
}

/// Two points of each triangle in turn: its middle and one below.
Binding bindBeside(const Binding& binding, const Mesh& model, const std::vector<openvdb::Vec3I>& triangles,
                   const std::vector<std::uint32_t>& piece, Interrupter* interrupter)
{
    const double depth = below * detail::CageFrame(model).size;
    std::vector<Vec3d> points;
    for (const std::uint32_t index : piece) {
        const openvdb::Vec3I& t = triangles[index];
        const Vec3d normal = areaNormal(model.points, t);
        points.push_back((model.points[t[0]] + model.points[t[1]] + model.points[t[2]]) / 3);
        points.push_back(points.back() - depth / normal.length() * normal);
    }
    try {
        return Binding(binding.cage(), std::move(points), binding.family(), interrupter);
    } catch (const InputError& error) {
        throw InputError("inversions: two points are looked at for each triangle; " + std::string(error.what()));
    }
}

} // namespace

std::vector<std::vector<std::uint32_t>> invertedTriangles(const Binding& binding, const Mesh& model,
                                                          const std::vector<std::vector<Vec3d>>& poses,
                                                          Interrupter* interrupter)
{
    requireUsable(model, "model");
    if (model.points.size() != binding.points().size()) {
        throw InputError("model: it has " + std::to_string(model.points.size()) + " points; the binding has " +
                         std::to_string(binding.points().size()));
    }
    const std::vector<openvdb::Vec3I> triangles = triangulate(model);
    const double thin = thinnest * detail::CageFrame(binding.cage()).size;
    std::vector<std::vector<std::uint32_t>> inverted(poses.size());
    std::vector<std::uint32_t> piece;
    for (std::size_t next = 0; next < triangles.size();) {
        piece.clear();
        for (; next < triangles.size() && piece.size() < pieceSize; ++next) {
            const openvdb::Vec3I& t = triangles[next];
            if (areaNormal(model.points, t).length() > thin * longestEdge(model.points, t)) {
                piece.push_back(static_cast<std::uint32_t>(next));
            }
        }
        const Binding beside = bindBeside(binding, model, triangles, piece, interrupter);
        for (std::size_t pose = 0; pose < poses.size(); ++pose) {
            throwIfInterrupted(interrupter);
            const std::vector<Vec3d> posed = binding.pose(poses[pose]), posedBeside = beside.pose(poses[pose]);
            for (std::size_t i = 0; i < piece.size(); ++i) {
                const Vec3d down = posedBeside[2 * i + 1] - posedBeside[2 * i];
                if (!(areaNormal(posed, triangles[piece[i]]).dot(down) < 0)) inverted[pose].push_back(piece[i]);
            }
        }
    }
    return inverted;
}

} // namespace vdbcage
