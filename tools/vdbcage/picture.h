#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace vdbcage {

/// An sRGB picture of 8 bits a channel.
struct Picture {
    int width = 0;                 ///< pixels
    int height = 0;                ///< pixels
    std::vector<std::uint8_t> rgb; ///< width * height * 3 bytes, row by row from the top left
};

/// `picture` as the bytes of a PNG file; the same picture gives the same bytes.
/// \throw InputError if the picture's size is not positive or not that of its bytes
std::string encodePng(const Picture& picture);

} // namespace vdbcage
