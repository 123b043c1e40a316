#include <boost/test/unit_test.hpp>

#include <string>

#include <support/read_png.h>
#include <support/temporary_folder.h>
#include <tools/vdbcage/picture.h>
#include <vdbcage/core/error.h>

using namespace vdbcage;
using test::readPng;
using test::TemporaryFolder;
using test::writeText;

namespace {

Picture gradient(int width, int height)
{
    Picture picture{width, height, {}};
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            for (const int value : {x * 7, y * 5, x ^ y}) picture.rgb.push_back(static_cast<std::uint8_t>(value & 255));
        }
    }
    return picture;
}

} // namespace

BOOST_AUTO_TEST_SUITE(png)

BOOST_AUTO_TEST_CASE(what_is_encoded_reads_back)
{
    const TemporaryFolder folder;
    const auto path = folder / "a.png";
    for (const auto& [width, height] : {std::pair{1, 1}, {3, 2}, {641, 7}, {200, 300}}) {
        const Picture picture = gradient(width, height);
        const std::string bytes = encodePng(picture);
        writeText(path, bytes);
        const Picture back = readPng(path);
        BOOST_TEST(back.width == width);
        BOOST_TEST(back.height == height);
        BOOST_CHECK(back.rgb == picture.rgb);
        BOOST_CHECK(encodePng(picture) == bytes);
    }
}

BOOST_AUTO_TEST_CASE(pictures_without_the_pixels_they_claim_are_refused)
{
    Picture wrong = gradient(4, 4);
    wrong.rgb.pop_back();
    BOOST_CHECK_THROW(encodePng(wrong), InputError);
    BOOST_CHECK_THROW(encodePng(Picture()), InputError);
}

BOOST_AUTO_TEST_SUITE_END()
