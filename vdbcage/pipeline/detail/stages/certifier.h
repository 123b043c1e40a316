#pragma once

#include <cstddef>
#include <memory>

#include <vdbcage/check/check.h>
#include <vdbcage/core/interrupter.h>
#include <vdbcage/core/precision.h>
#include <vdbcage/mesh/detail/precision.h>
#include <vdbcage/mesh/mesh.h>

namespace vdbcage::detail {

/// The examination of cages of one model by CageChecker, whose code is not the guard's.
class Certifier {
public:
    /// `model` must outlive this.
    explicit Certifier(const Mesh& model);

    const Mesh& model() const { return model_; }
    /// Returns the verdict and measures of a cage, against the model as given.
    /// \throw Cancelled
    CageCheck check(const Mesh& cage, Interrupter* interrupter);
    /// Returns whether a cage also bounds the model in a host that stores floats; true if coordinates are not rounded
    /// to float.
    /// \throw Cancelled
    bool boundsAsFloats(const Mesh& cage, Precision precision, Interrupter* interrupter);

    /// Returns the number of hollows of the model.
    /// \throw Cancelled
    std::size_t hollows(Interrupter* interrupter) { return checker(interrupter).hollows(); }

    /// Returns whether coordinates of cages are rounded to float.
    bool areFloats(Precision precision) const { return detail::areFloats(precision, box_); }
    /// Returns `mesh` with its points rounded in this way.
    Mesh rounded(Mesh mesh, Precision precision) const;

private:
    const CageChecker& checker(Interrupter* interrupter);

    const Mesh& model_;
    openvdb::BBoxd box_;                         // of the model
    std::unique_ptr<const CageChecker> checker_; // made when first needed
};

} // namespace vdbcage::detail
