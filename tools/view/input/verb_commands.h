#pragma once

#include <optional>
#include <string>

#include <tools/view/state/command.h>
#include <vdbcage/mesh/symmetry.h>

namespace vdbcage::view {

/// The command that a verb amounts to now, such as "toggle model" or "select-all" (see verbs.h); none: the verb is no
/// such one. `made` is the plane in which the cage was made symmetric.
/// \throw InputError what is wrong with its argument, or what is missing
std::optional<Command> commandOfVerb(const State& state, const std::optional<SymmetryPlane>& made,
                                     const std::string& verb, const std::string& argument);

} // namespace vdbcage::view
