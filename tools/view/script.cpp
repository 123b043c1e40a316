#include <tools/view/script.h>

#include <algorithm>
#include <charconv>
#include <sstream>

#include <tools/view/files/file_contents.h>
#include <tools/view/state/words.h>
#include <vdbcage/core/detail/read_file.h>
#include <vdbcage/core/error.h>

namespace vdbcage::view {

namespace {

constexpr int mostPixels = 8192;

void send(App& app, decltype(InputEvent::what) what, const Modifiers& modifiers = {})
{
    app.handle({std::move(what), modifiers});
}

/// Reads a size such as "1280x800".
std::pair<int, int> sizeOf(const std::string& text)
{
    const std::size_t cross = text.find('x');
    if (cross == std::string::npos) throw InputError("'" + text + "' is not a size; it must be WIDTHxHEIGHT");
    return {wholeNumberOf(text.substr(0, cross), "width", 1, mostPixels),
            wholeNumberOf(text.substr(cross + 1), "height", 1, mostPixels)};
}

Rectangle placeOf(App& app, const std::string& name)
{
    if (name == "picture") return app.picturePlace();
    app.reveal(name);
    const auto place = app.widget(name);
    if (!place) throw InputError("there is no widget '" + name + "' to be seen");
    return *place;
}

/// Moves the pointer to a share of a widget, from its left and its top.
void moveTo(App& app, const std::string& name, double x, double y)
{
    const Rectangle place = placeOf(app, name);
    send(app, PointerMoved{place.left + x * place.width, place.top + y * place.height});
}

void click(App& app, int clicks = 1, const ButtonChord& chord = {})
{
    for (int i = 1; i <= clicks; ++i) {
        send(app, ButtonDown{chord.button, i}, chord.modifiers);
        send(app, ButtonUp{chord.button}, chord.modifiers);
    }
}

void press(App& app, const KeyChord& chord)
{
    send(app, KeyDown{chord.key}, chord.modifiers);
    send(app, KeyUp{chord.key}, chord.modifiers);
}

/// Returns the characters of UTF-8 text, and refuses other text.
std::vector<char32_t> charactersOf(const std::string& text)
{
    std::vector<char32_t> characters;
    for (std::size_t i = 0; i < text.size();) {
        const auto lead = static_cast<unsigned char>(text[i++]);
        const int more = lead < 0x80 ? 0 : lead >> 5 == 6 ? 1 : lead >> 4 == 14 ? 2 : lead >> 3 == 30 ? 3 : -1;
        if (more < 0 || i + static_cast<std::size_t>(more) > text.size()) throw InputError("type", "it is not UTF-8");
        char32_t value = more == 0 ? lead : lead & (0x3FU >> more);
        for (int k = 0; k < more; ++k) {
            const auto next = static_cast<unsigned char>(text[i++]);
            if (next >> 6 != 2) throw InputError("type", "it is not UTF-8");
            value = value << 6 | (next & 0x3FU);
        }
        characters.push_back(value);
    }
    return characters;
}

void type(App& app, const std::string& text)
{
    for (const char32_t character : charactersOf(text)) send(app, Typed{character});
}

ButtonChord buttonOf(const Words& words, std::size_t i)
{
    return words.size() > i ? buttonNamed(words[i]) : ButtonChord{};
}

void doMouse(App& app, const Words& words)
{
    const std::string action = words.size() > 1 ? words[1] : std::string();
    const auto share = [&](std::size_t i) { return words.size() > i ? numberOf(words[i], "mouse") : 0.5; };
    if (action == "move" && words.size() >= 3 && words.size() <= 5) {
        moveTo(app, words[2], share(3), share(4));
    } else if (action == "at" && words.size() == 4) {
        send(app, PointerMoved{numberOf(words[2], "mouse"), numberOf(words[3], "mouse")});
    } else if (action == "by" && words.size() == 4) {
        const auto [x, y] = app.pointer();
        send(app, PointerMoved{x + numberOf(words[2], "mouse"), y + numberOf(words[3], "mouse")});
    } else if (action == "down" && words.size() <= 3) {
        const ButtonChord chord = buttonOf(words, 2);
        send(app, ButtonDown{chord.button}, chord.modifiers);
    } else if (action == "up" && words.size() <= 3) {
        const ButtonChord chord = buttonOf(words, 2);
        send(app, ButtonUp{chord.button}, chord.modifiers);
    } else if (action == "click" && words.size() <= 3) {
        click(app, 1, buttonOf(words, 2));
    } else if (action == "double-click" && words.size() == 2) {
        click(app, 2);
    } else if (action == "wheel" && words.size() == 3) {
        send(app, WheelTurned{0, numberOf(words[2], "mouse")});
    } else {
        throw InputError("mouse", "it is written mouse move WIDGET|picture [X [Y]] (shares of it), mouse at X Y "
                                  "(pixels), mouse by X Y, "
                                  "mouse down|up|click [BUTTON], mouse double-click, or mouse wheel NOTCHES");
    }
}

bool isKnown(const App& app, const std::string& value)
{
    const auto names = app.valueNames();
    return std::find(names.begin(), names.end(), value) != names.end();
}

/// Sets the value of a widget as a user does: fields by typing, lists by choosing, others by clicks.
void setWidget(App& app, const std::string& name, const std::string& value)
{
    const auto clickOn = [&](const std::string& widget) {
        moveTo(app, widget, 0.5, 0.5);
        click(app);
    };
    if (value == "press") return clickOn(name);
    if ((value == "on" || value == "off") && isKnown(app, name) && !isKnown(app, "option." + name)) {
        if (app.value(name) != value) clickOn(name);
        return;
    }
    clickOn(name);
    const std::string choice = name + '.' + value;
    if (app.widget(choice)) return clickOn(choice);
    press(app, {Key::a, {false, true, false}});
    type(app, value);
    press(app, {Key::enter, {}});
}

/// Returns whether `have` fits `wanted`: the same text, or a number that is < <= > >= the one after that sign.
bool isAs(const std::string& have, const std::string& wanted)
{
    const std::size_t length = wanted.find_first_not_of("<>=");
    if (length == 0 || length == std::string::npos) return have == wanted;
    const std::string sign = wanted.substr(0, length);
    double value = 0;
    if (std::from_chars(have.data(), have.data() + have.size(), value).ec != std::errc()) return false;
    const double limit = numberOf(wanted.substr(length), "expect");
    if (sign == "<") return value < limit;
    if (sign == "<=") return value <= limit;
    if (sign == ">") return value > limit;
    if (sign == ">=") return value >= limit;
    throw InputError("expect", "'" + sign + "' is not allowed; it must be <, <=, > or >=");
}

void doExpect(App& app, const Words& words)
{
    if (words.size() != 3) throw InputError("expect", "it is written expect NAME VALUE");
    const std::string have = app.value(words[1]);
    if (!isAs(have, words[2])) {
        throw InputError("expect", words[1] + " is " + quotedWord(have) + ", not " + quotedWord(words[2]));
    }
}

void doScreenshot(App& app, const Words& words)
{
    if (words.size() != 2 && words.size() != 3) throw InputError("screenshot", "it is written screenshot FILE [SIZE]");
    if (words.size() == 3) {
        const auto [width, height] = sizeOf(words[2]);
        app.resize(width, height);
    }
    savePicture(app.picture(), words[1]);
}

} // namespace

std::vector<std::pair<std::string, std::string>> describeScript()
{
    return {
        {"wait", "until the cage is made, or cannot be, and files are written"},
        {"screenshot FILE.png [WIDTHxHEIGHT]", "writes a picture of the window, in that size from now on"},
        {"expect NAME VALUE", "ends with an error unless NAME is VALUE, or with <, <=, >, >= before a number is so"},
        {"mouse move WIDGET|picture [X [Y]]", "moves the pointer to a share of the widget, from its left and top"},
        {"mouse move handle.NAME", "to a handle in the picture: x, y, z, plane-x, plane-y, plane-z or screen"},
        {"mouse by X Y", "moves the pointer by pixels, right and down"},
        {"mouse at X Y", "moves the pointer to a pixel"},
        {"mouse down|up|click [BUTTON]", "left, right or middle, such as control+shift+left"},
        {"mouse double-click", "with the left button"},
        {"mouse wheel NOTCHES", "away from the user is positive"},
        {"key CHORD", "presses keys, such as control+shift+z"},
        {"type TEXT", "types it"},
        {"widget NAME VALUE", "gives a widget a value by mouse and keys; press: a button"}};
}

void runLine(App& app, const std::string& line)
{
    const Words words = wordsOf(line);
    if (words.empty()) return;
    const std::string& verb = words[0];
    if (verb == "wait" && words.size() == 1) {
        app.waitUntilSettled();
    } else if (verb == "screenshot") {
        doScreenshot(app, words);
    } else if (verb == "expect") {
        doExpect(app, words);
    } else if (verb == "mouse") {
        doMouse(app, words);
    } else if (verb == "key" && words.size() == 2) {
        press(app, chordNamed(words[1]));
    } else if (verb == "type" && words.size() == 2) {
        type(app, words[1]);
    } else if (verb == "widget" && words.size() == 3) {
        setWidget(app, words[1], words[2]);
    } else {
        app.perform(actionOf(words));
    }
}

void runScript(App& app, const std::filesystem::path& path)
{
    std::istringstream lines(detail::readFile(path));
    std::string line;
    for (int number = 1; std::getline(lines, line) && !app.isEnded(); ++number) {
        try {
            runLine(app, line);
        } catch (const DeviceError&) {
            throw;
        } catch (const Error& error) {
            throw InputError(path.string() + ":" + std::to_string(number), error.what());
        }
    }
    app.waitUntilSaved();
}

} // namespace vdbcage::view
