#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include <vdbcage/core/error.h>

namespace vdbcage::detail {

/// The place of a value in a file. A fuzzer changes values to get past the checks.
struct ByteField {
    std::size_t position, size;
};

/// A reader of values from the bytes of a file, one after the other. It never reads beyond their end. Values are
/// little-endian, as on this machine.
class ByteCursor {
public:
    /// \param name  of the file, for messages
    /// \param fields  if not null, gets the place of every value that is read
    ByteCursor(std::string_view bytes, const std::string& name, std::vector<ByteField>* fields = nullptr)
        : bytes_(bytes), name_(&name), fields_(fields), fileSize_(bytes.size())
    {
    }

    /// Returns a cursor in the part of the file from `begin` to `end`.
    ByteCursor part(std::size_t begin, std::size_t end) const
    {
        ByteCursor result = *this;
        result.bytes_ = bytes_.substr(0, end);
        result.position_ = begin;
        return result;
    }

    std::size_t position() const { return position_; }
    std::size_t left() const { return bytes_.size() - position_; }

    /// Reads the next `count` bytes.
    /// \throw IoError there are fewer; so do all functions below that read
    std::string_view take(std::size_t count)
    {
        if (count > left()) {
            if (bytes_.size() == fileSize_) refuse("is not a .vdb file, or is truncated");
            damaged("a grid extends beyond its end");
        }
        if (fields_ && count > 0) fields_->push_back({position_, count});
        const std::string_view result = bytes_.substr(position_, count);
        position_ += count;
        return result;
    }

    /// Returns the bytes that were read from `begin` on.
    std::string_view since(std::size_t begin) const { return bytes_.substr(begin, position_ - begin); }

    /// Reads the next value, which may have any bits.
    template <class Value>
    Value value()
    {
        static_assert(std::is_trivially_copyable_v<Value> && !std::is_same_v<Value, bool>);
        Value result;
        std::memcpy(&result, take(sizeof(Value)).data(), sizeof(Value));
        return result;
    }

    bool flag(const char* what)
    {
        const auto byte = value<std::uint8_t>();
        if (byte > 1) damaged(std::string(what) + " is " + std::to_string(byte) + ", neither 0 nor 1");
        return byte == 1;
    }

    /// Reads a string: its length in 32 bits, then its characters.
    std::string_view string() { return take(value<std::uint32_t>()); }

    /// \throw IoError always, with the position after the last value read
    [[noreturn]] void damaged(const std::string& what) const
    {
        refuse("is damaged: " + what + " (at byte " + std::to_string(position_) + ")");
    }
    [[noreturn]] void refuse(const std::string& what) const { throw IoError(*name_ + ": " + what); }

private:
    std::string_view bytes_;
    const std::string* name_;
    std::vector<ByteField>* fields_;
    std::size_t fileSize_, position_ = 0;
};

} // namespace vdbcage::detail
