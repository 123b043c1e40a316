#pragma once

#include <optional>

#include <tools/view/jobs/cage_result.h>
#include <vdbcage/bounding/bounding_guard.h>
#include <vdbcage/check/check.h>

namespace vdbcage::view {

/// A maker of the results of opened cages. It keeps the search trees of the last model.
class OpenedCages {
public:
    /// Returns the cage and its check, as it was opened, or fitted if the order has a fit. A fit that fails leaves the
    /// cage as it was, with the reason.
    /// \pre the order has a cage
    /// \throw InputError the model is unusable; Cancelled
    CageResult made(const Order& order, Interrupter& interrupter);

private:
    void take(const Order& order, Interrupter& interrupter);
    const BoundingGuard& guard(Precision precision, Interrupter& interrupter);
    bool hasToMove(const Order& order, Interrupter& interrupter);
    /// Fits the cage of the result, or notes the problem. Returns whether it was fitted.
    bool fit(CageResult& result, Interrupter& interrupter);
    CageCheck checked(const Mesh& cage, Interrupter& interrupter) const;

    OpenedMeshPtr model_;
    double leastPart_ = 0;
    Mesh largeParts_; ///< of the model; empty: all of it counts
    std::optional<CageChecker> checker_;
    std::optional<BoundingGuard> guard_;
    Precision precision_ = Precision::automatic; ///< of the guard
};

} // namespace vdbcage::view
