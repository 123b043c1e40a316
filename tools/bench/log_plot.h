#pragma once

#include <string>
#include <vector>

namespace vdbcage::bench {

/// A place in a plot. Both are above 0.
struct PlotPoint {
    double x = 0, y = 0;
};

/// Points of one kind.
struct PlotSeries {
    std::string name;
    std::vector<PlotPoint> points; ///< ascending in x
    bool isPublished = false;      ///< by others: drawn hollow and dashed
};

/// The exponent b of the y = a x^b that fits the points best: the slope of least squares between their logarithms. 0 of
/// fewer than two points.
double fittedExponent(const std::vector<PlotPoint>& points);

/// A plot with logarithmic axes as SVG, for a page of HTML. Each series of two points or more has its exponent in the
/// legend. \pre there is a point
std::string logPlot(const std::string& title, const std::string& xName, const std::string& yName,
                    const std::vector<PlotSeries>& series);

} // namespace vdbcage::bench
