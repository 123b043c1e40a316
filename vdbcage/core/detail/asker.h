#pragma once

#include <cstdint>

#include <vdbcage/core/interrupter.h>

namespace vdbcage::detail {

/// A function object that asks an interrupter at every 65536th call: for loops whose turns take nanoseconds, and for
/// comparisons in a sort. For one thread.
class Asker {
public:
    explicit Asker(Interrupter* interrupter) : interrupter_(interrupter) {}

    /// \throw Cancelled
    void operator()()
    {
        if ((++calls_ & 0xffffU) == 0) throwIfInterrupted(interrupter_);
    }

private:
    Interrupter* interrupter_;
    std::uint32_t calls_ = 0;
};

} // namespace vdbcage::detail
