#include "log_plot.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>

#include <tools/report/html.h>

namespace vdbcage::bench {

namespace {

// Pixels.
constexpr double width = 520, height = 330, left = 62, right = 14, top = 34, bottom = 58;
constexpr std::array<const char*, 6> colours{"#2456a6", "#c2571a", "#2e7d4f", "#8e3b8f", "#8a6d00", "#4c5866"};

/// As snprintf writes it, whatever its length.
template <typename... Values>
std::string printed(const char* format, Values... values)
{
    const int size = std::snprintf(nullptr, 0, format, values...);
    std::string text(static_cast<std::size_t>(size) + 1, ' ');
    std::snprintf(text.data(), text.size(), format, values...);
    text.pop_back();
    return text;
}

/// An axis from a power of ten to another.
struct Axis {
    double low = 0, high = 1; ///< logarithms
    double from = 0, to = 1;  ///< pixels

    double place(double value) const { return from + (to - from) * (std::log10(value) - low) / (high - low); }
};

/// The values 1, 2 and 5 times powers of ten, or powers alone where these are many.
std::vector<double> marksOf(const Axis& axis)
{
    std::vector<double> marks;
    const bool isShort = axis.high - axis.low <= 3;
    for (double power = std::floor(axis.low); power <= axis.high; ++power) {
        for (const double digit : {1.0, 2.0, 5.0}) {
            const double value = digit * std::pow(10, power), log = std::log10(value);
            if ((digit == 1 || isShort) && log >= axis.low - 1e-9 && log <= axis.high + 1e-9) marks.push_back(value);
        }
    }
    return marks;
}

std::string numberOf(double value)
{
    if (value >= 1e6) return printed("%gM", value / 1e6);
    if (value >= 1e4) return printed("%gk", value / 1e3);
    return printed("%g", value);
}

/// A little wider than the values.
Axis axisOf(const std::vector<PlotSeries>& series, double PlotPoint::*value, double from, double to)
{
    double low = std::numeric_limits<double>::infinity(), high = -low;
    for (const PlotSeries& one : series) {
        for (const PlotPoint& point : one.points) {
            low = std::min(low, std::log10(point.*value));
            high = std::max(high, std::log10(point.*value));
        }
    }
    const double margin = std::max(0.1, 0.05 * (high - low));
    return {low - margin, high + margin, from, to};
}

std::string markOf(double x, double y, const char* colour, bool isHollow)
{
    return printed(R"(<circle cx="%.1f" cy="%.1f" r="3.5" fill="%s" stroke="%s" stroke-width="1.5"/>)", x, y,
                   isHollow ? "#fff" : colour, colour);
}

} // namespace

double fittedExponent(const std::vector<PlotPoint>& points)
{
    if (points.size() < 2) return 0;
    double x = 0, y = 0, xx = 0, xy = 0;
    const auto count = static_cast<double>(points.size());
    for (const PlotPoint& point : points) {
        const double u = std::log(point.x), v = std::log(point.y);
        x += u / count;
        y += v / count;
        xx += u * u / count;
        xy += u * v / count;
    }
    return (xy - x * y) / (xx - x * x);
}

std::string logPlot(const std::string& title, const std::string& xName, const std::string& yName,
                    const std::vector<PlotSeries>& series)
{
    constexpr double line = 18, floor = height - bottom;
    const Axis across = axisOf(series, &PlotPoint::x, left, width - right);
    const Axis up = axisOf(series, &PlotPoint::y, floor, top);
    std::string svg = printed(R"(<svg class="plot" viewBox="0 0 %g %g" role="img" aria-label="%s">)", width,
                              height + line * static_cast<double>(series.size()), report::htmlText(title).c_str());
    svg += printed(R"(<text x="%g" y="18" class="title">%s</text>)", left, report::htmlText(title).c_str());
    for (const double mark : marksOf(across)) {
        const double x = across.place(mark);
        svg += printed(R"(<line x1="%.1f" y1="%g" x2="%.1f" y2="%g" class="grid"/>)", x, top, x, floor);
        svg +=
            printed(R"(<text x="%.1f" y="%g" text-anchor="middle">%s</text>)", x, floor + 16, numberOf(mark).c_str());
    }
    for (const double mark : marksOf(up)) {
        const double y = up.place(mark);
        svg += printed(R"(<line x1="%g" y1="%.1f" x2="%g" y2="%.1f" class="grid"/>)", left, y, width - right, y);
        svg += printed(R"(<text x="%g" y="%.1f" text-anchor="end">%s</text>)", left - 6, y + 4, numberOf(mark).c_str());
    }
    svg += printed(R"(<text x="%g" y="%g" text-anchor="middle">%s</text>)", (left + width - right) / 2, floor + 36,
                   report::htmlText(xName).c_str());
    svg += printed(R"-(<text transform="translate(14 %g) rotate(-90)" text-anchor="middle">%s</text>)-",
                   (top + floor) / 2, report::htmlText(yName).c_str());
    for (std::size_t i = 0; i < series.size(); ++i) {
        const PlotSeries& one = series[i];
        const char* colour = colours[i % colours.size()];
        std::string path;
        for (const PlotPoint& point : one.points) {
            path += printed("%.1f,%.1f ", across.place(point.x), up.place(point.y));
        }
        svg += printed(R"(<polyline points="%s" fill="none" stroke="%s" stroke-width="1.8"%s/>)", path.c_str(), colour,
                       one.isPublished ? R"( stroke-dasharray="5 4")" : "");
        for (const PlotPoint& point : one.points) {
            svg += markOf(across.place(point.x), up.place(point.y), colour, one.isPublished);
        }
        const double y = height + line * static_cast<double>(i);
        svg += markOf(left, y - 4, colour, one.isPublished);
        std::string text = one.name;
        if (one.points.size() > 1) text += printed(": exponent %.2f", fittedExponent(one.points));
        svg += printed(R"(<text x="%g" y="%g">%s</text>)", left + 12, y, report::htmlText(text).c_str());
    }
    return svg + "</svg>\n";
}

} // namespace vdbcage::bench
