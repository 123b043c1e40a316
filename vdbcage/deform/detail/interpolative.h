#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <vdbcage/core/interrupter.h>

namespace vdbcage::detail {

/// The rows of a matrix as combinations of a few of them. The first `kept` of `order` are kept. Row order[kept + i] is
///     row(order[0]) + the sum over j of factors[i * (kept - 1) + j] * (row(order[j + 1]) - row(order[0])).
struct InterpolativeRows {
    std::vector<std::uint32_t> order;
    std::size_t kept = 0;
    std::vector<float> factors;
};

/// Decomposes a matrix. It keeps enough rows for the others to be off by at most `tolerance` of their size before
/// rounding, and by four times that with rounding.
///
/// The size of a row is the sum of its entries' absolute values, each times its column's `reach`. The number of kept
/// rows is a multiple of `unit`, or all rows where that takes no more memory. `rows` are row after row.
/// Cost: O(rows x kept x columns).
/// \throw Cancelled
InterpolativeRows interpolativeRows(const std::vector<float>& rows, const std::vector<float>& reach, float tolerance,
                                    std::size_t unit, Interrupter* interrupter = nullptr);

} // namespace vdbcage::detail
