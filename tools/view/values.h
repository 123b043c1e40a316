#pragma once

#include <functional>
#include <map>
#include <string>

#include <tools/view/app_parts.h>

namespace vdbcage::view {

/// What scripts can expect, by names. The parts must outlive it.
std::map<std::string, std::function<std::string()>> valuesOf(const AppParts& parts);

} // namespace vdbcage::view
