#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace vdbcage::draw {

/// An sRGB picture of 8 bits a channel.
struct Picture {
    int width = 0;                 ///< pixels
    int height = 0;                ///< pixels
    std::vector<std::uint8_t> rgb; ///< width * height * 3 bytes, row by row from the top left
    /// width * height bytes in the same order, 255 where the colour covers all; empty: 255 everywhere.
    std::vector<std::uint8_t> alpha = {};
};

/// Makes a picture of pixels that OpenGL read: `rgba` has width * height * 4 bytes, row by row from the bottom left,
/// its colours multiplied by their alpha. `transparent` keeps alpha; else it counts as 255.
/// \pre rgba has that size
Picture fromPixels(const std::vector<std::uint8_t>& rgba, int width, int height, bool transparent);

/// Returns the bytes of a PNG file of `picture`; the same picture makes the same bytes.
/// \throw InputError if the picture's size is not positive or not that of its bytes
std::string encodePng(const Picture& picture);

/// Returns the colours of a PNG file, over white. `name` is that of the file.
/// \throw IoError naming it: `bytes` are no PNG
Picture decodePng(const std::string& bytes, const std::string& name);

/// Returns the picture at most `width` pixels wide, of the same shape: each pixel is the mean of those it replaces.
/// Without alpha.
/// \pre width is at least 1
Picture smaller(const Picture& picture, int width);

} // namespace vdbcage::draw
