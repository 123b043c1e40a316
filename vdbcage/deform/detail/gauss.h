#pragma once

#include <array>

namespace vdbcage::detail {

/// The largest number of points that gaussRule() has.
constexpr int mostGaussPoints = 12;

/// Points in [0, 1] and their weights, of sum 1.
struct GaussRule {
    std::array<double, mostGaussPoints> at, weight;
};

/// Gauss-Legendre quadrature with 1 to mostGaussPoints points.
const GaussRule& gaussRule(int points);

} // namespace vdbcage::detail
