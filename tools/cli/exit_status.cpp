#include <tools/cli/exit_status.h>

#include <cerrno>
#include <cstring>
#include <new>
#include <system_error>

#include <vdbcage/core/error.h>
#include <vdbcage/pipeline/memory.h>

#include <tools/cli/interrupt.h>

namespace vdbcage::cli {

Failure failureOf(const std::exception& exception) noexcept
{
    if (dynamic_cast<const Cancelled*>(&exception)) return {exception.what(), cancelledStatus()};
    if (dynamic_cast<const ResourceError*>(&exception)) return {exception.what(), exitTryAgain};
    if (dynamic_cast<const MemoryError*>(&exception)) return {exception.what(), exitTryAgain};
    if (dynamic_cast<const DeviceError*>(&exception)) return {exception.what(), exitTryAgain};
    if (dynamic_cast<const std::bad_alloc*>(&exception)) return {"not enough memory", exitTryAgain};
    const auto* const system = dynamic_cast<const std::system_error*>(&exception);
    // TBB's exceptions have only the system's text.
    if ((system && system->code() == std::errc::resource_unavailable_try_again) ||
        (!dynamic_cast<const Error*>(&exception) && std::strstr(exception.what(), std::strerror(EAGAIN)))) {
        return {"not enough threads can be started; look at limits on processes (ulimit -u)", exitTryAgain};
    }
    return {exception.what(), exitError};
}

} // namespace vdbcage::cli
