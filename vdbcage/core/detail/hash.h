#pragma once

#include <array>
#include <cstdint>
#include <cstdio>
#include <string>
#include <string_view>

namespace vdbcage::detail {

/// FNV-1a of 64 bits, to tell contents apart where nobody tries to make collisions.
class Hash {
public:
    void add(std::string_view bytes)
    {
        for (const char byte : bytes) value_ = (value_ ^ static_cast<unsigned char>(byte)) * 0x100000001b3U;
    }

    std::uint64_t value() const { return value_; }
    /// Returns the value in 16 hexadecimal digits.
    std::string digits() const
    {
        std::array<char, 17> text{};
        std::snprintf(text.data(), text.size(), "%016llx", static_cast<unsigned long long>(value_));
        return text.data();
    }

private:
    std::uint64_t value_ = 0xcbf29ce484222325U;
};

} // namespace vdbcage::detail
