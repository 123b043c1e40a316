#include <tools/report/html.h>

#include <vdbcage/core/detail/printable.h>

namespace vdbcage::report {

namespace {

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

} // namespace

std::string htmlText(const std::string& text)
{
    std::string result;
    for (const char c : detail::printable(text)) {
        result += c == '&' ? "&amp;" : c == '<' ? "&lt;" : c == '>' ? "&gt;" : c == '"' ? "&quot;" : std::string(1, c);
    }
    return result;
}

std::string htmlPicture(const std::string& png, const std::string& description)
{
    return "<img alt=\"" + htmlText(description) + "\" src=\"data:image/png;base64," + base64(png) + "\">\n";
}

} // namespace vdbcage::report
