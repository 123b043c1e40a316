#include <tools/draw/diverging_colours.h>

#include <algorithm>
#include <cmath>

namespace vdbcage::draw {

std::vector<Colour> divergingColours(const std::vector<double>& values)
{
    constexpr Colour negative{0.17F, 0.32F, 0.80F}, zero{0.90F, 0.90F, 0.88F}, positive{0.76F, 0.10F, 0.12F};
    double most = 0;
    for (const double value : values) most = std::max(most, std::abs(value));
    std::vector<Colour> colours;
    colours.reserve(values.size());
    for (const double value : values) {
        const auto share = static_cast<float>(most > 0 ? std::sqrt(std::abs(value) / most) : 0);
        const Colour& end = value < 0 ? negative : positive;
        Colour colour{};
        for (std::size_t k = 0; k < 3; ++k) colour[k] = zero[k] + share * (end[k] - zero[k]);
        colours.push_back(colour);
    }
    return colours;
}

} // namespace vdbcage::draw
