#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <tools/view/jobs/intermediates.h>
#include <tools/view/state/state.h>
#include <vdbcage/core/interrupter.h>
#include <vdbcage/pipeline/pipeline.h>

namespace vdbcage::view {

/// A fit of an opened cage.
struct FitOrder {
    double tightness = 0;                      ///< in FitOptions::tightnesses
    std::vector<openvdb::Index32> locked = {}; ///< points that stay
};
inline bool operator==(const FitOrder& a, const FitOrder& b)
{
    return a.tightness == b.tightness && a.locked == b.locked;
}

/// Everything that a cage depends on.
struct Order {
    OpenedMeshPtr model;
    CageOptions options;
    OpenedMeshPtr cage;               ///< an opened one, which is checked; null: it is made
    std::optional<FitOrder> fit = {}; ///< of the opened one; none: it stays as it is
};
bool operator==(const Order& a, const Order& b);
inline bool operator!=(const Order& a, const Order& b)
{
    return !(a == b);
}

/// Returns the order for the document's cage. \pre there is a model
Order orderOf(const Document& document);

/// Returns the order with least effort: its cage is shown until the full one is there. An order of an opened cage stays
/// as it is.
Order previewOf(Order order);

/// A cage and the data that it was made by. It never changes.
struct CageResult {
    Order order;
    Mesh cage;
    CageReport report;           ///< of an opened cage only its `check`
    std::string fitProblem = {}; ///< the reason why a fit left the cage as it was; empty: none
    std::vector<StageTime> stages;
    double seconds = 0; ///< wall clock
    /// Null if they were not requested. An opened cage has only the distances.
    std::shared_ptr<const Intermediates> intermediates;
};
using CageResultPtr = std::shared_ptr<const CageResult>;

/// A job of the maker.
struct Job {
    enum class Kind {
        preview, ///< a preview of the wanted cage
        full,    ///< the wanted cage
        ahead    ///< a preview of a cage that may be wanted next
    };
    Kind kind = Kind::full;
    Order order;
    bool intermediates = false; ///< whether the result must have them
};

/// A maker of cages, on the runner's thread. Tests have makers of their own.
class CageMaker {
public:
    virtual ~CageMaker() = default;
    /// \throw Error, Cancelled
    virtual CageResultPtr make(const Job& job, Interrupter& interrupter) = 0;
};

} // namespace vdbcage::view
