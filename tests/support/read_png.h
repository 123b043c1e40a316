#pragma once

#include <filesystem>
#include <stdexcept>

#include <png.h>
#include <tools/draw/picture.h>

namespace vdbcage::test {

/// Reads a PNG file as a draw::Picture. \throw std::runtime_error it is not RGB
inline draw::Picture readPng(const std::filesystem::path& path)
{
    png_image image{};
    image.version = PNG_IMAGE_VERSION;
    draw::Picture picture;
    if (png_image_begin_read_from_file(&image, path.c_str()) != 0 && image.format == PNG_FORMAT_RGB) {
        picture = {static_cast<int>(image.width), static_cast<int>(image.height),
                   std::vector<std::uint8_t>(PNG_IMAGE_SIZE(image))};
        if (png_image_finish_read(&image, nullptr, picture.rgb.data(), 0, nullptr) != 0) return picture;
    }
    throw std::runtime_error(path.string() + " is not an RGB picture: " + image.message);
}

} // namespace vdbcage::test
