#pragma once

#include <memory>

#include <vdbcage/core/export.h>
#include <vdbcage/core/interrupter.h>
#include <vdbcage/mesh/mesh.h>

namespace vdbcage {

namespace detail {
class GuardModel;
}

struct GuardOptions {
    /// Least distance from model to surface, fraction of the model's longest side, 1e-7 to 0.1. Where float holds the
    /// model, at least four times the rounding of its largest coordinate.
    double clearance = 1e-6;
    double minAngleDegrees = 6; ///< no move makes a triangle angle smaller than this (or than it was), 0 to 30
};

/// Keeps a surface bounding while it is changed: built once from a model (any polygon soup), it lets smooth, decimate
/// and tighten replace one star of triangles by another only if the new one
/// - keeps its clearance to every face of the model,
/// - touches the rest of the surface in nothing but the vertices and edges they share,
/// - sweeps, together with the old one, over no part of the model,
/// - has no degenerate triangle and none with a smaller angle than allowed.
/// A surface that bounds the model with that clearance at the start therefore does at the end. Contacts within the
/// surface are decided exactly, distances up to a few units of 2^-52 of the sizes involved, far below any clearance;
/// all on the coordinates as they will be written: points are rounded to float where float can hold the model.
/// Immutable; any number of threads may use one at the same time. Building: O(n log n) in the model's faces.
class VDBCAGE_API BoundingGuard {
public:
    /// \throw InputError (an unusable model, options out of range), Cancelled
    explicit BoundingGuard(const Mesh& model, const GuardOptions& options = {}, Interrupter* interrupter = nullptr);
    ~BoundingGuard();
    BoundingGuard(BoundingGuard&&) noexcept;
    BoundingGuard& operator=(BoundingGuard&&) noexcept;

    /// The least distance kept, in world units.
    double clearance() const;
    /// Whether every face of `surface` keeps the clearance (quads: under both diagonals). In parallel.
    bool isClear(const Mesh& surface) const;

    /// For the operators of this library.
    const detail::GuardModel& model() const { return *model_; }

private:
    std::unique_ptr<const detail::GuardModel> model_;
};

} // namespace vdbcage
