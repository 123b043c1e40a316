#include <boost/test/unit_test.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

#include <deform/cages.h>
#include <vdbcage/deform/detail/interpolative.h>

using namespace vdbcage;
using detail::InterpolativeRows;
using detail::interpolativeRows;
using openvdb::Vec3d;
using test::Random;

namespace {

constexpr std::size_t columns = 301, unit = 16;
constexpr float tolerance = 1.0F / (1 << 22);

/// Columns of different size.
std::vector<float> makeReach(Random& random)
{
    std::vector<float> reach;
    for (std::size_t k = 0; k < columns; ++k) reach.push_back(static_cast<float>(random(0.01, 2)));
    return reach;
}

/// The potentials at `count` points in a box, `width` wide, of charges one off.
std::vector<float> potentials(Random& random, std::size_t count, double width)
{
    std::vector<Vec3d> charges;
    for (std::size_t k = 0; k < columns; ++k) charges.push_back(random(1, 2) * random.direction());
    std::vector<float> rows;
    for (std::size_t i = 0; i < count; ++i) {
        const Vec3d at = 0.5 * width * Vec3d(random(-1, 1), random(-1, 1), random(-1, 1));
        for (const Vec3d& charge : charges) rows.push_back(static_cast<float>(1 / (at - charge).length()));
    }
    return rows;
}

/// What the combinations are off by, at most, relative to the rows' sizes.
double offBy(const InterpolativeRows& few, const std::vector<float>& rows, const std::vector<float>& reach)
{
    double most = 0;
    for (std::size_t i = few.kept; i < few.order.size(); ++i) {
        double off = 0, size = 0;
        for (std::size_t k = 0; k < columns; ++k) {
            const auto at = [&](std::size_t row) { return double(rows[few.order[row] * columns + k]); };
            double sum = at(0);
            for (std::size_t j = 0; j + 1 < few.kept; ++j) {
                sum += double(few.factors[(i - few.kept) * (few.kept - 1) + j]) * (at(j + 1) - at(0));
            }
            off += double(reach[k]) * std::abs(sum - at(i));
            size += double(reach[k]) * std::abs(at(i));
        }
        most = std::max(most, off / size);
    }
    return most;
}

bool isPermutation(std::vector<std::uint32_t> order, std::size_t count)
{
    std::sort(order.begin(), order.end());
    for (std::size_t i = 0; i < order.size(); ++i) {
        if (order[i] != i) return false;
    }
    return order.size() == count;
}

bool keepsAll(const InterpolativeRows& few, std::size_t count)
{
    return few.kept == count && few.factors.empty() && isPermutation(few.order, count);
}

} // namespace

BOOST_AUTO_TEST_SUITE(interpolative)

BOOST_AUTO_TEST_CASE(combines_rows_within_the_tolerance)
{
    Random random(1);
    std::size_t before = 0;
    for (const double width : {0.01, 0.1, 0.5}) {
        const std::vector<float> reach = makeReach(random), rows = potentials(random, 256, width);
        const InterpolativeRows few = interpolativeRows(rows, reach, tolerance, unit);
        BOOST_TEST(isPermutation(few.order, 256));
        BOOST_TEST(few.kept % unit == 0U);
        BOOST_TEST(few.kept >= before); // the farther apart, the more
        BOOST_TEST(few.kept <= 128U);
        BOOST_REQUIRE(few.factors.size() == (256 - few.kept) * (few.kept - 1));
        BOOST_TEST(offBy(few, rows, reach) < 1.1 * double(tolerance));
        BOOST_TEST(interpolativeRows(rows, reach, 100 * tolerance, unit).kept <= few.kept);
        before = few.kept;
    }
    BOOST_TEST(before > 2 * unit);
}

BOOST_AUTO_TEST_CASE(keeps_rows_that_are_not_alike)
{
    Random random(2);
    const std::vector<float> reach = makeReach(random);
    std::vector<float> rows = potentials(random, 200, 0.1);
    for (std::size_t k = 0; k < columns; ++k) rows[77 * columns + k] = static_cast<float>(random(-1, 1));
    const InterpolativeRows few = interpolativeRows(rows, reach, tolerance, unit);
    BOOST_TEST(few.kept < 100U);
    BOOST_TEST((std::find(few.order.begin(), few.order.begin() + static_cast<std::ptrdiff_t>(few.kept), 77U) !=
                few.order.begin() + static_cast<std::ptrdiff_t>(few.kept)));
    for (float& entry : rows) entry = static_cast<float>(random(-1, 1));
    BOOST_TEST(keepsAll(interpolativeRows(rows, reach, tolerance, unit), 200));
}

BOOST_AUTO_TEST_CASE(keeps_all_rows_where_that_is_no_more)
{
    Random random(3);
    const std::vector<float> reach = makeReach(random), rows = potentials(random, 200, 0.1);
    const std::vector<float> firstRows(rows.begin(), rows.begin() + unit * columns);
    BOOST_TEST(keepsAll(interpolativeRows(firstRows, reach, tolerance, unit), unit));
    BOOST_TEST(keepsAll(interpolativeRows({}, reach, tolerance, unit), 0));
    const std::vector<float> narrow(rows.begin(), rows.begin() + 8 * 50), ones(8, 1.0F); // of 8 columns
    BOOST_TEST(keepsAll(interpolativeRows(narrow, ones, tolerance, unit), 50));
}

/// Each row but the last is orthogonal to those before once they are projected on. The last is a combination of them
/// whose factors grow by half from one to the next.
BOOST_AUTO_TEST_CASE(keeps_rows_that_only_large_factors_combine)
{
    constexpr std::size_t steps = 40, count = 2 * steps + 3;
    const std::vector<float> ones(columns, 1.0F);
    std::vector<float> rows(columns, 0.0F);
    for (std::size_t i = 1; i < count; ++i) {
        const std::size_t step = (i - 1) % (steps + 1);
        for (std::size_t k = 0; k < columns; ++k) {
            const double entry = k > step || k == steps ? 0 : k == step ? 1 : -0.475;
            rows.push_back(static_cast<float>(entry * std::pow(0.5, double(k))));
        }
    }
    for (std::size_t i = 0; i < count; ++i) rows[i * columns + columns - 1] = 1; // so the rows have a size
    const InterpolativeRows few = interpolativeRows(rows, ones, tolerance, unit);
    BOOST_TEST(isPermutation(few.order, count));
    BOOST_REQUIRE(few.kept < count);
    BOOST_TEST(few.kept % unit == 0U);
    BOOST_REQUIRE(few.factors.size() == (count - few.kept) * (few.kept - 1));
    BOOST_TEST(offBy(few, rows, ones) <= 4 * double(tolerance));
}

BOOST_AUTO_TEST_CASE(takes_rows_that_are_zero_equal_or_no_numbers)
{
    Random random(4);
    const std::vector<float> reach = makeReach(random);
    std::vector<float> rows(100 * columns, 0.0F);
    InterpolativeRows few = interpolativeRows(rows, reach, tolerance, unit);
    BOOST_TEST(few.kept == unit);
    BOOST_TEST(std::count(few.factors.begin(), few.factors.end(), 0.0F) == std::ptrdiff_t(few.factors.size()));
    std::fill(rows.begin() + 7 * columns, rows.begin() + 8 * columns, 1.0F);
    few = interpolativeRows(rows, reach, tolerance, unit);
    BOOST_TEST(few.kept == unit);
    BOOST_TEST((std::find(few.order.begin(), few.order.begin() + unit, 7U) != few.order.begin() + unit));
    for (const float value : {std::numeric_limits<float>::infinity(), std::nanf(""), 1e38F}) {
        rows = potentials(random, 100, 0.1);
        rows[41 * columns + 3] = value;
        few = interpolativeRows(rows, reach, tolerance, unit);
        BOOST_TEST((std::find(few.order.begin(), few.order.begin() + static_cast<std::ptrdiff_t>(few.kept), 41U) !=
                    few.order.begin() + static_cast<std::ptrdiff_t>(few.kept)));
        for (const float factor : few.factors) BOOST_REQUIRE(std::isfinite(factor));
    }
}

BOOST_AUTO_TEST_SUITE_END()
