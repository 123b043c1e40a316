#include <tools/report/fit_words.h>

#include <algorithm>
#include <cstddef>
#include <vector>

namespace vdbcage::report {

namespace {

/// Returns " (face 3)" or " (faces 3, 4, 5 and 12 more)"; nothing for none.
std::string facesInWords(const std::vector<std::size_t>& faces)
{
    constexpr std::size_t most = 5;
    if (faces.empty()) return {};
    std::string text = faces.size() == 1 ? " (face " : " (faces ";
    for (std::size_t i = 0; i < std::min(most, faces.size()); ++i)
        text += (i > 0 ? ", " : "") + std::to_string(faces[i]);
    if (faces.size() > most) text += " and " + std::to_string(faces.size() - most) + " more";
    return text + ")";
}

} // namespace

std::string unfoundPlace(const Fit& fit)
{
    const std::string faces = facesInWords(fit.heldFaces);
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
