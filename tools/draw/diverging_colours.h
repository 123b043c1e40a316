#pragma once

#include <vector>

#include <tools/draw/colour.h>

namespace vdbcage::draw {

/// Returns a colour for each value: from blue, negative, over light grey to red. The value of largest size has the full
/// colour; the square root between makes small values visible too.
std::vector<Colour> divergingColours(const std::vector<double>& values);

} // namespace vdbcage::draw
