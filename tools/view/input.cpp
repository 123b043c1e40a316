#include <tools/view/input.h>

#include <algorithm>
#include <array>

#include <vdbcage/core/error.h>

namespace vdbcage::view {

namespace {

constexpr std::size_t keyCount = static_cast<std::size_t>(Key::keypadDecimal) + 1;

// In the order of Key.
constexpr std::array<std::string_view, keyCount> keyNames{"a",
                                                          "b",
                                                          "c",
                                                          "d",
                                                          "e",
                                                          "f",
                                                          "g",
                                                          "h",
                                                          "i",
                                                          "j",
                                                          "k",
                                                          "l",
                                                          "m",
                                                          "n",
                                                          "o",
                                                          "p",
                                                          "q",
                                                          "r",
                                                          "s",
                                                          "t",
                                                          "u",
                                                          "v",
                                                          "w",
                                                          "x",
                                                          "y",
                                                          "z",
                                                          "0",
                                                          "1",
                                                          "2",
                                                          "3",
                                                          "4",
                                                          "5",
                                                          "6",
                                                          "7",
                                                          "8",
                                                          "9",
                                                          "f1",
                                                          "f2",
                                                          "f3",
                                                          "f4",
                                                          "f5",
                                                          "f6",
                                                          "f7",
                                                          "f8",
                                                          "f9",
                                                          "f10",
                                                          "f11",
                                                          "f12",
                                                          "left",
                                                          "right",
                                                          "up",
                                                          "down",
                                                          "page-up",
                                                          "page-down",
                                                          "home",
                                                          "end",
                                                          "insert",
                                                          "delete",
                                                          "backspace",
                                                          "space",
                                                          "enter",
                                                          "escape",
                                                          "tab",
                                                          "minus",
                                                          "equal",
                                                          "comma",
                                                          "period",
                                                          "slash",
                                                          "semicolon",
                                                          "apostrophe",
                                                          "left-bracket",
                                                          "right-bracket",
                                                          "backslash",
                                                          "grave",
                                                          "keypad-0",
                                                          "keypad-1",
                                                          "keypad-2",
                                                          "keypad-3",
                                                          "keypad-4",
                                                          "keypad-5",
                                                          "keypad-6",
                                                          "keypad-7",
                                                          "keypad-8",
                                                          "keypad-9",
                                                          "keypad-enter",
                                                          "keypad-add",
                                                          "keypad-subtract",
                                                          "keypad-multiply",
                                                          "keypad-divide",
                                                          "keypad-decimal"};

constexpr char allowedKeys[] =
    "a to z, 0 to 9, f1 to f12, left, right, up, down, page-up, page-down, home, end, insert, delete, backspace, "
    "space, enter, escape, tab, minus, equal, comma, period, slash, semicolon, apostrophe, left-bracket, "
    "right-bracket, backslash, grave, keypad-0 to keypad-9, keypad-enter, keypad-add, keypad-subtract, "
    "keypad-multiply, keypad-divide or keypad-decimal";

struct NamedModifier {
    std::string_view name;
    bool Modifiers::*held;
};

constexpr std::array<NamedModifier, 3> modifierNames{
    {{"control", &Modifiers::control}, {"shift", &Modifiers::shift}, {"alt", &Modifiers::alt}}};

} // namespace

const std::vector<Key>& allKeys()
{
    static const std::vector<Key> keys = [] {
        std::vector<Key> made;
        for (std::size_t i = 0; i < keyCount; ++i) made.push_back(static_cast<Key>(i));
        return made;
    }();
    return keys;
}

std::string nameOf(Key key)
{
    return std::string(keyNames.at(static_cast<std::size_t>(key)));
}

Key keyNamed(std::string_view name)
{
    const auto found = std::find(keyNames.begin(), keyNames.end(), name);
    if (found == keyNames.end()) {
        throw InputError("key: '" + std::string(name) + "' is not allowed; it must be one of " + allowedKeys);
    }
    return static_cast<Key>(found - keyNames.begin());
}

bool operator==(const Modifiers& a, const Modifiers& b)
{
    return a.shift == b.shift && a.control == b.control && a.alt == b.alt;
}

bool operator==(const KeyChord& a, const KeyChord& b)
{
    return a.key == b.key && a.modifiers == b.modifiers;
}

std::string nameOf(const KeyChord& chord)
{
    std::string name;
    for (const NamedModifier& modifier : modifierNames) {
        if (chord.modifiers.*modifier.held) name.append(modifier.name).append("+");
    }
    return name + nameOf(chord.key);
}

KeyChord chordNamed(std::string_view name)
{
    KeyChord chord;
    std::string_view rest = name;
    for (std::size_t plus = rest.find('+'); plus != std::string_view::npos; plus = rest.find('+')) {
        const std::string_view word = rest.substr(0, plus);
        const auto modifier = std::find_if(modifierNames.begin(), modifierNames.end(),
                                           [&](const NamedModifier& candidate) { return candidate.name == word; });
        if (modifier == modifierNames.end() || chord.modifiers.*modifier->held) {
            throw InputError("keys: '" + std::string(name) +
                             "' is not allowed; it must be a key, after control+, shift+ and alt+, each once at most");
        }
        chord.modifiers.*modifier->held = true;
        rest.remove_prefix(plus + 1);
    }
    chord.key = keyNamed(rest);
    return chord;
}

} // namespace vdbcage::view
