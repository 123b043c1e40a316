#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include <openvdb/Types.h>
#include <support/temporary_folder.h>

/// What fuzz targets make of the bytes that they are called with.
namespace vdbcage::fuzz {

/// A finding, unless it holds.
inline void require(bool holds)
{
    if (!holds) std::abort();
}

/// Messages of errors are for a terminal.
inline void requireOneLine(std::string_view message)
{
    require(!message.empty() && message.find('\n') == std::string_view::npos);
}

inline std::string textOf(const std::uint8_t* data, std::size_t size)
{
    return {reinterpret_cast<const char*>(data), size};
}

/// The folder for files that a target reads; it is there as long as the process.
inline std::filesystem::path folder()
{
    static const test::TemporaryFolder own;
    return own.path();
}

/// A file of that name and content in folder().
inline std::filesystem::path file(const std::string& name, const std::string& bytes)
{
    const std::filesystem::path path = folder() / name;
    test::writeText(path, bytes);
    return path;
}

/// What the bytes ask for; zero behind their end. Ask once in an expression: the order within one is the compiler's.
class Choices {
public:
    Choices(const std::uint8_t* data, std::size_t size) : data_(data), size_(size) {}

    bool isAtEnd() const { return at_ >= size_; }
    /// At most 256.
    int below(int count) { return byte() % count; }
    bool oneIn(int count) { return below(count) == 0; }
    int between(int least, int most) { return least + below(most - least + 1); }
    double share() { return any<std::uint16_t>() / 65535.0; }
    double between(double least, double most) { return least + share() * (most - least); }
    /// Around 0, of any magnitude from 1e-16 on.
    double small()
    {
        const double part = share() - 0.5;
        return part * std::pow(10.0, -below(17));
    }
    openvdb::Vec3d direction()
    {
        return {2 * share() - 1, 2 * share() - 1, 2 * share() - 1}; // within braces there is an order
    }
    /// Any value that so many bytes can stand for: of floating point also infinities and what is not a number.
    template <typename Number>
    Number any()
    {
        Number number{}; // at the end the rest of it is zero
        const std::size_t count = std::min(sizeof(Number), size_ - at_);
        if (count > 0) std::memcpy(&number, data_ + at_, count);
        at_ += count;
        return number;
    }
    template <typename Item>
    Item& of(std::vector<Item>& list)
    {
        return list[any<std::uint16_t>() % list.size()];
    }

private:
    int byte() { return at_ < size_ ? data_[at_++] : 0; }

    const std::uint8_t* data_;
    std::size_t size_, at_ = 0;
};

} // namespace vdbcage::fuzz
