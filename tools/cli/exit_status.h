#pragma once

#include <exception>

namespace vdbcage::cli {

constexpr int exitGood = 0, exitError = 1, exitNotBounding = 2;
constexpr int exitTryAgain = 75; ///< EX_TEMPFAIL: memory, disk space, threads or a device are missing
/// 128 + SIGTERM after SIGTERM, 128 + SIGINT after any other signal that asks for an end; shells add 128, too.
constexpr int exitCancelled = 130, exitTerminated = 143;

/// The message and exit status of a failed command. `text` lives as long as the exception.
struct Failure {
    const char* text;
    int status;
};
/// Returns the failure without allocating, as there may be no memory left.
Failure failureOf(const std::exception& exception) noexcept;

} // namespace vdbcage::cli
