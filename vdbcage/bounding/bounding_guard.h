#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <vector>

#include <vdbcage/core/export.h>
#include <vdbcage/core/interrupter.h>
#include <vdbcage/core/precision.h>
#include <vdbcage/core/range.h>
#include <vdbcage/mesh/mesh.h>
#include <vdbcage/mesh/symmetry.h>

namespace vdbcage {

class BoundingGuard;

namespace detail {
class GuardModel;
const GuardModel& modelOf(const BoundingGuard& guard);
} // namespace detail

/// Names what a BoundingGuard keeps.
struct GuardOptions {
    static constexpr Range clearances{1e-7, 0.1}; ///< of `clearance`
    static constexpr Range minAngles{0, 30};      ///< of `minAngleDegrees`
    static constexpr Range spacings{1e-4, 0.01};  ///< of `spacing`

    /// Least distance from model to surface, fraction of the model's longest side. Where points are rounded to float,
    /// at least four times the rounding of the largest coordinate. Models of a quarter of a million quads and more may
    /// get up to a quarter more, in less time.
    double clearance = 3e-5;
    double minAngleDegrees = 6; ///< no move makes a triangle angle smaller than this (or than it was)
    /// Least distance between triangles of a surface without a common corner, fraction of the model's longest side. The
    /// default is wide enough for every mesh generator; TetGen fills cages of sheets down to an eighth of it, too.
    double spacing = 0.002;
    Precision precision = Precision::automatic; ///< of the surface's coordinates; moves are decided as rounded
    /// If set, surfaces are exactly symmetric in it and stay so, and bound the model and its mirror image.
    std::optional<SymmetryPlane> symmetry = {};

    /// Whether all are equal.
    bool operator==(const GuardOptions& other) const
    {
        return clearance == other.clearance && minAngleDegrees == other.minAngleDegrees && spacing == other.spacing &&
               precision == other.precision && symmetry == other.symmetry;
    }
};

/// Keeps a surface bounding while it is changed. Built once from a model, any polygon soup. It lets smooth, decimate,
/// tighten and triquad replace one star of triangles by another only if the new one
/// - keeps its clearance to every face of the model,
/// - keeps off the rest of the surface: triangles without a common corner by the spacing, 0.002 of the model's longest
///   side, or a twentieth of their longest edge (the smaller triangle's) if that is less, others by an angle of one
///   degree; with less spacing these two are less in proportion,
/// - sweeps, together with the old one, over no part of the model,
/// - has no degenerate triangle and none with a smaller angle than allowed.
///
/// So a surface that bounds the model with that clearance at the start does at the end. Where it comes nearer to itself
/// than that, only what leads out of it is allowed.
///
/// All is decided on the coordinates as they will be written: points are rounded to float as GuardOptions::precision
/// says. Distances are decided up to a few units of 2^-52 of the sizes involved, far below any clearance.
///
/// With a plane of symmetry coordinates across it are rounded to multiples of one number, fine enough for the largest
/// of them. So the mirror image of every point is exact. The operators then take only surfaces that are exactly
/// symmetric, with no face across the plane. They work on one half of them, in half of the time.
///
/// Immutable; any number of threads may use one at the same time.
/// Cost: building is O(n log n) for n faces of the model.
class VDBCAGE_API BoundingGuard {
public:
    /// Examines the model; it need not outlive the guard.
    /// \throw InputError an unusable model; options out of range; float32 is asked for and rounds by more than a
    /// thousandth of the longest side
    /// \throw Cancelled
    explicit BoundingGuard(const Mesh& model, const GuardOptions& options = {}, Interrupter* interrupter = nullptr);
    ~BoundingGuard();
    /// The other can only be assigned to or destroyed afterwards.
    BoundingGuard(BoundingGuard&&) noexcept;
    /// The other can only be assigned to or destroyed afterwards.
    BoundingGuard& operator=(BoundingGuard&&) noexcept;

    /// The least distance kept, in world units.
    double clearance() const;
    /// The faces of `surface` that do not keep the clearance (quads: under both diagonals), ascending; quads are
    /// counted on from the triangles. In parallel.
    std::vector<std::size_t> facesTooNear(const Mesh& surface) const;

    /// The plane of symmetry, if one was asked for: moved by less than the rounding of coordinates.
    std::optional<SymmetryPlane> symmetry() const;
    /// The part of a closed surface on the side of the plane of symmetry where coordinates are larger, with its mirror
    /// image. Rounded, exactly symmetric.
    ///
    /// Faces across the plane are cut off there: corners that lie behind it, or before it by at most `snap` (world
    /// units), are moved onto it. Of quads made by extractSurface from voxels that are symmetric in the plane the
    /// result is closed and 2-manifold; `snap` is then a quarter of a voxel.
    /// \pre there is a plane of symmetry
    Mesh symmetrized(const Mesh& surface, double snap) const;

private:
    friend const detail::GuardModel& detail::modelOf(const BoundingGuard& guard);

    std::unique_ptr<const detail::GuardModel> model_;
};

} // namespace vdbcage
