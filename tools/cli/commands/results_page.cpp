#include <tools/cli/commands/results_page.h>

#include <array>
#include <cstdio>
#include <filesystem>

#include <tools/draw/picture.h>
#include <vdbcage/core/detail/printable.h>
#include <vdbcage/core/detail/read_file.h>

namespace vdbcage::cli {

namespace {

constexpr int thumbnailWidth = 320;

constexpr const char* head = R"(<!DOCTYPE html>
<html lang="en">
<head>
<meta charset="utf-8">
<title>Cages of vdbcage</title>
<style>
body { font: 15px/1.45 system-ui, sans-serif; margin: 2rem auto; max-width: 72rem; padding: 0 1rem; color: #1d2530;
       background: #f6f7f9; }
h1 { font-size: 1.4rem; margin: 0 0 .25rem; }
p { margin: 0 0 1.25rem; color: #4c5866; }
.jobs { display: grid; grid-template-columns: repeat(auto-fill, minmax(260px, 1fr)); gap: 1rem; }
.job { background: #fff; border: 1px solid #d9dee5; border-radius: 8px; padding: .75rem; overflow-wrap: anywhere; }
.job img { display: block; width: 100%; border-radius: 4px; margin-bottom: .5rem; }
.job h2 { font-size: 1rem; margin: 0 0 .25rem; }
.job.bad { border-color: #c43b2f; background: #fdf3f2; }
.verdict { font-weight: 600; color: #1f7a45; }
.bad .verdict { color: #b02a1f; }
table { border-collapse: collapse; width: 100%; margin-top: .25rem; }
td { padding: .1rem 0; color: #4c5866; }
td + td { text-align: right; color: #1d2530; font-variant-numeric: tabular-nums; }
</style>
</head>
<body>
)";

std::string base64(const std::string& bytes)
{
    constexpr const char* digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        const auto byte = [&](std::size_t k) {
            return i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0U;
        };
        const unsigned group = byte(0) << 16U | byte(1) << 8U | byte(2);
        for (unsigned k = 0; k < 4; ++k) {
            text += i + k > bytes.size() ? '=' : digits[group >> (18 - 6 * k) & 63U];
        }
    }
    return text;
}

std::string htmlText(const std::string& text)
{
    std::string result;
    for (const char c : detail::printable(text)) {
        result += c == '&' ? "&amp;" : c == '<' ? "&lt;" : c == '>' ? "&gt;" : c == '"' ? "&quot;" : std::string(1, c);
    }
    return result;
}

std::string thumbnailOf(const report::JobResult& result)
{
    std::filesystem::path file = result.report;
    file.replace_extension(".png");
    std::error_code ignored;
    if (!std::filesystem::is_regular_file(file, ignored)) return "";
    const draw::Picture picture = draw::decodePng(detail::readFile(file), file.string());
    return "<img alt=\"" + htmlText(result.report.stem().string()) + " with its cage\" src=\"data:image/png;base64," +
           base64(draw::encodePng(draw::smaller(picture, thumbnailWidth))) + "\">\n";
}

std::string row(const char* what, const char* format, double value)
{
    std::array<char, 64> number{};
    std::snprintf(number.data(), number.size(), format, value);
    return std::string("<tr><td>") + what + "</td><td>" + number.data() + "</td></tr>\n";
}

} // namespace

std::string pageOf(const std::vector<report::JobResult>& results)
{
    std::string text = std::string(head) + "<h1>Cages of vdbcage</h1>\n<p>" + htmlText(report::sumOf(results)) +
                       "; failures first, then the loosest. Distances are parts of the models' longest "
                       "sides.</p>\n<div class=\"jobs\">\n";
    for (const report::JobResult& r : results) {
        text += std::string("<div class=\"job") + (r.isBounding ? "" : " bad") + "\">\n" +
                (r.status == 0 ? thumbnailOf(r) : "") + "<h2>" + htmlText(r.report.stem().string()) +
                "</h2>\n<div class=\"verdict\">" +
                (r.status != 0  ? "failed with status " + std::to_string(r.status)
                 : r.isBounding ? "certified"
                                : "not bounding") +
                "</div>\n";
        if (r.status != 0) {
            text += "<div>" + htmlText(r.error) + "</div>\n";
        } else {
            text += "<table>\n" + row("Faces", "%.0f", static_cast<double>(r.triangles + r.quads)) +
                    row("Quads", "%.0f", static_cast<double>(r.quads)) +
                    row("Mean distance", "%.2f %%", 100 * r.meanDistance) +
                    row("Largest distance", "%.2f %%", 100 * r.maxDistance) +
                    (r.volumeRatio > 0 ? row("Volume, of the model's", "%.2f", r.volumeRatio) : "") +
                    row("Seconds", "%.1f", r.seconds) + row("Memory", "%.0f MiB", r.memoryMib) + "</table>\n";
        }
        text += "</div>\n";
    }
    return text + "</div>\n</body>\n</html>\n";
}

} // namespace vdbcage::cli
