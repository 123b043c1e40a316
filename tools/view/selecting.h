#pragma once

#include <string>

#include <tools/view/state/state.h>

namespace vdbcage::view {

/// What is selected of the cage after a verb that begins with "select-", such as "select-all" (see verbs.h).
/// \throw InputError there is no cage, or `kind` is none
edit::Selection selectionAfter(const State& state, const std::string& verb, const std::string& kind);

} // namespace vdbcage::view
