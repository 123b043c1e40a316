// Uses a context of each source on TBB's workers, which outlive main and end while libraries are torn down.

#include <chrono>
#include <memory>
#include <mutex>
#include <thread>
#include <vector>

#include <support/gl_sources.h>
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <vdbcage/gl/offscreen.h>

int main()
{
    using vdbcage::gl::OffscreenContext;
    const tbb::global_control control(tbb::global_control::max_allowed_parallelism, 8);
    std::vector<std::unique_ptr<OffscreenContext>> contexts;
    for (const OffscreenContext::Source source : vdbcage::test::everySource()) {
        contexts.push_back(std::make_unique<OffscreenContext>(OffscreenContext::Debug::off, source));
    }
    std::mutex one;
    tbb::parallel_for(0, 64, [&](int i) {
        {
            const std::lock_guard lock(one);
            const OffscreenContext::Current current =
                contexts[static_cast<std::size_t>(i) % contexts.size()]->makeCurrent();
        }
        std::this_thread::sleep_for(std::chrono::milliseconds(1)); // so that every worker gets its share
    });
}
