#pragma once

#include <cstddef>
#include <memory>

#include <vdbcage/volume/detail/cube/line_entries.h>

namespace vdbcage::detail {

/// Dilates the 16 lines at the i-th y of the stretch that `entries` reads. Adds them, with their axes permuted, to
/// `result`, by block of the row.
void dilateLines(std::size_t stretch, std::size_t i, LineEntries& entries, const std::unique_ptr<FlatBlock>* result);

} // namespace vdbcage::detail
