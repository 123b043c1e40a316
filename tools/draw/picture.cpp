#include <tools/draw/picture.h>

#include <algorithm>
#include <string>

#include <png.h>
#include <vdbcage/core/error.h>

namespace vdbcage::draw {

namespace {

std::vector<std::uint8_t> interleaved(const Picture& picture)
{
    std::vector<std::uint8_t> rgba;
    rgba.reserve(4 * picture.alpha.size());
    for (std::size_t i = 0; i < picture.alpha.size(); ++i) {
        for (std::size_t channel = 0; channel < 3; ++channel) rgba.push_back(picture.rgb[3 * i + channel]);
        rgba.push_back(picture.alpha[i]);
    }
    return rgba;
}

} // namespace

Picture fromPixels(const std::vector<std::uint8_t>& rgba, int width, int height, bool transparent)
{
    Picture picture;
    picture.width = width;
    picture.height = height;
    const auto columns = static_cast<std::size_t>(width);
    const auto rows = static_cast<std::size_t>(height);
    picture.rgb.reserve(3 * columns * rows);
    for (std::size_t row = rows; row-- > 0;) { // OpenGL counts upwards
        for (std::size_t i = columns * row; i < columns * (row + 1); ++i) {
            const unsigned alpha = transparent ? rgba[4 * i + 3] : 255;
            for (std::size_t channel = 0; channel < 3; ++channel) {
                const unsigned value = rgba[4 * i + channel];
                const unsigned own = alpha == 0 ? 0 : std::min(255U, (255 * value + alpha / 2) / alpha);
                picture.rgb.push_back(static_cast<std::uint8_t>(own));
            }
            if (transparent) picture.alpha.push_back(static_cast<std::uint8_t>(alpha));
        }
    }
    return picture;
}

std::string encodePng(const Picture& picture)
{
    const std::size_t pixels =
        static_cast<std::size_t>(std::max(picture.width, 0)) * static_cast<std::size_t>(std::max(picture.height, 0));
    if (pixels == 0 || picture.rgb.size() != 3 * pixels) {
        throw InputError("picture", "it has " + std::to_string(picture.width) + " x " + std::to_string(picture.height) +
                                        " pixels and " + std::to_string(picture.rgb.size()) +
                                        " bytes; 3 bytes a pixel are needed");
    }
    if (!picture.alpha.empty() && picture.alpha.size() != pixels) {
        throw InputError("picture", "it has " + std::to_string(pixels) + " pixels and alpha for " +
                                        std::to_string(picture.alpha.size()) + "; all or none is needed");
    }
    // libpng's simplified interface: it reports errors by its result, not by longjmp.
    png_image image{};
    image.version = PNG_IMAGE_VERSION;
    image.width = static_cast<png_uint_32>(picture.width);
    image.height = static_cast<png_uint_32>(picture.height);
    image.format = picture.alpha.empty() ? PNG_FORMAT_RGB : PNG_FORMAT_RGBA;
    const std::vector<std::uint8_t> rgba = interleaved(picture);
    const std::vector<std::uint8_t>& values = picture.alpha.empty() ? picture.rgb : rgba;
    png_alloc_size_t size = PNG_IMAGE_PNG_SIZE_MAX(image);
    std::string bytes(size, '\0');
    if (png_image_write_to_memory(&image, bytes.data(), &size, 0, values.data(), 0, nullptr) == 0) {
        throw Error(std::string("picture: cannot be written as PNG: ") + image.message);
    }
    bytes.resize(size);
    return bytes;
}

Picture decodePng(const std::string& bytes, const std::string& name)
{
    constexpr std::size_t mostPixels = std::size_t(1) << 26U; // small files can claim any size
    png_image image{};
    image.version = PNG_IMAGE_VERSION;
    const auto throwProblem = [&] { throw IoError(name + ": it is no PNG picture: " + image.message); };
    if (png_image_begin_read_from_memory(&image, bytes.data(), bytes.size()) == 0) throwProblem();
    if (std::size_t(image.width) * image.height > mostPixels) {
        png_image_free(&image);
        throw IoError(name + ": it is no PNG picture: it has " + std::to_string(image.width) + " x " +
                      std::to_string(image.height) + " pixels");
    }
    image.format = PNG_FORMAT_RGB;
    Picture picture{static_cast<int>(image.width), static_cast<int>(image.height),
                    std::vector<std::uint8_t>(PNG_IMAGE_SIZE(image))};
    const png_color white{255, 255, 255};
    if (png_image_finish_read(&image, &white, picture.rgb.data(), 0, nullptr) == 0) throwProblem();
    return picture;
}

Picture smaller(const Picture& picture, int width)
{
    if (picture.width <= width) return {picture.width, picture.height, picture.rgb};
    const auto from = static_cast<std::size_t>(picture.width), rows = static_cast<std::size_t>(picture.height);
    const auto to = static_cast<std::size_t>(width), toRows = std::max<std::size_t>(1, rows * to / from);
    Picture small{width, static_cast<int>(toRows), {}};
    small.rgb.reserve(3 * to * toRows);
    for (std::size_t y = 0; y < toRows; ++y) {
        const std::size_t top = y * rows / toRows, bottom = std::max(top + 1, (y + 1) * rows / toRows);
        for (std::size_t x = 0; x < to; ++x) {
            const std::size_t left = x * from / to, right = std::max(left + 1, (x + 1) * from / to);
            const std::size_t count = (bottom - top) * (right - left);
            for (std::size_t channel = 0; channel < 3; ++channel) {
                std::size_t sum = count / 2;
                for (std::size_t j = top; j < bottom; ++j) {
                    for (std::size_t i = left; i < right; ++i) sum += picture.rgb[3 * (j * from + i) + channel];
                }
                small.rgb.push_back(static_cast<std::uint8_t>(sum / count));
            }
        }
    }
    return small;
}

} // namespace vdbcage::draw
