#pragma once

#include <cstddef>
#include <cstring>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <openvdb/Types.h>
#include <openvdb/math/Vec3.h>

namespace vdbcage::detail {

/// Returns whether these are the same number to the last bit, so that 0 and -0 differ.
inline bool sameBits(double a, double b)
{
    return std::memcmp(&a, &b, sizeof(double)) == 0;
}

inline bool sameBits(const openvdb::Vec3d& a, const openvdb::Vec3d& b)
{
    return sameBits(a.x(), b.x()) && sameBits(a.y(), b.y()) && sameBits(a.z(), b.z());
}

/// The bytes of a file with other positions of its points. The parser that reads the file replaces each number as it
/// reads it, so that no other number can be taken for it.
class MovedBytes {
public:
    /// `bytes` and `points`, which are the new positions, must outlive it.
    MovedBytes(std::string_view bytes, const std::vector<openvdb::Vec3d>& points)
        : points_(points), at_(bytes.data()), end_(bytes.data() + bytes.size())
    {
        moved_.reserve(bytes.size() + bytes.size() / 4);
    }

    const openvdb::Vec3d& point(std::size_t i) const { return points_[i]; }

    /// Replaces a piece of the bytes.
    /// \pre it comes behind those that were replaced before
    void replace(std::string_view piece, std::string_view by)
    {
        moved_.append(at_, piece.data());
        moved_ += by;
        at_ = piece.data() + piece.size();
    }
    /// Returns all bytes. It is called once, at the end.
    std::string finish()
    {
        moved_.append(at_, end_);
        return std::move(moved_);
    }

private:
    const std::vector<openvdb::Vec3d>& points_;
    std::string moved_;
    const char *at_, *end_; // the rest of the bytes
};

} // namespace vdbcage::detail
