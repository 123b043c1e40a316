#pragma once

#include <array>

namespace vdbcage::draw {

/// Red, green and blue in sRGB, each in [0, 1].
using Colour = std::array<float, 3>;

} // namespace vdbcage::draw
