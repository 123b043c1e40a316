#pragma once

#include <memory>

#include <vdbcage/volume/detail/line_entries.h>

namespace vdbcage::detail {

/// Dilates a line of a row and adds it, its axes permuted, to `result`, by block of the row.
void dilateLine(const Line& line, LineEntries& entries, const std::unique_ptr<FlatBlock>* result);

} // namespace vdbcage::detail
