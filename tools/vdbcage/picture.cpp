#include <tools/vdbcage/picture.h>

#include <string>

#include <png.h>
#include <vdbcage/core/error.h>

namespace vdbcage {

std::string encodePng(const Picture& picture)
{
    if (picture.width < 1 || picture.height < 1 ||
        picture.rgb.size() != 3 * static_cast<std::size_t>(picture.width) * static_cast<std::size_t>(picture.height)) {
        throw InputError("picture: it has " + std::to_string(picture.width) + " x " + std::to_string(picture.height) +
                         " pixels and " + std::to_string(picture.rgb.size()) + " bytes; 3 bytes a pixel are needed");
    }
    // libpng's simplified interface: it reports errors by its result, not by longjmp.
    png_image image{};
    image.version = PNG_IMAGE_VERSION;
    image.width = static_cast<png_uint_32>(picture.width);
    image.height = static_cast<png_uint_32>(picture.height);
    image.format = PNG_FORMAT_RGB;
    png_alloc_size_t size = PNG_IMAGE_PNG_SIZE_MAX(image);
    std::string bytes(size, '\0');
    if (png_image_write_to_memory(&image, bytes.data(), &size, 0, picture.rgb.data(), 0, nullptr) == 0) {
        throw Error(std::string("picture: cannot be written as PNG: ") + image.message);
    }
    bytes.resize(size);
    return bytes;
}

} // namespace vdbcage
