#pragma once

#include <array>

namespace vdbcage::detail {

constexpr int mostGaussPoints = 12;

struct GaussRule {
    std::array<double, mostGaussPoints> at;     ///< points in [0, 1]
    std::array<double, mostGaussPoints> weight; ///< of sum 1
};

/// Returns the Gauss-Legendre rule with `points` points.
/// \pre `points` is 1 to mostGaussPoints
const GaussRule& gaussRule(int points);

} // namespace vdbcage::detail
