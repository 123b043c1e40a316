#include <tools/report/fit_words.h>

#include <algorithm>
#include <cstddef>
#include <vector>

namespace vdbcage::report {

namespace {

/// Returns "face 3" or "faces 3, 4, 5 and 12 more".
std::string inWords(const std::string& name, const std::vector<std::size_t>& numbers)
{
    constexpr std::size_t most = 5;
    std::string text = numbers.size() == 1 ? name + ' ' : name + "s ";
    for (std::size_t i = 0; i < std::min(most, numbers.size()); ++i)
        text += (i > 0 ? ", " : "") + std::to_string(numbers[i]);
    if (numbers.size() > most) text += " and " + std::to_string(numbers.size() - most) + " more";
    return text;
}

/// Returns " (faces 3, 4; kept: point 7)"; nothing if there are none.
std::string holdersOf(const Fit& fit)
{
    if (fit.heldFaces.empty()) return {};
    std::string text = " (" + inWords("face", fit.heldFaces);
    if (!fit.holdingPoints.empty()) text += "; kept: " + inWords("point", fit.holdingPoints);
    return text + ')';
}

} // namespace

std::string unfoundPlace(const Fit& fit)
{
    const std::string faces = holdersOf(fit);
    switch (fit.obstacle) {
    case Fit::Obstacle::itself:
        return "it does not cross itself" + faces;
    case Fit::Obstacle::quads:
        return "these quads bound under both diagonals" + faces;
    case Fit::Obstacle::model:
    case Fit::Obstacle::none:
        break;
    }
    return "it does not cut the model" + faces;
}

} // namespace vdbcage::report
