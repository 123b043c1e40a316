#include <boost/test/unit_test.hpp>

#include <string>

#include <vdbcage/core/detail/printable.h>
#include <vdbcage/core/error.h>

using vdbcage::detail::printable;

BOOST_AUTO_TEST_SUITE(printable_text)

BOOST_AUTO_TEST_CASE(what_people_write_stays)
{
    for (const std::string text : {"", "plain/path name.obj", "b\xC3\xA4r.obj", "\xE7\x86\x8A.ply",
                                   "\xF0\x9F\x90\xBB.stl", "C:\\new\\cage.obj", "\xC2\xA0"}) {
        BOOST_TEST(printable(text) == text);
    }
}

BOOST_AUTO_TEST_CASE(controls_become_codes)
{
    BOOST_TEST(printable("a\nb\rc\td") == "a\\nb\\rc\\td");
    BOOST_TEST(printable(std::string("\x1b[31mred\0\x7f", 10)) == "\\x1b[31mred\\x00\\x7f");
    BOOST_TEST(printable("\xC2\x9B"
                         "31m") == "\\xc2\\x9b31m"); // C1: CSI in one character
    BOOST_TEST(printable("\xE2\x80\xAE"
                         "jbo") == "\\xe2\\x80\\xaejbo"); // right to left from here
    BOOST_TEST(printable("a\xE2\x80\xA8"
                         "b") == "a\\xe2\\x80\\xa8"
                                 "b"); // line separator
}

BOOST_AUTO_TEST_CASE(bytes_that_are_not_utf8_become_codes)
{
    BOOST_TEST(printable("b\xE4r") == "b\\xe4r");                                 // Latin-1
    BOOST_TEST(printable("\xC3") == "\\xc3");                                     // cut short
    BOOST_TEST(printable("\xC0\x8A\xE0\x80\x8A") == "\\xc0\\x8a\\xe0\\x80\\x8a"); // overlong line ends
    BOOST_TEST(printable("\xED\xA0\x80\xF4\x90\x80\x80\xFF") == "\\xed\\xa0\\x80\\xf4\\x90\\x80\\x80\\xff");
}

BOOST_AUTO_TEST_CASE(any_bytes_give_one_line_of_well_formed_text)
{
    unsigned state = 7;
    std::string bytes;
    for (int i = 0; i < 20000; ++i) bytes += static_cast<char>((state = state * 1664525U + 1013904223U) >> 24);
    const std::string once = printable(bytes);
    for (const char c : once) BOOST_REQUIRE(static_cast<unsigned char>(c) >= 0x20);
    BOOST_CHECK(printable(once) == once);
}

BOOST_AUTO_TEST_CASE(errors_are_one_line)
{
    BOOST_TEST(std::string(vdbcage::IoError("no\nsuch\x1b.obj: cannot be read").what()) ==
               "no\\nsuch\\x1b.obj: cannot be read");
}

BOOST_AUTO_TEST_SUITE_END()
