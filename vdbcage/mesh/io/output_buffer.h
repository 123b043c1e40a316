#pragma once

#include <charconv>
#include <cstddef>
#include <cstring>
#include <ostream>
#include <string_view>
#include <vector>

namespace vdbcage::detail {

/// A buffer of a writer's output, which goes to the stream in large pieces and without the stream's locale. flush()
/// writes the last piece.
class OutputBuffer {
public:
    explicit OutputBuffer(std::ostream& out) : out_(out), bytes_(1U << 16U) {}
    OutputBuffer(const OutputBuffer&) = delete;
    OutputBuffer& operator=(const OutputBuffer&) = delete;

    void text(std::string_view piece)
    {
        reserve(piece.size());
        std::memcpy(bytes_.data() + used_, piece.data(), piece.size());
        used_ += piece.size();
    }
    /// Writes the shortest decimal digits that read back as the same value.
    template <typename Number>
    void number(Number value)
    {
        reserve(32);
        char* first = bytes_.data() + used_;
        used_ += static_cast<std::size_t>(std::to_chars(first, first + 32, value).ptr - first);
    }
    /// Writes the value's bytes, little endian.
    template <typename Value>
    void binary(Value value)
    {
        char bytes[sizeof(Value)];
        std::memcpy(bytes, &value, sizeof(Value));
        static_assert(__BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__, "reverse the bytes here");
        text({bytes, sizeof(Value)});
    }
    void flush()
    {
        out_.write(bytes_.data(), static_cast<std::streamsize>(used_));
        used_ = 0;
    }

private:
    void reserve(std::size_t count)
    {
        if (bytes_.size() - used_ < count) flush();
        if (bytes_.size() < count) bytes_.resize(count);
    }

    std::ostream& out_;
    std::vector<char> bytes_;
    std::size_t used_ = 0;
};

} // namespace vdbcage::detail
