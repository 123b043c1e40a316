#pragma once

namespace vdbcage::tool {

constexpr int exitGood = 0, exitError = 1, exitNotBounding = 2, exitCancelled = 130;

} // namespace vdbcage::tool
