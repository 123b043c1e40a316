#pragma once

#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace vdbcage::view {

/// A key of the keyboard, named by its label. Shift, control and alt are `Modifiers`.
// clang-format off
enum class Key {
    a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q, r, s, t, u, v, w, x, y, z,
    digit0, digit1, digit2, digit3, digit4, digit5, digit6, digit7, digit8, digit9,
    f1, f2, f3, f4, f5, f6, f7, f8, f9, f10, f11, f12,
    left, right, up, down, pageUp, pageDown, home, end, insert, del, backspace, space, enter, escape, tab,
    minus, equal, comma, period, slash, semicolon, apostrophe, leftBracket, rightBracket, backslash, grave,
    keypad0, keypad1, keypad2, keypad3, keypad4, keypad5, keypad6, keypad7, keypad8, keypad9,
    keypadEnter, keypadAdd, keypadSubtract, keypadMultiply, keypadDivide, keypadDecimal
};
// clang-format on

/// Returns every key, in the order of `Key`.
const std::vector<Key>& allKeys();

/// Returns one word in lower case, such as "z", "7", "f5", "page-up" or "keypad-add".
std::string nameOf(Key key);

/// \throw InputError no key has this name
Key keyNamed(std::string_view name);

/// Keys that are held with others and change their meaning.
struct Modifiers {
    bool shift = false, control = false, alt = false;
};

bool operator==(const Modifiers& a, const Modifiers& b);

/// Returns a text such as "control+shift", in the order control, shift, alt; empty: none.
std::string nameOf(const Modifiers& modifiers);

/// A key and the modifiers held with it.
struct KeyChord {
    Key key = Key::a;
    Modifiers modifiers = {};
};

bool operator==(const KeyChord& a, const KeyChord& b);

/// Returns a text such as "control+shift+z": the modifiers in the order control, shift, alt, then the key.
std::string nameOf(const KeyChord& chord);

/// Reads a text of `nameOf`, with the modifiers in any order.
/// \throw InputError not such a text
KeyChord chordNamed(std::string_view name);

enum class Button { left, right, middle };

/// Returns "left", "right" or "middle".
std::string nameOf(Button button);

/// A button and the modifiers held with it.
struct ButtonChord {
    Button button = Button::left;
    Modifiers modifiers = {};
};

/// Reads a text such as "left" or "control+shift+left", with the modifiers in any order.
/// \throw InputError not such a text
ButtonChord buttonNamed(std::string_view name);

struct PointerMoved {
    double x = 0, y = 0; ///< pixels from the top left
};
struct PointerLeft {}; ///< the pointer left the window
struct ButtonDown {
    Button button = Button::left;
    int clicks =
        1; ///< 2: the second press of a double click, and so on. The maker of the event decides; no clock is asked
};
struct ButtonUp {
    Button button = Button::left;
};
struct WheelTurned {
    double x = 0, y = 0; ///< notches; positive y is away from the user
};
struct KeyDown {
    Key key = Key::a; ///< again without a `KeyUp` between: a repetition by the keyboard
};
struct KeyUp {
    Key key = Key::a;
};
struct Typed {
    char32_t character = 0;
};

/// One act of the user, in a window or in a script.
struct InputEvent {
    std::variant<PointerMoved, PointerLeft, ButtonDown, ButtonUp, WheelTurned, KeyDown, KeyUp, Typed> what;
    Modifiers modifiers = {}; ///< held meanwhile
};

} // namespace vdbcage::view
