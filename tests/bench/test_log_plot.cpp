#include <boost/test/unit_test.hpp>

#include <cmath>

#include <tools/bench/log_plot.h>

using vdbcage::bench::fittedExponent;
using vdbcage::bench::logPlot;
using vdbcage::bench::PlotPoint;

namespace {

std::size_t countOf(const std::string& text, const std::string& part)
{
    std::size_t count = 0;
    for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++count;
    return count;
}

} // namespace

BOOST_AUTO_TEST_CASE(powers_are_found)
{
    for (const double exponent : {-1.5, 0.0, 1.0, 3.0}) {
        std::vector<PlotPoint> points;
        for (const double x : {2.0, 3.0, 50.0, 1e6}) points.push_back({x, 7 * std::pow(x, exponent)});
        BOOST_TEST(std::abs(fittedExponent(points) - exponent) < 1e-12);
    }
    // Off the line by a factor and its inverse at both ends: least squares keep the slope of the middle.
    BOOST_TEST(std::abs(fittedExponent({{1, 2}, {10, 10}, {100, 200}}) - 1) < 1e-12);
    BOOST_TEST(fittedExponent({{1, 2}}) == 0);
    BOOST_TEST(fittedExponent({}) == 0);
}

BOOST_AUTO_TEST_CASE(a_plot_has_all_points_names_and_exponents)
{
    const std::string svg = logPlot("a < b", "voxels", "seconds",
                                    {{"ours", {{1, 1}, {10, 100}}}, {"theirs", {{1, 5}}, true}, {"none", {}}});
    BOOST_TEST(countOf(svg, "<circle") == 3U + 3U); // and one each in the legend
    BOOST_TEST(countOf(svg, "<polyline") == 3U);
    BOOST_TEST(countOf(svg, "stroke-dasharray") == 1U);
    BOOST_TEST(svg.find("a &lt; b") != std::string::npos);
    BOOST_TEST(svg.find("a < b") == std::string::npos);
    BOOST_TEST(svg.find("ours: exponent 2.00") != std::string::npos);
    BOOST_TEST(svg.find("theirs:") == std::string::npos); // of one point there is none
    BOOST_TEST(svg.find("nan") == std::string::npos);
    BOOST_TEST(svg.find("inf") == std::string::npos);
}
