#pragma once

#include <memory>

#include <vdbcage/check/check.h>
#include <vdbcage/core/interrupter.h>
#include <vdbcage/mesh/mesh.h>

namespace vdbcage::detail {

/// Examines cages of one model by CageChecker, which is other code than the guard's.
class Certifier {
public:
    /// `model` must outlive this.
    explicit Certifier(const Mesh& model);

    /// Verdict and measures of a cage, against the model as given.
    /// \throw Cancelled
    CageCheck check(const Mesh& cage, Interrupter* interrupter);
    /// Whether a cage also bounds the model as a host that stores floats would hold it. True if float cannot hold it.
    /// \throw Cancelled
    bool boundsAsFloats(const Mesh& cage, Interrupter* interrupter);

    /// Whether float can hold the model.
    bool fitsFloat() const { return fitsFloat_; }
    /// `mesh` with its points as float holds them, if it can.
    Mesh rounded(Mesh mesh) const;

private:
    const CageChecker& checker(Interrupter* interrupter);

    const Mesh& model_;
    bool fitsFloat_;
    std::unique_ptr<const CageChecker> checker_; // once it was asked for
};

} // namespace vdbcage::detail
