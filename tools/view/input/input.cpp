#include <tools/view/input/input.h>

#include <algorithm>
#include <array>
#include <optional>

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

// In the order of Button.
constexpr std::array<std::string_view, 3> buttonNames{"left", "right", "middle"};

/// Takes the modifiers off the front of `name`. None: a word before a plus is no modifier, or a repeated one.
std::optional<Modifiers> takeModifiers(std::string_view& name)
{
    Modifiers modifiers;
    for (std::size_t plus = name.find('+'); plus != std::string_view::npos; plus = name.find('+')) {
        const std::string_view word = name.substr(0, plus);
        const auto modifier = std::find_if(modifierNames.begin(), modifierNames.end(),
                                           [&](const NamedModifier& candidate) { return candidate.name == word; });
        if (modifier == modifierNames.end() || modifiers.*modifier->held) return std::nullopt;
        modifiers.*modifier->held = true;
        name.remove_prefix(plus + 1);
    }
    return modifiers;
}

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
        throw InputError("key", "'" + std::string(name) + "' is not allowed; it must be one of " + allowedKeys);
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

std::string nameOf(const Modifiers& modifiers)
{
    std::string name;
    for (const NamedModifier& modifier : modifierNames) {
        if (modifiers.*modifier.held) name.append(name.empty() ? "" : "+").append(modifier.name);
    }
    return name;
}

std::string nameOf(const KeyChord& chord)
{
    const std::string modifiers = nameOf(chord.modifiers);
    return modifiers + (modifiers.empty() ? "" : "+") + nameOf(chord.key);
}

std::string nameOf(Button button)
{
    return std::string(buttonNames.at(static_cast<std::size_t>(button)));
}

KeyChord chordNamed(std::string_view name)
{
    std::string_view rest = name;
    const auto modifiers = takeModifiers(rest);
    if (!modifiers) {
        throw InputError("keys",
                         "'" + std::string(name) +
                             "' is not allowed; it must be a key, after control+, shift+ and alt+, each once at most");
    }
    return {keyNamed(rest), *modifiers};
}

ButtonChord buttonNamed(std::string_view name)
{
    std::string_view rest = name;
    const auto modifiers = takeModifiers(rest);
    const auto found = std::find(buttonNames.begin(), buttonNames.end(), rest);
    if (!modifiers || found == buttonNames.end()) {
        throw InputError(
            "mouse", "'" + std::string(name) +
                         "' is not allowed; it must be left, right or middle, after control+, shift+ and alt+, each "
                         "once at most");
    }
    return {static_cast<Button>(found - buttonNames.begin()), *modifiers};
}

} // namespace vdbcage::view
