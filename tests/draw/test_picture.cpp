#include <boost/test/unit_test.hpp>

#include <algorithm>
#include <string>

#include <support/read_png.h>
#include <support/temporary_folder.h>
#include <tools/draw/picture.h>
#include <vdbcage/core/error.h>

using namespace vdbcage;
using namespace vdbcage::draw;
using test::readPng;
using test::TemporaryFolder;
using test::writeText;

namespace {

Picture gradient(int width, int height)
{
    Picture picture;
    picture.width = width;
    picture.height = height;
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

BOOST_AUTO_TEST_CASE(what_is_encoded_is_decoded)
{
    const Picture picture = gradient(31, 17);
    const std::string bytes = encodePng(picture);
    const Picture back = decodePng(bytes, "a.png");
    BOOST_TEST(back.width == 31);
    BOOST_TEST(back.height == 17);
    BOOST_CHECK(back.rgb == picture.rgb);
    Picture clear = picture;
    clear.alpha.assign(31 * 17, 0);
    const Picture white = decodePng(encodePng(clear), "a.png");
    BOOST_TEST(std::count(white.rgb.begin(), white.rgb.end(), 255) == 3 * 31 * 17);
    for (const std::string& bad : {std::string(), std::string("PNG"), bytes.substr(0, bytes.size() / 2)}) {
        BOOST_CHECK_EXCEPTION(decodePng(bad, "a.png"), IoError, [](const IoError& error) {
            return std::string(error.what()).find("a.png: it is no PNG picture") == 0;
        });
    }
}

BOOST_AUTO_TEST_CASE(smaller_pictures_are_means)
{
    Picture picture{4, 2, {}};
    for (int i = 0; i < 8; ++i) {
        for (int channel = 0; channel < 3; ++channel)
            picture.rgb.push_back(static_cast<std::uint8_t>(10 * i + channel));
    }
    const Picture half = smaller(picture, 2);
    BOOST_TEST(half.width == 2);
    BOOST_TEST(half.height == 1);
    const std::vector<std::uint8_t> expected{25, 26, 27, 45, 46, 47}; // of 0 10 40 50, and of 20 30 60 70
    BOOST_CHECK(half.rgb == expected);
    BOOST_CHECK(smaller(picture, 4).rgb == picture.rgb);
    BOOST_CHECK(smaller(picture, 9).width == 4);
    const Picture line = smaller(gradient(300, 1), 100); // never without a row
    BOOST_TEST(line.height == 1);
    BOOST_TEST(line.rgb.size() == 300U);
}

BOOST_AUTO_TEST_CASE(pictures_without_the_pixels_they_claim_are_refused)
{
    Picture wrong = gradient(4, 4);
    wrong.rgb.pop_back();
    BOOST_CHECK_THROW(encodePng(wrong), InputError);
    BOOST_CHECK_THROW(encodePng(Picture()), InputError);
}

BOOST_AUTO_TEST_CASE(pixels_are_turned_over_and_divided_by_their_alpha)
{
    // Two rows, the lower first: half covered by (100, 50, 0), nothing; all of (1, 2, 3), a quarter of white.
    const std::vector<std::uint8_t> rgba{50, 25, 0, 128, 0, 0, 0, 0, 1, 2, 3, 255, 64, 64, 64, 64};
    const Picture transparent = fromPixels(rgba, 2, 2, true);
    BOOST_TEST(transparent.rgb == (std::vector<std::uint8_t>{1, 2, 3, 255, 255, 255, 100, 50, 0, 0, 0, 0}),
               boost::test_tools::per_element());
    BOOST_TEST(transparent.alpha == (std::vector<std::uint8_t>{255, 64, 128, 0}), boost::test_tools::per_element());
    const Picture opaque = fromPixels(rgba, 2, 2, false);
    BOOST_TEST(opaque.rgb == (std::vector<std::uint8_t>{1, 2, 3, 64, 64, 64, 50, 25, 0, 0, 0, 0}),
               boost::test_tools::per_element());
    BOOST_TEST(opaque.alpha.empty());
}

BOOST_AUTO_TEST_CASE(alpha_is_written_for_all_pixels_or_none)
{
    Picture picture = gradient(3, 2);
    const std::string opaque = encodePng(picture);
    picture.alpha.assign(6, 255);
    const std::string covered = encodePng(picture);
    picture.alpha[4] = 17;
    BOOST_TEST(covered != opaque);
    BOOST_TEST(encodePng(picture) != covered);
    BOOST_TEST(opaque[25] == 2);  // PNG's type of colour: RGB
    BOOST_TEST(covered[25] == 6); // RGB and alpha
    picture.alpha.pop_back();
    BOOST_CHECK_THROW(encodePng(picture), InputError);
}

BOOST_AUTO_TEST_SUITE_END()
