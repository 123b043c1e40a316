#pragma once

#include <tbb/parallel_for.h>
#include <tbb/task_group.h>

namespace vdbcage::test {

/// Calls `work` within a task of a group that is cancelled already, as a host may cancel it: TBB's loops in it do
/// nothing and return as if they had run.
template <typename Work>
void inCancelledHost(const Work& work)
{
    tbb::task_group_context host;
    tbb::parallel_for(
        0, 1,
        [&](int) {
            host.cancel_group_execution();
            work();
        },
        host);
}

} // namespace vdbcage::test
