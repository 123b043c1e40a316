// The real program on a display of its own, under a window manager, with a real pointer and keyboard. Beside it the
// same program without a window gets what the hand does as events: it tells where the widgets are, and draws what the
// screen must come to show. No other test sees that: scripts draw whenever they look.
#include <boost/test/unit_test.hpp>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <functional>
#include <optional>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

#include <csignal>

#include <support/gl_sources.h>
#include <support/process.h>
#include <support/run_command.h>
#include <support/shapes.h>
#include <support/temporary_folder.h>
#include <tools/draw/picture.h>
#include <tools/view/app.h>
#include <tools/view/files/scene.h>
#include <tools/view/script.h>
#include <tools/view/state/command.h>
#include <tools/view/state/session.h>
#include <tools/view/state/words.h>
#include <vdbcage/core/error.h>
#include <vdbcage/gl/offscreen.h>
#include <vdbcage/mesh/mesh_io.h>

using namespace vdbcage;
using namespace vdbcage::view;

namespace fs = std::filesystem;

namespace {

/// Nothing is waited for by a time; this one is for what never comes.
constexpr std::chrono::seconds patience{120};

/// Waits until it is so. False: that never came.
bool comesToBe(const std::function<bool()>& isSo)
{
    const auto end = std::chrono::steady_clock::now() + patience;
    while (!isSo()) {
        if (std::chrono::steady_clock::now() >= end) return false;
        std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    return true;
}

void await(const std::string& what, const std::function<bool()>& isSo)
{
    BOOST_TEST_REQUIRE(comesToBe(isSo), what << " was waited for in vain");
}

/// Ended with the scope, and waited for.
class Process {
public:
    Process(const fs::path& folder, const std::string& name, const std::vector<std::string>& words)
        : out_(folder / (name + ".out")), id_(test::startCommand(words, out_, folder / (name + ".err")))
    {
    }
    ~Process()
    {
        if (!id_) return;
        ::kill(*id_, SIGTERM);
        test::waitFor(*id_);
    }
    Process(const Process&) = delete;
    Process& operator=(const Process&) = delete;

    pid_t id() const { return *id_; }
    std::string output() const { return test::readText(out_); }
    bool hasEnded() const { return test::hasEnded(*id_); }
    /// Waits for its end. Its exit status.
    int status()
    {
        await("the end of the program", [this] { return hasEnded(); });
        const int status = test::waitFor(*id_);
        id_.reset();
        return status;
    }

private:
    fs::path out_;
    std::optional<pid_t> id_;
};

/// A screen that is a file, with a window manager.
class Display {
public:
    static constexpr int width = 1400, height = 900;

    Display()
        : server_(folder_.path(), "server",
                  {"Xvfb", "-displayfd", "1", "-nocursor", "-noreset", "-fbdir", folder_.path().string(), "-screen",
                   "0", std::to_string(width) + 'x' + std::to_string(height) + "x24"})
    {
        await("a display", [this] { return server_.output().find('\n') != std::string::npos; });
        name_ = ':' + server_.output();
        name_.pop_back();
        // A window that is there before its manager never gets the keyboard.
        const fs::path begun = folder_ / "begun";
        manager_.emplace(folder_.path(), "manager", withDisplay({"openbox", "--startup", "touch " + begun.string()}));
        await("a window manager", [&] { return fs::exists(begun); });
    }

    /// A command on this display; the files of a user are in a folder of its own.
    std::vector<std::string> withDisplay(const std::vector<std::string>& words) const
    {
        const std::string home = folder_.path().string();
        std::vector<std::string> all{"env", "DISPLAY=" + name_, "HOME=" + home, "XDG_CONFIG_HOME=" + home};
        all.insert(all.end(), words.begin(), words.end());
        return all;
    }

    /// A line of xdotool: what it writes.
    std::string xdotool(const std::string& line) const
    {
        std::vector<std::string> words = wordsOf(line);
        words.insert(words.begin(), "xdotool");
        return test::runCommand(withDisplay(words)).out;
    }

    void resize(const std::string& window, int toWidth, int toHeight) const
    {
        xdotool("windowsize " + window + ' ' + std::to_string(toWidth) + ' ' + std::to_string(toHeight));
    }

    /// What is to be seen at a place. The file is what XWD writes: numbers of 32 bits, the high byte first, then the
    /// rows.
    draw::Picture part(int left, int top, int partWidth, int partHeight) const
    {
        draw::Picture picture{partWidth, partHeight, {}};
        picture.rgb.resize(3 * static_cast<std::size_t>(partWidth) * static_cast<std::size_t>(partHeight));
        std::ifstream file(folder_ / "Xvfb_screen0", std::ios::binary);
        std::array<unsigned char, 100> header{};
        const auto read = [&](std::size_t at, auto* to, std::size_t count) {
            file.seekg(static_cast<std::streamoff>(at));
            file.read(reinterpret_cast<char*>(to), static_cast<std::streamsize>(count));
        };
        const auto number = [&](std::size_t i) {
            return std::size_t{header[4 * i]} << 24 | std::size_t{header[4 * i + 1]} << 16 |
                   std::size_t{header[4 * i + 2]} << 8 | header[4 * i + 3];
        };
        read(0, header.data(), header.size());
        const std::size_t begin = number(0) + 12 * number(19), pitch = number(12); // a colour map has 12 bytes a colour
        BOOST_TEST_REQUIRE(number(11) == 32u);                                     // bits of a pixel: blue, green, red
        std::vector<unsigned char> row(4 * static_cast<std::size_t>(partWidth));
        std::uint8_t* to = picture.rgb.data();
        for (int y = top; y < top + partHeight; ++y) {
            read(begin + pitch * static_cast<std::size_t>(y) + 4 * static_cast<std::size_t>(left), row.data(),
                 row.size());
            for (std::size_t x = 0; x < row.size(); x += 4) {
                *to++ = row[x + 2];
                *to++ = row[x + 1];
                *to++ = row[x];
            }
        }
        return picture;
    }

private:
    test::TemporaryFolder folder_;
    Process server_;
    std::string name_;
    std::optional<Process> manager_;
};

/// One for all windows.
Display& theDisplay()
{
    static Display display;
    return display;
}

/// As X names a key of ours.
std::string keyOfX(const std::string& chord)
{
    std::string text = chord;
    for (const auto& [ours, theirs] : std::vector<std::pair<std::string, std::string>>{{"control", "ctrl"},
                                                                                       {"enter", "Return"},
                                                                                       {"escape", "Escape"},
                                                                                       {"tab", "Tab"},
                                                                                       {"home", "Home"},
                                                                                       {"down", "Down"}}) {
        if (const std::size_t at = text.find(ours); at != std::string::npos) text.replace(at, ours.size(), theirs);
    }
    return text;
}

constexpr int toX(Button button)
{
    return button == Button::left ? 1 : button == Button::middle ? 2 : 3;
}

/// The program in a window, and the one without.
class Windows {
public:
    static constexpr int width = 1100, height = 640;

    test::TemporaryFolder folder;
    std::string model = (folder / "ball.obj").string();

    Windows()
    {
        writeMesh(test::sphere({0, 0, 0}, 1, 8), model);
        writeMesh(test::sphere({0, 0, 0}, 2, 5), folder / "other.obj");
        // A cage that is made at once, and no times, which are never the same.
        Session session;
        for (const std::string& line :
             {"open " + quotedWord(model), std::string("set resolution 16"), std::string("set faces 40"),
              std::string("set effort fast"), std::string("times off")}) {
            session.execute(commandOf(wordsOf(line)));
        }
        const std::string scene = (folder / "scene.json").string();
        saveScene(session.state(), nullptr, scene);
        runLine(twin_, "open-scene " + quotedWord(scene));
        program_.emplace(folder.path(), "program", display_.withDisplay({VDBCAGE_VIEW, scene}));
        await("the window", [this] {
            std::istringstream(display_.xdotool("search --onlyvisible --pid " + std::to_string(program_->id()))) >>
                window_;
            return !window_.empty() && display_.xdotool("getactivewindow") == window_ + '\n';
        });
        std::string place = display_.xdotool("mousemove --window " + window_ + " 0 0 getmouselocation");
        std::sscanf(place.c_str(), "x:%d y:%d", &left_, &top_);
        display_.resize(window_, width, height); // small pictures are drawn sooner
        moveTo("picture");
        sees();
    }

    App& twin() { return twin_; }
    int status() { return program_->status(); }

    // ---- the hand

    void moveTo(const std::string& widget, double x = 0.5, double y = 0.5)
    {
        const Rectangle place = widget == "picture" ? twin().picturePlace() : placeOf(widget);
        at_ = {place.left + static_cast<int>(x * place.width), place.top + static_cast<int>(y * place.height)};
        send(PointerMoved{1.0 * at_[0], 1.0 * at_[1]});
        display_.xdotool("mousemove " + std::to_string(left_ + at_[0]) + ' ' + std::to_string(top_ + at_[1]));
    }

    void press(Button button = Button::left, const std::string& modifiers = {})
    {
        held_ = {button, {}};
        if (!modifiers.empty()) {
            held_ = buttonNamed(modifiers + '+' + nameOf(button));
            display_.xdotool("keydown " + keyOfX(modifiers));
        }
        send(ButtonDown{button}, held_.modifiers);
        display_.xdotool("mousedown " + std::to_string(toX(button)));
    }

    void release()
    {
        send(ButtonUp{held_.button}, held_.modifiers);
        display_.xdotool("mouseup " + std::to_string(toX(held_.button)));
        if (const std::string modifiers = nameOf(held_.modifiers); !modifiers.empty()) {
            display_.xdotool("keyup " + keyOfX(modifiers));
        }
    }

    void click(const std::string& widget)
    {
        moveTo(widget);
        press();
        release();
    }

    void turnWheel(bool isAway)
    {
        send(WheelTurned{0, isAway ? 1.0 : -1.0});
        display_.xdotool(isAway ? "click 4" : "click 5");
    }

    /// A key alone also types what is printed on it.
    void key(const std::string& chord)
    {
        const KeyChord keys = chordNamed(chord);
        send(KeyDown{keys.key}, keys.modifiers);
        if (chord.size() == 1) send(Typed{static_cast<char32_t>(chord[0])});
        send(KeyUp{keys.key}, keys.modifiers);
        display_.xdotool("key " + keyOfX(chord));
    }

    /// Enter, which saves `file`: by the twin, whose file then goes away, and by the program. It is the same file.
    void enterToSave(const fs::path& file)
    {
        send(KeyDown{Key::enter});
        send(KeyUp{Key::enter});
        twin().waitUntilSaved();
        const std::string bytes = test::readText(file);
        BOOST_TEST(bytes.size() > 100u);
        BOOST_TEST(fs::remove(file));
        display_.xdotool("key Return");
        await(file.filename().string(), [&] { return fs::exists(file); });
        BOOST_TEST((test::readText(file) == bytes));
    }

    void type(const std::string& text)
    {
        for (const char character : text) send(Typed{static_cast<char32_t>(character)});
        display_.xdotool("type --delay 1 " + quotedWord(text));
    }

    /// By the window manager, as by the button in the title.
    void close()
    {
        twin().attempt(Quit{});
        display_.xdotool("key alt+F4");
    }

    void resize(int newWidth, int newHeight)
    {
        twin().resize(newWidth, newHeight);
        display_.resize(window_, newWidth, newHeight);
    }

    std::string title() const
    {
        std::string name = display_.xdotool("getwindowname " + window_);
        if (!name.empty()) name.pop_back();
        return name;
    }

    // ---- the eye

    /// The screen comes to show what the twin draws.
    void sees()
    {
        twin().waitUntilSettled();
        seen_ = twin().picture();
        ++pictures_;
        if (comesToBe([this] { return onScreen().rgb == seen_.rgb; })) return;
        const fs::path pictures = VDBCAGE_PICTURES;
        test::writeText(pictures / "wanted.png", draw::encodePng(seen_));
        test::writeText(pictures / "screen.png", draw::encodePng(onScreen()));
        BOOST_TEST_REQUIRE(false,
                           "picture " << pictures_ << " does not come: see wanted.png and screen.png in " << pictures);
    }

    /// The same, and it is not what was seen last.
    void seesAnother()
    {
        const draw::Picture before = seen_;
        sees();
        BOOST_TEST((before.rgb != seen_.rgb), "the picture " << pictures_ << " is the same as the one before");
    }

private:
    AppSetup setup() const
    {
        AppSetup setup;
        setup.width = width;
        setup.height = height;
        setup.isSoftware = true;
        setup.recentFiles = folder / "recent";
        return setup;
    }

    template <class What>
    void send(What what, const Modifiers& modifiers = {})
    {
        twin().handle({std::move(what), modifiers});
    }

    Rectangle placeOf(const std::string& widget)
    {
        const auto place = twin().widget(widget);
        BOOST_TEST_REQUIRE(place.has_value(), widget << " is not to be seen");
        return *place;
    }

    draw::Picture onScreen() const { return display_.part(left_, top_, seen_.width, seen_.height); }

    // Software draws with what Mesa has in Xvfb, whatever device EGL would find.
    gl::OffscreenContext context_{gl::OffscreenContext::Debug::off, test::softwareSource()};
    gl::OffscreenContext::Current current_ = context_.makeCurrent();
    App twin_{context_.api(), setup()};
    Display& display_ = theDisplay();
    std::optional<Process> program_;
    std::string window_;
    int left_ = 0, top_ = 0;
    std::array<int, 2> at_{};
    ButtonChord held_;
    draw::Picture seen_;
    int pictures_ = 0;
};

} // namespace

BOOST_FIXTURE_TEST_SUITE(window, Windows)

BOOST_AUTO_TEST_CASE(menus_open_follow_the_pointer_and_act)
{
    click("menu.File");
    seesAnother();
    moveTo("menu.browse open");
    seesAnother();
    moveTo("menu.Edit"); // an open menu gives way to the one under the pointer
    seesAnother();
    moveTo("menu.Cage at rest");
    seesAnother();
    moveTo("menu.View");
    seesAnother();
    click("menu.ground off");
    seesAnother();
    runLine(twin(), "expect ground off");
    click("menu.Help");
    seesAnother();
    moveTo("menu.Keys");
    seesAnother();
    click("picture"); // which closes it and does nothing else
    seesAnother();
    runLine(twin(), "expect selected 0");
}

BOOST_AUTO_TEST_CASE(lists_open_and_are_chosen_from_by_pointer_and_keys)
{
    click("mesh");
    seesAnother();
    moveTo("mesh.triquad");
    seesAnother();
    click("mesh.triquad");
    seesAnother();
    runLine(twin(), "expect option.mesh triquad");
    click("element");
    seesAnother();
    key("down");
    seesAnother();
    key("escape");
    seesAnother();
}

BOOST_AUTO_TEST_CASE(what_is_under_the_pointer_lights_up_and_has_a_tip)
{
    for (const char* widget : {"resolution.auto", "preset.tight", "faces.slider", "layer.model"}) {
        BOOST_TEST_CONTEXT(widget)
        {
            moveTo(widget);
            seesAnother();
        }
    }
    moveTo("picture");
    seesAnother();
}

BOOST_AUTO_TEST_CASE(fields_show_what_is_typed_and_take_it_over)
{
    click("faces");
    seesAnother();
    for (const char* letter : {"6", "4"}) {
        type(letter);
        seesAnother();
    }
    key("enter");
    seesAnother();
    runLine(twin(), "expect option.faces 64");
    // Another place that is clicked takes it over too. Before, copied text goes to another field.
    click("faces");
    key("control+c");
    click("resolution");
    key("control+v");
    seesAnother();
    click("layer.model");
    seesAnother();
    runLine(twin(), "expect option.resolution 64");
    runLine(twin(), "expect layer.model off");
}

BOOST_AUTO_TEST_CASE(tab_goes_from_field_to_field)
{
    click("faces");
    type("50");
    key("tab");
    seesAnother();
    runLine(twin(), "expect option.faces 50");
    type("20");
    seesAnother();
    key("tab");
    seesAnother();
    runLine(twin(), "expect option.resolution 20");
    key("escape");
    runLine(twin(), "expect mode shape");
    sees();
}

BOOST_AUTO_TEST_CASE(without_a_field_tab_changes_the_mode_each_time_and_keys_stay_shortcuts)
{
    click("layer.model"); // the panel was used
    seesAnother();
    for (const char* mode : {"pose", "shape", "pose", "shape"}) {
        key("tab");
        seesAnother();
        BOOST_TEST(twin().value("mode") == mode);
    }
    key("m");
    seesAnother();
    runLine(twin(), "expect layer.model on");
}

BOOST_AUTO_TEST_CASE(a_slider_is_dragged)
{
    moveTo("faces.slider", 0.2);
    press();
    seesAnother();
    for (const double share : {0.25, 0.3}) {
        moveTo("faces.slider", share);
        seesAnother();
    }
    release();
    seesAnother();
    moveTo("opacity.model", 0.9);
    press();
    moveTo("opacity.model", 0.4);
    seesAnother();
    release();
    sees();
}

BOOST_AUTO_TEST_CASE(the_view_is_turned_moved_and_zoomed)
{
    for (const Button button : {Button::left, Button::middle, Button::right}) {
        BOOST_TEST_CONTEXT(nameOf(button))
        {
            moveTo("picture");
            press(button);
            moveTo("picture", 0.55, 0.6);
            seesAnother();
            moveTo("picture", 0.6, 0.7);
            seesAnother();
            release();
            sees();
        }
    }
    turnWheel(true);
    seesAnother();
    key("home");
    seesAnother();
}

BOOST_AUTO_TEST_CASE(parts_of_the_cage_are_selected_and_moved)
{
    moveTo("picture", 0.1, 0.1);
    press(Button::left, "control");
    moveTo("picture", 0.6, 0.9);
    seesAnother();
    release();
    seesAnother();
    BOOST_TEST(twin().value("selected") != "0");
    key("g");
    seesAnother();
    moveTo("picture", 0.65, 0.85);
    seesAnother();
    key("x");
    seesAnother();
    for (const char* letter : {"0", "period", "2"}) {
        key(letter);
        seesAnother();
    }
    key("enter");
    seesAnother();
    BOOST_TEST(twin().value("undo") == "move 0.2 0 0");
    key("control+z");
    seesAnother();
    BOOST_TEST(twin().value("undo") != "move 0.2 0 0");
}

BOOST_AUTO_TEST_CASE(an_edited_cage_is_fitted_and_its_points_are_locked)
{
    key("1");
    key("a");
    seesAnother();
    key("s");
    for (const char* letter : {"0", "period", "7"}) key(letter);
    key("enter");
    seesAnother();
    runLine(twin(), "expect bounding no");
    click("fit");
    seesAnother();
    runLine(twin(), "expect bounding yes");
    moveTo("tight", 0.5);
    press();
    moveTo("tight", 0.8);
    moveTo("tight", 0.9);
    release();
    seesAnother();
    runLine(twin(), "expect bounding yes");
    click("lock");
    seesAnother();
    key("g"); // which moves none of them, and says so
    moveTo("picture", 0.6, 0.6);
    seesAnother();
    key("escape");
    for (const char* step : {"lock", "fit "}) {
        BOOST_TEST(twin().value("undo").substr(0, 4) == step);
        key("control+z");
        seesAnother();
    }
    runLine(twin(), "expect bounding no");
}

BOOST_AUTO_TEST_CASE(files_are_opened_and_saved_by_dialogs)
{
    const std::string other = (folder / "other.obj").string(), cage = (folder / "made.obj").string();
    key("control+o");
    seesAnother();
    click("browser.entry.other.obj");
    seesAnother();
    click("browser.ok");
    seesAnother();
    await("the title", [this] { return title() == twin().title(); });
    BOOST_TEST(title() == "other.obj - vdbcage");
    key("control+s");
    seesAnother();
    type(cage); // at once, in place of the name that is offered
    seesAnother();
    enterToSave(cage);
    seesAnother();
    test::writeText(cage, "old"); // which is not written over without a question
    key("control+s");
    click("browser.name");
    key("control+a");
    type(cage);
    key("enter");
    seesAnother();
    BOOST_TEST(test::readText(cage) == "old");
    click("browser.no");
    seesAnother();
    click("browser.cancel");
    seesAnother();
}

BOOST_AUTO_TEST_CASE(a_window_with_unsaved_work_is_closed_after_a_question)
{
    click("faces");
    type("50");
    key("enter");
    seesAnother();
    close();
    seesAnother();
    click("quit.dismiss");
    seesAnother();
    close();
    seesAnother();
    click("quit.browse save-scene");
    seesAnother();
    click("browser.name");
    key("control+a");
    type((folder / "mine.json").string());
    enterToSave(folder / "mine.json");
    seesAnother();
    close();
    BOOST_TEST(status() == 0);
}

BOOST_AUTO_TEST_CASE(a_window_is_closed_without_saving_if_the_user_says_so)
{
    click("faces");
    type("50");
    key("enter");
    seesAnother();
    close();
    seesAnother();
    click("quit.quit!");
    BOOST_TEST(status() == 0);
}

BOOST_AUTO_TEST_CASE(a_window_of_another_size_is_filled)
{
    resize(900, 600);
    seesAnother();
    resize(1000, 700);
    seesAnother();
}

BOOST_AUTO_TEST_SUITE_END()
