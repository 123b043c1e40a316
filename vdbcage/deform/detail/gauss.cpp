#include <vdbcage/deform/detail/gauss.h>

#include <cmath>
#include <cstddef>

#include <vdbcage/core/detail/pi.h>

namespace vdbcage::detail {

namespace {

/// Finds the roots of the Legendre polynomial by Newton's method.
GaussRule makeRule(int points)
{
    GaussRule rule{};
    for (int i = 0; i < points; ++i) {
        double x = std::cos(pi * (i + 0.75) / (points + 0.5)), slope = 1;
        for (int step = 0; step < 10; ++step) {
            double before = 1, value = x;
            for (int k = 2; k <= points; ++k) {
                const double next = ((2 * k - 1) * x * value - (k - 1) * before) / k;
                before = value;
                value = next;
            }
            slope = points * (x * value - before) / (x * x - 1);
            x -= value / slope;
        }
        rule.at[static_cast<std::size_t>(i)] = 0.5 * (1 - x);
        rule.weight[static_cast<std::size_t>(i)] = 1 / ((1 - x * x) * slope * slope);
    }
    return rule;
}

std::array<GaussRule, mostGaussPoints> makeRules()
{
    std::array<GaussRule, mostGaussPoints> rules{};
    for (int points = 1; points <= mostGaussPoints; ++points) {
        rules[static_cast<std::size_t>(points - 1)] = makeRule(points);
    }
    return rules;
}

} // namespace

const GaussRule& gaussRule(int points)
{
    static const std::array<GaussRule, mostGaussPoints> rules = makeRules();
    return rules[static_cast<std::size_t>(points - 1)];
}

} // namespace vdbcage::detail
