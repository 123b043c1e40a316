#pragma once

#include <atomic>

#include <vdbcage/core/interrupter.h>

namespace vdbcage::test {

/// An interrupter that asks to stop from its k-th question on (counted from 0).
struct StopAt : Interrupter {
    explicit StopAt(int k) : left(k) {}
    bool wasInterrupted(int) override { return left-- <= 0; }
    std::atomic<int> left;
};

/// Returns the number of questions so far to a StopAt that began at `start` and never stopped.
inline int questions(const StopAt& watcher, int start)
{
    return start - watcher.left;
}

} // namespace vdbcage::test
