// Based on: The Unicode Standard 15, table 3-7 (well-formed UTF-8).

#include <vdbcage/core/detail/printable.h>

#include <cstddef>
#include <cstdint>

namespace vdbcage::detail {

namespace {

/// Finds the well-formed character that `text` begins with: returns the number of its bytes, 0 if there is none, and
/// sets its code.
std::size_t decode(std::string_view text, std::uint32_t& code)
{
    const auto byte = [&](std::size_t i) { return std::uint32_t{static_cast<unsigned char>(text[i])}; };
    const std::uint32_t first = byte(0);
    const std::size_t size = first < 0x80   ? 1
                             : first < 0xC2 ? 0
                             : first < 0xE0 ? 2
                             : first < 0xF0 ? 3
                             : first < 0xF5 ? 4
                                            : 0;
    if (size == 0 || size > text.size()) return 0;
    code = size == 1 ? first : first & (0x7FU >> size);
    for (std::size_t i = 1; i < size; ++i) {
        if ((byte(i) & 0xC0U) != 0x80U) return 0;
        code = code << 6U | (byte(i) & 0x3FU);
    }
    const bool isOverlong = (size == 3 && code < 0x800) || (size == 4 && code < 0x10000);
    const bool isSurrogate = code >= 0xD800 && code <= 0xDFFF;
    return isOverlong || isSurrogate || code > 0x10FFFF ? 0 : size;
}

bool isControl(std::uint32_t code)
{
    return code < 0x20 || (code >= 0x7F && code <= 0x9F) || // C0, DEL, C1
           code == 0x2028 || code == 0x2029 ||              // line and paragraph separator
           code == 0x200E || code == 0x200F || code == 0x061C || (code >= 0x202A && code <= 0x202E) ||
           (code >= 0x2066 && code <= 0x2069) || code == 0xFEFF; // direction of writing, byte order mark
}

} // namespace

std::string printable(std::string_view text)
{
    constexpr const char* digits = "0123456789abcdef";
    std::string line;
    line.reserve(text.size());
    while (!text.empty()) {
        std::uint32_t code = 0;
        std::size_t size = decode(text, code);
        if (size > 0 && !isControl(code)) {
            line += text.substr(0, size);
        } else if (text[0] == '\n' || text[0] == '\r' || text[0] == '\t') {
            line += text[0] == '\n' ? "\\n" : text[0] == '\r' ? "\\r" : "\\t";
        } else {
            size = size == 0 ? 1 : size;
            for (const char c : text.substr(0, size)) {
                const auto byte = static_cast<unsigned char>(c);
                line += {'\\', 'x', digits[byte >> 4U], digits[byte & 15U]};
            }
        }
        text.remove_prefix(size);
    }
    return line;
}

} // namespace vdbcage::detail
