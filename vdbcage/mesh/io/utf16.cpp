#include <vdbcage/mesh/io/utf16.h>

#include <cstdint>

#include <vdbcage/core/error.h>

namespace vdbcage::detail {

namespace {

void append(std::uint32_t character, std::string& text)
{
    const auto last = [&](unsigned shift) { text += static_cast<char>(0x80U | (character >> shift & 0x3FU)); };
    if (character < 0x80) {
        text += static_cast<char>(character);
    } else if (character < 0x800) {
        text += static_cast<char>(0xC0U | character >> 6U);
        last(0);
    } else if (character < 0x10000) {
        text += static_cast<char>(0xE0U | character >> 12U);
        last(6);
        last(0);
    } else {
        text += static_cast<char>(0xF0U | character >> 18U);
        last(12);
        last(6);
        last(0);
    }
}

} // namespace

std::string_view asUtf8(std::string_view bytes, const std::string& name, std::string& storage, Warnings& warnings)
{
    const std::string_view mark = bytes.substr(0, 2);
    const bool isLittleEndian = mark == "\xFF\xFE";
    if (!isLittleEndian && mark != "\xFE\xFF") return bytes;
    if (bytes.size() % 2 != 0) {
        throw IoError(name + ": byte " + std::to_string(bytes.size() - 1) +
                      ": the file ends within a character of UTF-16; copy or export it again");
    }
    const auto unit = [&](std::size_t at) -> std::uint32_t {
        const auto first = static_cast<unsigned char>(bytes[at]), second = static_cast<unsigned char>(bytes[at + 1]);
        return isLittleEndian ? first | unsigned(second) << 8U : unsigned(first) << 8U | second;
    };
    const auto isHighHalf = [](std::uint32_t u) { return u >= 0xD800 && u < 0xDC00; };
    const auto isLowHalf = [](std::uint32_t u) { return u >= 0xDC00 && u < 0xE000; };
    storage.clear();
    storage.reserve(bytes.size() / 2);
    for (std::size_t at = 2; at < bytes.size(); at += 2) {
        std::uint32_t character = unit(at);
        if (isHighHalf(character) && at + 2 < bytes.size() && isLowHalf(unit(at + 2))) {
            at += 2;
            character = 0x10000 + ((character - 0xD800) << 10U) + (unit(at) - 0xDC00);
        } else if (isHighHalf(character) || isLowHalf(character)) {
            character = 0xFFFD;
        }
        append(character, storage);
    }
    warnings.add("the text is UTF-16; it is read as if it were UTF-8", 1);
    return storage;
}

} // namespace vdbcage::detail
