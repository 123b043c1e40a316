#pragma once

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace vdbcage::view {

/// A line beside the commands: what menus and keys do.
struct Verb {
    const char* name;
    const char* arguments;
    std::size_t least, most;
    const char* help;
    /// The line is not recorded: it only opens something, or other lines follow from it.
    bool isOfWindow;
};

/// Null: there is none of that name.
const Verb* verbNamed(const std::string& name);

/// All of them: (usage, help).
std::vector<std::pair<std::string, std::string>> describeVerbs();

} // namespace vdbcage::view
