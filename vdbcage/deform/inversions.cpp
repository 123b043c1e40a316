// A surface alone does not determine which side was inside, and where it folds, the wrong fold depends on the point of
// view. The sign of the Jacobian of the deformation determines both. Here it has the posed triangle as two of its
// columns, so that folds finer than the deformation's own count, too.

#include <vdbcage/deform/inversions.h>

#include <algorithm>
#include <utility>

#include <vdbcage/core/detail/longest_side.h>
#include <vdbcage/core/error.h>

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

/// Binds two points of each triangle in turn: its middle and one below.
Binding bindBeside(const Binding& binding, const Mesh& model, const std::vector<openvdb::Vec3I>& triangles,
                   const std::vector<std::uint32_t>& piece, Interrupter* interrupter)
{
    const double depth = below * detail::longestSide(boundingBox(model));
    std::vector<Vec3d> points;
    for (const std::uint32_t index : piece) {
        const openvdb::Vec3I& t = triangles[index];
        const Vec3d normal = areaNormal(model.points, t);
        points.push_back((model.points[t[0]] + model.points[t[1]] + model.points[t[2]]) / 3);
        points.push_back(points.back() - depth / normal.length() * normal);
    }
    CoordinateOptions options = binding.options();
    options.loose = {}; // of other points
    try {
        return Binding(binding.cage(), std::move(points), options, interrupter);
    } catch (const InputError& error) {
        throw InputError("inversions", "two points are looked at for each triangle; " + std::string(error.what()));
    }
}

/// Some of the triangles, in the order of their indices, and the points bound beside them.
struct Piece {
    std::vector<std::uint32_t> indices;
    Binding beside;

    /// Adds the triangles that the pose `cagePoints`, which moves the model's points to `posed`, inverts.
    void addInverted(const std::vector<openvdb::Vec3I>& triangles, const std::vector<Vec3d>& cagePoints,
                     const std::vector<Vec3d>& posed, std::vector<std::uint32_t>& inverted) const
    {
        const std::vector<Vec3d> posedBeside = beside.pose(cagePoints);
        for (std::size_t i = 0; i < indices.size(); ++i) {
            const Vec3d down = posedBeside[2 * i + 1] - posedBeside[2 * i];
            if (!(areaNormal(posed, triangles[indices[i]]).dot(down) < 0)) inverted.push_back(indices[i]);
        }
    }
};

/// \throw InputError
void requirePair(const Binding& binding, const Mesh& model)
{
    if (binding.family() == Coordinates::given) {
        throw InputError("inversions", "the binding's weights were made elsewhere; two points are looked at for each "
                                       "triangle, which needs coordinates that can be computed at other points");
    }
    requireUsable(model, "model");
    if (model.points.size() != binding.points().size()) {
        throw InputError("model", "it has " + std::to_string(model.points.size()) + " points; the binding has " +
                                      std::to_string(binding.points().size()));
    }
}

/// Calls `take` for the triangles that have a side, piece by piece.
template <typename Take>
void forEachPiece(const Binding& binding, const Mesh& model, const std::vector<openvdb::Vec3I>& triangles,
                  Interrupter* interrupter, const Take& take)
{
    const double thin = thinnest * detail::longestSide(boundingBox(binding.cage()));
    for (std::size_t next = 0; next < triangles.size();) {
        std::vector<std::uint32_t> indices;
        for (; next < triangles.size() && indices.size() < pieceSize; ++next) {
            const openvdb::Vec3I& t = triangles[next];
            if (areaNormal(model.points, t).length() > thin * longestEdge(model.points, t)) {
                indices.push_back(static_cast<std::uint32_t>(next));
            }
        }
        Binding beside = bindBeside(binding, model, triangles, indices, interrupter);
        take(Piece{std::move(indices), std::move(beside)});
    }
}

} // namespace

std::vector<std::vector<std::uint32_t>> invertedTriangles(const Binding& binding, const Mesh& model,
                                                          const std::vector<std::vector<Vec3d>>& poses,
                                                          Interrupter* interrupter)
{
    requirePair(binding, model);
    const std::vector<openvdb::Vec3I> triangles = triangulate(model);
    std::vector<std::vector<std::uint32_t>> inverted(poses.size());
    forEachPiece(binding, model, triangles, interrupter, [&](const Piece& piece) {
        for (std::size_t pose = 0; pose < poses.size(); ++pose) {
            throwIfInterrupted(interrupter);
            piece.addInverted(triangles, poses[pose], binding.pose(poses[pose]), inverted[pose]);
        }
    });
    return inverted;
}

struct InversionTest::Bound {
    Binding binding;
    std::vector<openvdb::Vec3I> triangles;
    std::vector<Piece> pieces;
};

InversionTest::InversionTest(const Binding& binding, const Mesh& model, Interrupter* interrupter)
{
    requirePair(binding, model);
    Bound bound{binding, triangulate(model), {}};
    forEachPiece(binding, model, bound.triangles, interrupter,
                 [&](Piece&& piece) { bound.pieces.push_back(std::move(piece)); });
    bound_ = std::make_shared<const Bound>(std::move(bound));
}

InversionTest InversionTest::with(const Elasticity& elasticity) const
{
    InversionTest changed = *this;
    requireElasticity(elasticity);
    const CoordinateOptions& options = bound_->binding.options();
    if (!familyInfo(options.family).hasElasticity || options.elasticity == elasticity) return changed;
    Bound bound{bound_->binding.with(elasticity), bound_->triangles, {}};
    for (const Piece& piece : bound_->pieces) bound.pieces.push_back({piece.indices, piece.beside.with(elasticity)});
    changed.bound_ = std::make_shared<const Bound>(std::move(bound));
    return changed;
}

std::vector<std::uint32_t> InversionTest::inverted(const std::vector<Vec3d>& cagePoints) const
{
    const std::vector<Vec3d> posed = bound_->binding.pose(cagePoints);
    std::vector<std::uint32_t> inverted;
    for (const Piece& piece : bound_->pieces) piece.addInverted(bound_->triangles, cagePoints, posed, inverted);
    return inverted;
}

} // namespace vdbcage
