#include <boost/test/unit_test.hpp>

#include <cmath>
#include <limits>
#include <string>

#include <vdbcage/core/error.h>
#include <vdbcage/core/range.h>

using namespace vdbcage;

BOOST_AUTO_TEST_SUITE(range)

BOOST_AUTO_TEST_CASE(both_ends_are_in_and_nan_is_not)
{
    const Range range{1e-7, 0.1};
    for (const double inside : {1e-7, 0.05, 0.1}) {
        BOOST_TEST(range.contains(inside));
        BOOST_CHECK_NO_THROW(requireWithin(range, inside, "clearance"));
    }
    const double infinity = std::numeric_limits<double>::infinity();
    for (const double outside : {0.0, 9.9e-8, 0.1000001, -0.05, infinity, -infinity, std::nan("")}) {
        BOOST_TEST(!range.contains(outside));
        BOOST_CHECK_THROW(requireWithin(range, outside, "clearance"), InputError);
    }
}

BOOST_AUTO_TEST_CASE(errors_name_the_value_and_what_is_allowed)
{
    const auto message = [](const Range& range, double value) {
        try {
            requireWithin(range, value, "faces");
        } catch (const InputError& error) {
            return std::string(error.what());
        }
        return std::string();
    };
    BOOST_TEST(message({12, 1000000}, 7) == "faces: 7 is not allowed; it must be 12 to 1000000");
    BOOST_TEST(message({1e-7, 0.25}, -0.5) == "faces: -0.5 is not allowed; it must be 1e-07 to 0.25");
    BOOST_TEST(message({0, 1}, std::nan("")) == "faces: nan is not allowed; it must be 0 to 1");
    BOOST_TEST(message({0, 1}, 1e300) == "faces: 1e+300 is not allowed; it must be 0 to 1");
}

BOOST_AUTO_TEST_SUITE_END()
