#include <boost/test/unit_test.hpp>

#include <string>

#include <support/read_png.h>
#include <support/temporary_folder.h>
#include <tools/vdbcage/picture.h>
#include <vdbcage/core/error.h>

using namespace vdbcage;
using test::readPng;
using test::readText;
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

BOOST_AUTO_TEST_CASE(what_is_written_reads_back)
{
    const TemporaryFolder folder;
    const auto path = folder / "a.png";
    for (const auto& [width, height] : {std::pair{1, 1}, {3, 2}, {641, 7}, {200, 300}}) {
        const Picture picture = gradient(width, height);
        writePng(picture, path);
        const Picture back = readPng(path);
        BOOST_TEST(back.width == width);
        BOOST_TEST(back.height == height);
        BOOST_CHECK(back.rgb == picture.rgb);
        const std::string bytes = readText(path);
        writePng(picture, path);
        BOOST_CHECK(readText(path) == bytes);
    }
    BOOST_TEST(folder.entries() == 1U);
}

BOOST_AUTO_TEST_CASE(failure_leaves_what_was_there)
{
    const TemporaryFolder folder;
    writeText(folder / "a.png", "old");
    Picture wrong = gradient(4, 4);
    wrong.rgb.pop_back();
    BOOST_CHECK_THROW(writePng(wrong, folder / "a.png"), InputError);
    BOOST_CHECK_THROW(writePng(Picture(), folder / "a.png"), InputError);
    BOOST_TEST(readText(folder / "a.png") == "old");
    BOOST_CHECK_EXCEPTION(writePng(gradient(4, 4), folder / "no/a.png"), IoError, [&](const IoError& error) {
        return std::string(error.what()).rfind((folder / "no/a.png").string(), 0) == 0;
    });
    BOOST_TEST(folder.entries() == 1U);
}

BOOST_AUTO_TEST_SUITE_END()
