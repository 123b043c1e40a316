#pragma once

#include <memory>
#include <string>
#include <vector>

#include <tools/view/jobs/intermediates.h>
#include <tools/view/state/state.h>
#include <vdbcage/core/interrupter.h>
#include <vdbcage/pipeline/pipeline.h>

namespace vdbcage::view {

/// Everything that a cage depends on.
struct Order {
    OpenedMeshPtr model;
    CageOptions options;
    OpenedMeshPtr cage; ///< one that was opened, which is only checked; null: it is made
};
bool operator==(const Order& a, const Order& b);
inline bool operator!=(const Order& a, const Order& b)
{
    return !(a == b);
}

/// The same with least effort: what is shown until the cage itself is there. Of an opened cage: itself.
Order previewOf(Order order);

/// A cage with what it was made by. It never changes.
struct CageResult {
    Order order;
    Mesh cage;
    CageReport report; ///< of an opened cage only its `check`
    std::vector<StageTime> stages;
    double seconds = 0; ///< wall clock
    /// Null if they were not asked for. An opened cage has only the distances.
    std::shared_ptr<const Intermediates> intermediates;
};
using CageResultPtr = std::shared_ptr<const CageResult>;

/// One thing to do.
struct Job {
    enum class Kind {
        preview, ///< of what is wanted
        full,    ///< what is wanted
        ahead    ///< a preview of what may be wanted next
    };
    Kind kind = Kind::full;
    Order order;
    bool intermediates = false; ///< the result is to have them
};

/// Makes cages, on the thread of the runner. Tests have others.
class CageMaker {
public:
    virtual ~CageMaker() = default;
    /// \throw Error, Cancelled
    virtual CageResultPtr make(const Job& job, Interrupter& interrupter) = 0;
};

} // namespace vdbcage::view
