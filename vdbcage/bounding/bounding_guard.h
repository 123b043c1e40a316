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

/// The constraints that a BoundingGuard keeps.
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

    /// Returns whether all are equal.
    bool operator==(const GuardOptions& other) const
    {
        return clearance == other.clearance && minAngleDegrees == other.minAngleDegrees && spacing == other.spacing &&
               precision == other.precision && symmetry == other.symmetry;
    }
};

/// A guard of one model: the operators change a surface under it, and a surface that bounds the model with the
/// clearance at the start does at the end. \ref bounding describes the changes that it allows.
///
/// Immutable; any number of threads may use one at the same time.
class VDBCAGE_API BoundingGuard {
public:
    /// Examines a model.
    /// \param model any polygon soup with a usable face; it need not outlive the guard
    /// \param options in the ranges of their members
    /// \param interrupter asked whether to stop; may be null
    /// \throw InputError when the model is unusable; when options are out of range; when float32 is asked for and
    /// rounds by more than a thousandth of the longest side
    /// \throw Cancelled when asked to stop
    /// Cost: O(n log n) for n faces of the model.
    explicit BoundingGuard(const Mesh& model, const GuardOptions& options = {}, Interrupter* interrupter = nullptr);
    ~BoundingGuard();
    /// Takes over another guard, which can only be assigned to or destroyed afterwards.
    BoundingGuard(BoundingGuard&&) noexcept;
    /// Takes over another guard, which can only be assigned to or destroyed afterwards.
    BoundingGuard& operator=(BoundingGuard&&) noexcept;

    /// Returns the least distance that is kept, in world units.
    double clearance() const;
    /// Returns the faces of a surface that do not keep the clearance, ascending. Works in parallel.
    /// \param surface any mesh; its quads count under both diagonals, and are numbered on from its triangles
    std::vector<std::size_t> facesTooNear(const Mesh& surface) const;

    /// Returns the plane of symmetry, if one was asked for: moved by less than the rounding of coordinates.
    std::optional<SymmetryPlane> symmetry() const;
    /// Returns the part of a surface on the side of the plane of symmetry where coordinates are larger, with its mirror
    /// image. It is rounded and exactly symmetric. Faces across the plane are cut off there. From quads that
    /// extractSurface() made of voxels that are symmetric in the plane, and with a quarter of a voxel for `snap`, the
    /// result is closed and 2-manifold.
    /// \param surface closed
    /// \param snap world units; corners behind the plane, or before it by at most this, are moved onto it
    /// \pre there is a plane of symmetry
    Mesh symmetrized(const Mesh& surface, double snap) const;

private:
    friend const detail::GuardModel& detail::modelOf(const BoundingGuard& guard);

    std::unique_ptr<const detail::GuardModel> model_;
};

} // namespace vdbcage
