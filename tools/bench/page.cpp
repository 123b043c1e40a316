#include "page.h"

#include <cstdlib>

#include <tools/report/html.h>

namespace vdbcage::bench {

namespace {

using report::htmlText;

constexpr const char* style = R"(
body { font: 15px/1.5 system-ui, sans-serif; margin: 2rem auto; max-width: 70rem; padding: 0 1rem; color: #1d2530;
       background: #fff; }
h1 { font-size: 1.6rem; margin: 0 0 1rem; }
h2 { font-size: 1.2rem; margin: 2.5rem 0 .5rem; padding-top: .75rem; border-top: 1px solid #d9dee5; }
p { max-width: 46rem; margin: .5rem 0; }
figure { margin: 1.25rem 0; }
figure img { display: block; max-width: 100%; border: 1px solid #e4e8ed; border-radius: 6px; }
figcaption, caption { color: #4c5866; font-size: .9rem; text-align: left; padding: .35rem 0; max-width: 60rem; }
caption { caption-side: top; }
.wide { overflow-x: auto; margin: 1.25rem 0; }
table { border-collapse: collapse; font-variant-numeric: tabular-nums; }
th { text-align: left; font-weight: 600; vertical-align: bottom; border-bottom: 2px solid #c5ccd6; }
th, td { padding: .25rem .9rem .25rem 0; }
td { border-bottom: 1px solid #eceff3; white-space: nowrap; }
td.number { text-align: right; }
th.number { text-align: right; }
.plots { display: grid; grid-template-columns: repeat(auto-fit, minmax(420px, 1fr)); gap: 1rem; }
svg.plot text { font: 12px system-ui, sans-serif; fill: #4c5866; }
svg.plot text.title { font-size: 14px; font-weight: 600; fill: #1d2530; }
svg.plot .grid { stroke: #e4e8ed; stroke-width: 1; }
)";

/// Also one with a unit, and a lone -, which stands for none.
bool isNumber(const std::string& cell)
{
    char* end = nullptr;
    std::strtod(cell.c_str(), &end);
    return cell == "-" || (end != cell.c_str() && (*end == ' ' || *end == '\0'));
}

} // namespace

void Page::heading(const std::string& text)
{
    body_ += "<h2>" + report::htmlText(text) + "</h2>\n";
}

void Page::paragraph(const std::string& text)
{
    body_ += "<p>" + report::htmlText(text) + "</p>\n";
}

void Page::table(const std::string& caption, const std::vector<std::string>& head,
                 const std::vector<std::vector<std::string>>& rows)
{
    const auto cell = [](const char* kind, const std::string& text, bool isRight) {
        return std::string("<") + kind + (isRight ? " class=\"number\">" : ">") + report::htmlText(text) + "</" + kind +
               ">";
    };
    body_ += "<div class=\"wide\"><table>\n<caption>" + report::htmlText(caption) + "</caption>\n<tr>";
    for (std::size_t i = 0; i < head.size(); ++i) {
        bool isRight = false;
        for (const auto& row : rows) isRight = isRight || isNumber(row[i]);
        body_ += cell("th", head[i], isRight);
    }
    body_ += "</tr>\n";
    for (const auto& row : rows) {
        body_ += "<tr>";
        for (const std::string& text : row) body_ += cell("td", text, isNumber(text));
        body_ += "</tr>\n";
    }
    body_ += "</table></div>\n";
}

void Page::picture(const std::string& png, const std::string& caption)
{
    body_ += "<figure>\n" + report::htmlPicture(png, caption) + "<figcaption>" + report::htmlText(caption) +
             "</figcaption>\n</figure>\n";
}

void Page::plots(const std::vector<std::string>& svg, const std::string& caption)
{
    body_ += "<figure>\n<div class=\"plots\">\n";
    for (const std::string& plot : svg) body_ += plot;
    body_ += "</div>\n<figcaption>" + report::htmlText(caption) + "</figcaption>\n</figure>\n";
}

std::string Page::text(const std::string& title) const
{
    return "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n<meta name=\"viewport\" "
           "content=\"width=device-width\">\n<title>" +
           report::htmlText(title) + "</title>\n<style>" + style + "</style>\n</head>\n<body>\n<h1>" +
           report::htmlText(title) + "</h1>\n" + body_ + "</body>\n</html>\n";
}

} // namespace vdbcage::bench
