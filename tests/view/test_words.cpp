#include <boost/test/unit_test.hpp>

#include <cmath>
#include <random>
#include <string>
#include <vector>

#include <tools/view/state/words.h>
#include <vdbcage/core/detail/length_text.h>
#include <vdbcage/core/error.h>

using namespace vdbcage;
using view::quotedWord;
using view::wordsOf;

BOOST_AUTO_TEST_SUITE(words)

BOOST_AUTO_TEST_CASE(blanks_part_words_and_a_comment_ends_the_line)
{
    const std::vector<std::string> expected{"set", "faces", "300"};
    BOOST_TEST(wordsOf("  set\tfaces 300 # a comment") == expected, boost::test_tools::per_element());
    BOOST_TEST(wordsOf("").empty());
    BOOST_TEST(wordsOf("# all of it").empty());
    BOOST_TEST(wordsOf("a#b").front() == "a#b");
    BOOST_TEST(wordsOf("open \"a b.obj\"").back() == "a b.obj");
    BOOST_TEST(wordsOf("\"\"").front().empty());
}

BOOST_AUTO_TEST_CASE(any_words_read_back)
{
    std::mt19937 random(1);
    const std::string letters = " \t\n\r\"\\#abc\xc3\xa4";
    for (int run = 0; run < 2000; ++run) {
        std::vector<std::string> list(random() % 4);
        std::string line;
        for (std::string& word : list) {
            for (std::size_t n = random() % 6; n > 0; --n) word += letters[random() % letters.size()];
            line += quotedWord(word) + ' ';
        }
        BOOST_TEST(line.find('\n') == std::string::npos);
        BOOST_TEST(wordsOf(line) == list, boost::test_tools::per_element());
    }
}

BOOST_AUTO_TEST_CASE(what_is_no_line_of_words_is_refused)
{
    BOOST_CHECK_THROW(wordsOf("open \"a"), InputError);
    BOOST_CHECK_THROW(wordsOf("open \"a\"b"), InputError);
    BOOST_CHECK_THROW(wordsOf("open \"a\\\""), InputError);
}

BOOST_AUTO_TEST_CASE(numbers_are_whole_words_and_finite)
{
    BOOST_TEST(view::numberOf("-1.5e3", "x") == -1500);
    for (const char* word : {"", "1x", "nan", "inf", "1e999", " 1", "0x10", "+1"}) {
        BOOST_CHECK_THROW(view::numberOf(word, "x"), InputError);
        BOOST_CHECK_THROW(view::wholeNumberOf(word, "x", 0, 20), InputError);
    }
    BOOST_TEST(view::wholeNumberOf("20", "x", 0, 20) == 20);
    BOOST_CHECK_THROW(view::wholeNumberOf("21", "x", 0, 20), InputError);
    BOOST_CHECK_THROW(view::switchOf("yes", "x"), InputError);
}

BOOST_AUTO_TEST_CASE(lengths_have_the_digits_that_tell_a_step_apart)
{
    using detail::lengthText;
    BOOST_TEST(lengthText(5800010.25, 1e-3) == "5800010.25");
    BOOST_TEST(lengthText(-5800010.25, 1000) == "-5800010");
    BOOST_TEST(lengthText(0.1, 1e-6) == "0.1");
    BOOST_TEST(lengthText(-1e-9, 1e-6) == "0");
    BOOST_TEST(lengthText(100, 1) == "100");
    BOOST_TEST(lengthText(1e300, 1) == "1e+300");
    BOOST_TEST(lengthText(1.25e-20, 1e-22) == "1.25e-20");
    std::mt19937 random(2);
    std::uniform_real_distribution<double> power(-12, 12), share(-1, 1);
    for (int run = 0; run < 20000; ++run) {
        const double step = std::pow(10, power(random)), value = share(random) * std::pow(10, power(random));
        const std::string text = lengthText(value, step);
        const double read = view::numberOf(text, "it");
        BOOST_TEST(std::abs(read - value) <= std::max(step / 2, 1e-14 * std::abs(value)) * (1 + 1e-9), text);
        if (std::abs(read) > 1e-4) BOOST_TEST(text.find('e') == std::string::npos, text);
        BOOST_TEST(lengthText(read, step) == text);
    }
}

BOOST_AUTO_TEST_SUITE_END()
