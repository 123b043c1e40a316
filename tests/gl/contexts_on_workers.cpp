// Uses a context of each source on TBB's workers, which outlive main and end while libraries are torn down.

#include <chrono>
#include <mutex>
#include <thread>

#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <vdbcage/gl/offscreen.h>

int main()
{
    using vdbcage::gl::OffscreenContext;
    const tbb::global_control control(tbb::global_control::max_allowed_parallelism, 8);
    const OffscreenContext egl(OffscreenContext::Debug::off, OffscreenContext::Source::egl);
    const OffscreenContext osmesa(OffscreenContext::Debug::off, OffscreenContext::Source::osmesa);
    std::mutex one;
    tbb::parallel_for(0, 64, [&](int i) {
        {
            const std::lock_guard lock(one);
            const OffscreenContext::Current current = (i % 2 == 0 ? egl : osmesa).makeCurrent();
        }
        std::this_thread::sleep_for(std::chrono::milliseconds(1)); // so that every worker gets its share
    });
}
