#include <boost/test/unit_test.hpp>

#include <set>
#include <string>

#include <tools/view/input/input.h>
#include <vdbcage/core/error.h>

using namespace vdbcage;
using namespace vdbcage::view;

BOOST_AUTO_TEST_SUITE(input)

BOOST_AUTO_TEST_CASE(every_key_has_a_name_of_its_own_that_reads_back)
{
    std::set<std::string> names;
    for (const Key key : allKeys()) {
        const std::string name = nameOf(key);
        BOOST_TEST(!name.empty());
        BOOST_TEST(names.insert(name).second, name << " is the name of two keys");
        BOOST_TEST((keyNamed(name) == key), name << " is read as another key");
    }
    BOOST_TEST(names.size() == 26 + 10 + 12 + 15 + 11 + 16);
}

BOOST_AUTO_TEST_CASE(names_are_what_is_printed_on_the_keys)
{
    BOOST_TEST(nameOf(Key::a) == "a");
    BOOST_TEST(nameOf(Key::z) == "z");
    BOOST_TEST(nameOf(Key::digit0) == "0");
    BOOST_TEST(nameOf(Key::f12) == "f12");
    BOOST_TEST(nameOf(Key::pageUp) == "page-up");
    BOOST_TEST(nameOf(Key::del) == "delete");
    BOOST_TEST(nameOf(Key::tab) == "tab");
    BOOST_TEST(nameOf(Key::grave) == "grave");
    BOOST_TEST(nameOf(Key::keypad9) == "keypad-9");
    BOOST_TEST(nameOf(Key::keypadDecimal) == "keypad-decimal");
}

BOOST_AUTO_TEST_CASE(every_chord_reads_back)
{
    for (const Key key : allKeys()) {
        for (int held = 0; held < 8; ++held) {
            const KeyChord chord{key, {(held & 1) != 0, (held & 2) != 0, (held & 4) != 0}};
            BOOST_TEST((chordNamed(nameOf(chord)) == chord), nameOf(chord));
        }
    }
    BOOST_TEST(nameOf(KeyChord{Key::z, {true, true, true}}) == "control+shift+alt+z");
    BOOST_TEST((chordNamed("shift+control+z") == KeyChord{Key::z, {true, true, false}}));
}

BOOST_AUTO_TEST_CASE(buttons_have_names_with_what_is_held)
{
    for (const Button button : {Button::left, Button::right, Button::middle}) {
        for (int held = 0; held < 8; ++held) {
            const Modifiers modifiers{(held & 1) != 0, (held & 2) != 0, (held & 4) != 0};
            const std::string before = nameOf(modifiers);
            const ButtonChord read = buttonNamed(before + (before.empty() ? "" : "+") + nameOf(button));
            BOOST_CHECK(read.button == button);
            BOOST_CHECK(read.modifiers == modifiers);
        }
    }
    for (const char* word : {"", "hat", "hat+left", "alt+", "alt+alt+left", "a"}) {
        BOOST_TEST_CONTEXT(word) BOOST_CHECK_THROW((void)buttonNamed(word), InputError);
    }
}

BOOST_AUTO_TEST_CASE(slips_get_one_line_that_says_what_is_allowed)
{
    const auto says = [](const char* word) {
        return [word](const InputError& error) {
            const std::string text = error.what();
            return text.find(word) != std::string::npos && text.find("must be") != std::string::npos &&
                   text.find('\n') == std::string::npos;
        };
    };
    BOOST_CHECK_EXCEPTION((void)keyNamed("escpae"), InputError, says("'escpae'"));
    BOOST_CHECK_EXCEPTION((void)keyNamed(""), InputError, says("page-up"));
    BOOST_CHECK_EXCEPTION((void)keyNamed("A"), InputError, says("keypad-0 to keypad-9"));
    BOOST_CHECK_EXCEPTION((void)chordNamed("super+z"), InputError, says("'super+z'"));
    BOOST_CHECK_EXCEPTION((void)chordNamed("shift+shift+z"), InputError, says("'shift+shift+z'"));
    BOOST_CHECK_EXCEPTION((void)chordNamed("shift+"), InputError, says("''"));
    BOOST_CHECK_EXCEPTION((void)chordNamed("+z"), InputError, says("'+z'"));
    BOOST_CHECK_EXCEPTION((void)chordNamed(""), InputError, says("''"));
}

BOOST_AUTO_TEST_SUITE_END()
