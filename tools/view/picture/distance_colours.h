#pragma once

#include <algorithm>
#include <array>
#include <cstddef>

#include <tools/draw/colour.h>

namespace vdbcage::view {

/// Returns the colour of a share of the largest distance, 0 to 1: from pale yellow over orange to dark violet. Its
/// lightness falls evenly, so that it can be read without colours too.
inline draw::Colour distanceColour(double share)
{
    constexpr std::array<draw::Colour, 5> stops{{{0.99F, 0.97F, 0.76F},
                                                 {0.98F, 0.76F, 0.42F},
                                                 {0.93F, 0.45F, 0.37F},
                                                 {0.66F, 0.20F, 0.48F},
                                                 {0.27F, 0.08F, 0.44F}}};
    const double place = std::clamp(share, 0.0, 1.0) * (stops.size() - 1);
    const auto stop = std::min(static_cast<std::size_t>(place), stops.size() - 2);
    const auto part = static_cast<float>(place - static_cast<double>(stop));
    draw::Colour colour{};
    for (std::size_t k = 0; k < 3; ++k) colour[k] = stops[stop][k] + part * (stops[stop + 1][k] - stops[stop][k]);
    return colour;
}

} // namespace vdbcage::view
