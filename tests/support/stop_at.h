#pragma once

#include <atomic>

#include <vdbcage/core/interrupter.h>

namespace vdbcage::test {

/// An interrupter that says stop from its k-th question on (counted from 0).
struct StopAt : Interrupter {
    explicit StopAt(int k) : left(k) {}
    bool wasInterrupted(int) override { return left-- <= 0; }
    std::atomic<int> left;
};

/// Questions asked so far by what was given a StopAt that never stopped.
inline int questions(const StopAt& watcher, int start)
{
    return start - watcher.left;
}

} // namespace vdbcage::test
