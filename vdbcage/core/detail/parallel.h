#pragma once

#include <optional>
#include <type_traits>
#include <utility>

#include <tbb/parallel_for.h>
#include <tbb/parallel_invoke.h>
#include <tbb/parallel_reduce.h>
#include <tbb/parallel_sort.h>
#include <tbb/task_group.h>

/// TBB's parallel loops, each of which runs all of its bodies or throws. The arguments are those of TBB's functions of
/// the same name, without a context.
///
/// When a body of a loop throws, TBB also cancels the loops that run within that loop's bodies. A loop cancelled in
/// this way returns as if it had run: its output stays unfilled, and the caller cannot tell. The outer loop may be the
/// host's. Here every loop has a context of its own, which only an exception of its own bodies cancels. After a body
/// throws, loops within the bodies beside it thus go on until they ask the interrupter themselves.
namespace vdbcage::detail {

template <typename... Arguments>
void parallelFor(Arguments&&... arguments)
{
    tbb::task_group_context own(tbb::task_group_context::isolated);
    tbb::parallel_for(std::forward<Arguments>(arguments)..., own);
}

template <typename... Arguments>
auto parallelReduce(Arguments&&... arguments)
{
    tbb::task_group_context own(tbb::task_group_context::isolated);
    return tbb::parallel_reduce(std::forward<Arguments>(arguments)..., own);
}

template <typename... Arguments>
void parallelInvoke(Arguments&&... arguments)
{
    tbb::task_group_context own(tbb::task_group_context::isolated);
    tbb::parallel_invoke(std::forward<Arguments>(arguments)..., own);
}

/// Runs a function whose parallel loops are not ours, such as OpenVDB's, and returns its result. These loops, too, run
/// all of their bodies or throw.
template <typename Function>
auto isolated(const Function& function)
{
    using Result = decltype(function());
    // Contexts made within the task are bound to the task's own.
    if constexpr (std::is_void_v<Result>) {
        parallelFor(0, 1, [&](int) { function(); });
    } else {
        std::optional<Result> result;
        parallelFor(0, 1, [&](int) { result.emplace(function()); });
        return *std::move(result);
    }
}

template <typename Iterator>
void parallelSort(Iterator begin, Iterator end)
{
    isolated([&] { tbb::parallel_sort(begin, end); }); // it takes no context
}

} // namespace vdbcage::detail
