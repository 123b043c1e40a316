#pragma once

#include <exception>

namespace vdbcage::cli {

constexpr int exitGood = 0, exitError = 1, exitNotBounding = 2;
constexpr int exitTryAgain = 75; ///< EX_TEMPFAIL: memory, room on the disk, threads or a device are missing
/// After SIGTERM, 128 and its number as shells say it; after any other signal that asks for an end that of SIGINT.
constexpr int exitCancelled = 130, exitTerminated = 143;

/// Why a command ends. `text` lives as long as the exception.
struct Failure {
    const char* text;
    int status;
};
/// Allocates nothing, as there may be no memory left.
Failure failureOf(const std::exception& exception) noexcept;

} // namespace vdbcage::cli
