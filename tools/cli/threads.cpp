#include <tools/cli/threads.h>

#include <cstddef>
#include <cstdlib>
#include <new>
#include <string>

#include <tbb/global_control.h>

namespace vdbcage::cli {

void limitThreads(int count)
{
    // TBB limits a process as long as such an object lives. It is never destroyed: at the end of the process that would
    // start threads. It is not on the heap, where it would look like a leak.
    alignas(tbb::global_control) static std::byte place[sizeof(tbb::global_control)];
    [[maybe_unused]] static const auto* const limit =
        new (place) tbb::global_control(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(count));
    // Mesa's software driver draws with threads of its own beside the calling one; 0: only with that one.
    ::setenv("LP_NUM_THREADS", std::to_string(count - 1).c_str(), 1);
    if (count == 1) ::setenv("MESA_SHADER_CACHE_DISABLE", "true", 1); // it has a thread that writes
}

} // namespace vdbcage::cli
