#pragma once

#include <string>

#include <tools/view/state/state.h>

namespace vdbcage::view {

/// The circumstances in which a line is performed.
struct Situation {
    const State& state;
    const PosableCagePtr& cage;
    const SymmetryPlane* symmetry = nullptr; ///< of the shown cage; null: it was made without symmetry
    std::string* remark = nullptr;           ///< gets a note for the user; null: not needed
};

} // namespace vdbcage::view
