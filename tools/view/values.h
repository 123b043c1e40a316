#pragma once

#include <functional>
#include <map>
#include <string>

#include <tools/view/app_parts.h>

namespace vdbcage::view {

/// Returns functions for the values that scripts can expect, by name. The parts must outlive the functions.
std::map<std::string, std::function<std::string()>> valuesOf(const AppParts& parts);

} // namespace vdbcage::view
