#pragma once

#include <string>

#include <tools/view/state/state.h>

namespace vdbcage::view {

/// What a line finds when it is done.
struct Situation {
    const State& state;
    const ShownCage& cage;
    const SymmetryPlane* symmetry = nullptr; ///< in which the cage that is shown was made; null: in none
    std::string* remark = nullptr;           ///< gets what the user is to know of it; null: nobody asks
};

} // namespace vdbcage::view
