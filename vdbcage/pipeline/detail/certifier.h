#pragma once

#include <cstddef>
#include <memory>

#include <vdbcage/check/check.h>
#include <vdbcage/core/interrupter.h>
#include <vdbcage/core/precision.h>
#include <vdbcage/mesh/detail/precision.h>
#include <vdbcage/mesh/mesh.h>

namespace vdbcage::detail {

/// Examines cages of one model by CageChecker, which is other code than the guard's.
class Certifier {
public:
    /// `model` must outlive this.
    explicit Certifier(const Mesh& model);

    const Mesh& model() const { return model_; }
    /// Verdict and measures of a cage, against the model as given.
    /// \throw Cancelled
    CageCheck check(const Mesh& cage, Interrupter* interrupter);
    /// Whether a cage also bounds the model as a host that stores floats would hold it. True if its coordinates are
    /// not rounded to float.
    /// \throw Cancelled
    bool boundsAsFloats(const Mesh& cage, Precision precision, Interrupter* interrupter);

    /// How many hollows the model has.
    /// \throw Cancelled
    std::size_t hollows(Interrupter* interrupter) { return checker(interrupter).hollows(); }

    /// Whether coordinates of cages are rounded to float.
    bool areFloats(Precision precision) const { return detail::areFloats(precision, box_); }
    /// `mesh` with its points rounded like this.
    Mesh rounded(Mesh mesh, Precision precision) const;

private:
    const CageChecker& checker(Interrupter* interrupter);

    const Mesh& model_;
    openvdb::BBoxd box_;                         // of the model
    std::unique_ptr<const CageChecker> checker_; // once it was asked for
};

} // namespace vdbcage::detail
