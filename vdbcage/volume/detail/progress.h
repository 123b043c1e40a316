#pragma once

#include <cstddef>

#include <vdbcage/core/interrupter.h>

namespace vdbcage::detail {

/// The part of a stage's progress that one of several passes covers.
struct Progress {
    Interrupter* interrupter = nullptr;
    int from = 0, to = 100; ///< percent

    /// Returns the `index`-th of `count` equal parts of this part.
    Progress part(int index, int count) const
    {
        return {interrupter, from + (to - from) * index / count, from + (to - from) * (index + 1) / count};
    }
    /// Returns the empty part at the end.
    Progress end() const { return {interrupter, to, to}; }
    /// \throw Cancelled
    void check(std::size_t done, std::size_t total) const
    {
        const double fraction = total > 0 ? static_cast<double>(done) / static_cast<double>(total) : 0;
        throwIfInterrupted(interrupter, from + static_cast<int>((to - from) * fraction));
    }
};

} // namespace vdbcage::detail
