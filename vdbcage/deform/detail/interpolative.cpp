// Based on: H. Cheng, Z. Gimbutas, P. Martinsson, V. Rokhlin, "On the Compression of Low Rank Matrices", 2005.
// Differs: the decomposition is of the differences from one row, so that the part shared by all rows is exact and
// rounding the factors costs almost nothing; rows are chosen by the sum of absolute values, which bounds the error of a
// point. Nothing bounds the factors, so rows that large factors put too far off are found and kept.

#include <vdbcage/deform/detail/interpolative.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include <vdbcage/deform/detail/kernels/row_kernels.h>

namespace vdbcage::detail {

namespace {

// The largest error of a row with rounding, in tolerances.
constexpr double withRounding = 4;
// Rounding costs about 2^-26 of the terms of a combination. Where these are less than this many times the row's size,
// it is ignored: for coordinates they are 10 to 20 times, and 65 at most (creature, cages of 400 and 1500 faces).
constexpr double harmlessGrowth = 24;

/// The residuals of the rows after their projection on the rows kept so far, by Gram and Schmidt.
class Residuals {
public:
    Residuals(const std::vector<float>& rows, const std::vector<float>& reach, float tolerance)
        : width_((reach.size() + floatLanes - 1) / floatLanes * floatLanes), count_(rows.size() / reach.size()),
          entries_(count_ * width_, 0.0F), allowed_(count_), size_(count_), coefficients_(count_ * count_),
          asked_(count_, 0)
    {
        for (std::size_t r = 0; r < count_; ++r) {
            const float* const source = rows.data() + r * reach.size();
            float* const row = entries_.data() + r * width_;
            for (std::size_t k = 0; k < reach.size(); ++k) row[k] = source[k] * reach[k];
            allowed_[r] = tolerance * sizeOf(r);
            for (std::size_t k = 0; k < reach.size(); ++k) row[k] = (source[k] - rows[k]) * reach[k];
            size_[r] = sizeOf(r);
        }
        difference_ = size_;
    }

    /// Makes the row be kept, whatever its residual.
    void ask(std::size_t row) { asked_[row] = 1; }

    /// Returns how far the row's residual is above the allowed one; infinite where it is no number, or the row must be
    /// kept.
    float excess(std::size_t row) const
    {
        const float excess = size_[row] - allowed_[row];
        return asked_[row] != 0 || std::isnan(excess) ? std::numeric_limits<float>::infinity() : excess;
    }

    /// Subtracts the projections on row `pivot`, the `step`th kept, from `rows`.
    void project(const std::vector<std::uint32_t>& rows, std::uint32_t pivot, std::size_t step)
    {
        std::vector<float*> places;
        for (const std::uint32_t row : rows) places.push_back(entries_.data() + row * width_);
        std::vector<float> factors(rows.size()), sizes(rows.size());
        rowKernels().project(places.data(), rows.size(), entries_.data() + pivot * width_, inverseSquare(pivot), width_,
                             factors.data(), sizes.data());
        for (std::size_t i = 0; i < rows.size(); ++i) {
            size_[rows[i]] = sizes[i];
            coefficients_[rows[i] * count_ + step] = factors[i];
        }
    }

    /// Returns the size of the row minus the first one.
    float difference(std::size_t row) const { return difference_[row]; }
    /// Returns `tolerance` times the size of the row.
    float allowed(std::size_t row) const { return allowed_[row]; }

    float coefficient(std::size_t row, std::size_t step) const { return coefficients_[row * count_ + step]; }

private:
    /// Returns the sum of `term` of each entry of the row, in parts for vectors.
    template <typename Term>
    float sumOf(std::size_t row, const Term& term) const
    {
        float sums[floatLanes] = {};
        for (std::size_t k = 0; k < width_; k += floatLanes) {
            for (std::size_t i = 0; i < floatLanes; ++i) sums[i] += term(entries_[row * width_ + k + i]);
        }
        return std::accumulate(sums, sums + floatLanes, 0.0F);
    }
    float sizeOf(std::size_t row) const
    {
        return sumOf(row, [](float entry) { return std::abs(entry); });
    }
    /// Returns one over the sum of squares, or 0 if that is zero.
    float inverseSquare(std::size_t row) const
    {
        const float square = sumOf(row, [](float entry) { return entry * entry; });
        return square > 0 ? 1 / square : 0;
    }

    std::size_t width_, count_;
    std::vector<float> entries_, allowed_, size_, difference_, coefficients_;
    std::vector<char> asked_;
};

/// Returns the factors of the first `kept` of `order`, except one, for the row order[i].
///
/// A row is a combination of the residuals of the kept rows at the time when they were kept. Each residual is itself a
/// kept row minus a combination of those before. The factors are solved for from the last to the first.
std::vector<double> factorsOf(const Residuals& residuals, const std::vector<std::uint32_t>& order, std::size_t kept,
                              std::size_t i)
{
    std::vector<double> factors(kept - 1);
    for (std::size_t j = 0; j + 1 < kept; ++j) factors[j] = double(residuals.coefficient(order[i], j));
    for (std::size_t j = kept - 1; j-- > 0;) {
        for (std::size_t before = 0; before < j; ++before) {
            factors[before] -= factors[j] * double(residuals.coefficient(order[j + 1], before));
        }
    }
    return factors;
}

/// Returns the error of the combination by `factors` in the row order[i].
double offBy(const std::vector<float>& rows, const std::vector<float>& reach, const std::vector<std::uint32_t>& order,
             std::size_t i, const float* factors, std::size_t factorCount)
{
    const float* const first = rows.data() + order[0] * reach.size();
    const float* const row = rows.data() + order[i] * reach.size();
    std::vector<double> left(reach.size());
    for (std::size_t k = 0; k < reach.size(); ++k) left[k] = double(row[k]) - double(first[k]);
    for (std::size_t j = 0; j < factorCount; ++j) {
        if (factors[j] == 0) continue;
        const float* const held = rows.data() + order[j + 1] * reach.size();
        for (std::size_t k = 0; k < reach.size(); ++k) {
            left[k] -= double(factors[j]) * (double(held[k]) - double(first[k]));
        }
    }
    double sum = 0;
    for (std::size_t k = 0; k < reach.size(); ++k) sum += std::abs(left[k]) * double(reach[k]);
    return sum;
}

} // namespace

InterpolativeRows interpolativeRows(const std::vector<float>& rows, const std::vector<float>& reach, float tolerance,
                                    std::size_t unit, Interrupter* interrupter)
{
    const std::size_t count = reach.empty() ? 0 : rows.size() / reach.size();
    InterpolativeRows all;
    all.order.resize(count);
    std::iota(all.order.begin(), all.order.end(), 0U);
    all.kept = count;
    if (count <= unit) return all;

    Residuals residuals(rows, reach, tolerance);
    InterpolativeRows result = all;
    std::vector<std::uint32_t>& order = result.order;
    for (std::size_t kept = 1;;) {
        for (;; ++kept) {
            throwIfInterrupted(interrupter);
            if (kept > reach.size()) return all; // there would be as many factors as the entries that they replace
            const auto worst = std::max_element(
                order.begin() + static_cast<std::ptrdiff_t>(kept), order.end(),
                [&](std::uint32_t a, std::uint32_t b) { return residuals.excess(a) < residuals.excess(b); });
            if (kept % unit == 0 && !(residuals.excess(*worst) > 0)) break;
            if (kept + 1 == count) return all;
            std::swap(order[kept], *worst);
            const std::vector<std::uint32_t> rest(order.begin() + static_cast<std::ptrdiff_t>(kept) + 1, order.end());
            residuals.project(rest, order[kept], kept - 1);
        }

        std::vector<std::uint32_t> tooFarOff;
        for (std::size_t i = kept; i < count; ++i) {
            double sum = 0;
            const std::vector<double> factors = factorsOf(residuals, order, kept, i);
            for (std::size_t j = 0; j + 1 < kept; ++j) {
                result.factors.push_back(static_cast<float>(factors[j]));
                if (factors[j] != 0) sum += std::abs(factors[j]) * double(residuals.difference(order[j + 1]));
            }
            const auto allowed = double(residuals.allowed(order[i]));
            if (double(tolerance) * sum <= harmlessGrowth * allowed) continue;
            const float* const rounded = result.factors.data() + (i - kept) * (kept - 1);
            if (!(offBy(rows, reach, order, i, rounded, kept - 1) <= withRounding * allowed)) {
                tooFarOff.push_back(order[i]);
            }
        }
        result.kept = kept;
        if (tooFarOff.empty()) return result;
        for (const std::uint32_t row : tooFarOff) residuals.ask(row);
        result.factors.clear();
    }
}

} // namespace vdbcage::detail
