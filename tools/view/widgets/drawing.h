#pragma once

#include <array>
#include <cstdint>
#include <vector>

namespace vdbcage::view {

/// The picture of the widgets: triangles, in the order in which they are drawn. A value that can be compared.
struct Drawing {
    struct Vertex {
        float x, y;                       ///< pixels from the top left
        float u, v;                       ///< in the texture, from its first row
        std::array<std::uint8_t, 4> rgba; ///< sRGB, not multiplied by alpha
    };
    /// Triangles of one texture, clipped to one rectangle.
    struct Batch {
        int left, top, right, bottom; ///< pixels from the top left
        std::uint32_t texture;        ///< OpenGL's name; 0: the glyphs
        std::uint32_t firstIndex, indexCount;
    };

    int width = 0, height = 0; ///< pixels
    std::vector<Vertex> vertices;
    std::vector<std::uint32_t> indices; ///< three per triangle
    std::vector<Batch> batches;
};

bool operator==(const Drawing& a, const Drawing& b);
bool operator!=(const Drawing& a, const Drawing& b);

/// The picture of all glyphs, which vertices refer to.
struct Glyphs {
    int width = 0, height = 0;          ///< pixels
    std::vector<std::uint8_t> coverage; ///< width * height bytes from the top left; 255: all of the pixel
};

} // namespace vdbcage::view
