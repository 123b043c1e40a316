#include <tools/view/window.h>

#include <array>
#include <cmath>
#include <cstdlib>
#include <map>
#include <utility>

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include <vdbcage/core/error.h>

namespace vdbcage::view {

namespace {

/// The most time and distance between the presses of a double click.
constexpr double secondsOfDoubleClick = 0.35, pixelsOfDoubleClick = 6;
/// The time between two checks whether files have changed.
constexpr double secondsBetweenLooks = 1;

[[noreturn]] void fail(const std::string& what)
{
    const char* words = nullptr;
    glfwGetError(&words);
    throw DeviceError(what + (words ? ": " + std::string(words) : ""));
}

gl::AnyFunction procOf(const char* name)
{
    return glfwGetProcAddress(name);
}

/// Returns the keys by GLFW's numbers.
const std::map<int, Key>& keys()
{
    static const std::map<int, Key> list = [] {
        std::map<int, Key> made;
        const auto row = [&](int first, Key key, int count) {
            for (int i = 0; i < count; ++i) made[first + i] = static_cast<Key>(static_cast<int>(key) + i);
        };
        row(GLFW_KEY_A, Key::a, 26);
        row(GLFW_KEY_0, Key::digit0, 10);
        row(GLFW_KEY_F1, Key::f1, 12);
        row(GLFW_KEY_KP_0, Key::keypad0, 10);
        const std::map<int, Key> others{{GLFW_KEY_LEFT, Key::left},
                                        {GLFW_KEY_RIGHT, Key::right},
                                        {GLFW_KEY_UP, Key::up},
                                        {GLFW_KEY_DOWN, Key::down},
                                        {GLFW_KEY_PAGE_UP, Key::pageUp},
                                        {GLFW_KEY_PAGE_DOWN, Key::pageDown},
                                        {GLFW_KEY_HOME, Key::home},
                                        {GLFW_KEY_END, Key::end},
                                        {GLFW_KEY_INSERT, Key::insert},
                                        {GLFW_KEY_DELETE, Key::del},
                                        {GLFW_KEY_BACKSPACE, Key::backspace},
                                        {GLFW_KEY_SPACE, Key::space},
                                        {GLFW_KEY_ENTER, Key::enter},
                                        {GLFW_KEY_ESCAPE, Key::escape},
                                        {GLFW_KEY_TAB, Key::tab},
                                        {GLFW_KEY_MINUS, Key::minus},
                                        {GLFW_KEY_EQUAL, Key::equal},
                                        {GLFW_KEY_COMMA, Key::comma},
                                        {GLFW_KEY_PERIOD, Key::period},
                                        {GLFW_KEY_SLASH, Key::slash},
                                        {GLFW_KEY_SEMICOLON, Key::semicolon},
                                        {GLFW_KEY_APOSTROPHE, Key::apostrophe},
                                        {GLFW_KEY_LEFT_BRACKET, Key::leftBracket},
                                        {GLFW_KEY_RIGHT_BRACKET, Key::rightBracket},
                                        {GLFW_KEY_BACKSLASH, Key::backslash},
                                        {GLFW_KEY_GRAVE_ACCENT, Key::grave},
                                        {GLFW_KEY_KP_ENTER, Key::keypadEnter},
                                        {GLFW_KEY_KP_ADD, Key::keypadAdd},
                                        {GLFW_KEY_KP_SUBTRACT, Key::keypadSubtract},
                                        {GLFW_KEY_KP_MULTIPLY, Key::keypadMultiply},
                                        {GLFW_KEY_KP_DIVIDE, Key::keypadDivide},
                                        {GLFW_KEY_KP_DECIMAL, Key::keypadDecimal}};
        made.insert(others.begin(), others.end());
        return made;
    }();
    return list;
}

/// Returns the key by its label: letters may have other places than on an American keyboard.
std::optional<Key> keyOf(int key, int scancode)
{
    if (const char* const name = glfwGetKeyName(key, scancode); name && name[0] >= 'a' && name[0] <= 'z' && !name[1]) {
        return static_cast<Key>(static_cast<int>(Key::a) + (name[0] - 'a'));
    }
    const auto found = keys().find(key);
    if (found == keys().end()) return std::nullopt;
    return found->second;
}

} // namespace

struct Window::State {
    GLFWwindow* window = nullptr;
    std::optional<gl::Api> api;
    std::array<GLFWcursor*, 5> cursors{};
    App* app = nullptr;               ///< while run() runs
    std::optional<PointerMoved> move; ///< not passed on yet: a mouse moves more often than frames are drawn
    Modifiers modifiers;
    double pressedAt = -1, pressedX = 0, pressedY = 0, pointerX = 0, pointerY = 0;
    int clicks = 0;
    Button pressed = Button::left;

    ~State()
    {
        if (window) glfwDestroyWindow(window);
        glfwTerminate();
    }

    /// Returns the pixels per unit of the desktop's coordinates: more than one on some.
    double pixelsPerUnit() const
    {
        int pixels = 0, units = 0;
        glfwGetFramebufferSize(window, &pixels, nullptr);
        glfwGetWindowSize(window, &units, nullptr);
        return units > 0 ? 1.0 * pixels / units : 1;
    }

    template <class What>
    void send(What what)
    {
        sendMove();
        if (app) app->handle({std::move(what), modifiers});
    }

    /// Passes the pointer's last position on: further events happen there.
    void sendMove()
    {
        if (!move) return;
        const PointerMoved where = *std::exchange(move, std::nullopt);
        if (app) app->handle({where, modifiers});
    }

    void setModifiers(int bits)
    {
        sendMove(); // the motion was made with the previous modifiers
        modifiers.shift = (bits & GLFW_MOD_SHIFT) != 0;
        modifiers.control = (bits & GLFW_MOD_CONTROL) != 0;
        modifiers.alt = (bits & GLFW_MOD_ALT) != 0;
    }

    void button(int number, int action)
    {
        if (number > GLFW_MOUSE_BUTTON_MIDDLE) return;
        const Button which = number == GLFW_MOUSE_BUTTON_LEFT    ? Button::left
                             : number == GLFW_MOUSE_BUTTON_RIGHT ? Button::right
                                                                 : Button::middle;
        if (action == GLFW_RELEASE) return send(ButtonUp{which});
        const double now = glfwGetTime();
        const bool isNext = which == pressed && now - pressedAt < secondsOfDoubleClick &&
                            std::hypot(pointerX - pressedX, pointerY - pressedY) < pixelsOfDoubleClick;
        clicks = isNext ? clicks + 1 : 1;
        pressed = which;
        pressedAt = now;
        pressedX = pointerX;
        pressedY = pointerY;
        send(ButtonDown{which, clicks});
    }

    void setCallbacks();
    void present();
};

namespace {

Window::State& stateOf(GLFWwindow* window)
{
    return *static_cast<Window::State*>(glfwGetWindowUserPointer(window));
}

} // namespace

void Window::State::setCallbacks()
{
    glfwSetWindowUserPointer(window, this);
    glfwSetCursorPosCallback(window, [](GLFWwindow* w, double x, double y) {
        State& state = stateOf(w);
        const double pixels = state.pixelsPerUnit();
        state.pointerX = x * pixels;
        state.pointerY = y * pixels;
        state.move = PointerMoved{state.pointerX, state.pointerY};
    });
    glfwSetCursorEnterCallback(window, [](GLFWwindow* w, int entered) {
        if (!entered) stateOf(w).send(PointerLeft{});
    });
    glfwSetMouseButtonCallback(window, [](GLFWwindow* w, int number, int action, int bits) {
        stateOf(w).setModifiers(bits);
        stateOf(w).button(number, action);
    });
    glfwSetScrollCallback(window, [](GLFWwindow* w, double x, double y) { stateOf(w).send(WheelTurned{x, y}); });
    glfwSetKeyCallback(window, [](GLFWwindow* w, int number, int scancode, int action, int bits) {
        State& state = stateOf(w);
        state.setModifiers(bits);
        const auto key = keyOf(number, scancode);
        if (!key) return;
        if (action == GLFW_RELEASE) {
            state.send(KeyUp{*key});
        } else {
            state.send(KeyDown{*key});
        }
    });
    glfwSetCharCallback(window, [](GLFWwindow* w, unsigned character) { stateOf(w).send(Typed{character}); });
    glfwSetDropCallback(window, [](GLFWwindow* w, int count, const char** paths) {
        State& state = stateOf(w);
        for (int i = 0; i < count && state.app; ++i) state.app->drop(paths[i]);
    });
    glfwSetFramebufferSizeCallback(window, [](GLFWwindow* w, int width, int height) {
        State& state = stateOf(w);
        if (state.app && width > 0 && height > 0) state.app->resize(width, height);
    });
    glfwSetWindowCloseCallback(window, [](GLFWwindow* w) {
        glfwSetWindowShouldClose(w, GLFW_FALSE);
        if (App* const shown = stateOf(w).app) shown->attempt(Quit{});
    });
    glfwSetWindowFocusCallback(window, [](GLFWwindow* w, int focused) {
        if (App* const shown = stateOf(w).app; focused && shown) shown->checkFiles();
    });
    glfwSetWindowRefreshCallback(window, [](GLFWwindow* w) { stateOf(w).present(); });
}

/// Copies the app's canvas to the window.
void Window::State::present()
{
    if (!app) return;
    const draw::Target from = app->canvas().target();
    api->Disable(GL_SCISSOR_TEST);
    api->BlitNamedFramebuffer(from.framebuffer, 0, 0, 0, from.width, from.height, 0, 0, from.width, from.height,
                              GL_COLOR_BUFFER_BIT, GL_NEAREST);
    glfwSwapBuffers(window);
}

Window::Window(int width, int height)
{
    glfwSetErrorCallback(nullptr);
#ifdef GLFW_PLATFORM // since 3.4 it tries Wayland first, whose library writes to standard error where there is none
    const bool mayHaveWayland = std::getenv("WAYLAND_DISPLAY") || std::getenv("XDG_RUNTIME_DIR");
    if (!mayHaveWayland) glfwInitHint(GLFW_PLATFORM, GLFW_PLATFORM_X11);
#endif
    if (!glfwInit()) fail("there is no display to open a window on");
    state_ = std::make_unique<State>();
    glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 4);
    glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 5);
    glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
    glfwWindowHint(GLFW_DEPTH_BITS, 0); // the picture is drawn elsewhere and copied
    glfwWindowHint(GLFW_STENCIL_BITS, 0);
    glfwWindowHint(GLFW_SCALE_TO_MONITOR, GLFW_TRUE);
    state_->window = glfwCreateWindow(width, height, "vdbcage", nullptr, nullptr);
    if (!state_->window) fail("a window with OpenGL 4.5 cannot be opened");
    glfwMakeContextCurrent(state_->window);
    glfwSwapInterval(1);
    state_->api.emplace(procOf);
    constexpr std::array<int, 5> shapes{GLFW_ARROW_CURSOR, GLFW_IBEAM_CURSOR, GLFW_HAND_CURSOR, GLFW_HRESIZE_CURSOR,
                                        GLFW_VRESIZE_CURSOR};
    for (std::size_t i = 0; i < shapes.size(); ++i) state_->cursors[i] = glfwCreateStandardCursor(shapes[i]);
    state_->setCallbacks();
}

Window::~Window() = default;

const gl::Api& Window::api() const
{
    return *state_->api;
}

AppSetup Window::setup() const
{
    AppSetup setup;
    glfwGetFramebufferSize(state_->window, &setup.width, &setup.height);
    float scale = 1;
    glfwGetWindowContentScale(state_->window, &scale, nullptr);
    setup.scale = std::min(8.0F, std::max(0.5F, scale));
    setup.isSoftware = gl::driverOf(api()).isSoftware;
    GLFWwindow* const window = state_->window;
    setup.clipboard = {[window] {
                           const char* const text = glfwGetClipboardString(window);
                           return std::string(text ? text : "");
                       },
                       [window](const std::string& text) { glfwSetClipboardString(window, text.c_str()); }};
    setup.wake = [] { glfwPostEmptyEvent(); };
    return setup;
}

void Window::show(App& app)
{
    state_->app = &app;
    glfwPollEvents();
    state_->sendMove();
    state_->present();
    state_->app = nullptr;
}

void Window::run(App& app)
{
    State& state = *state_;
    state.app = &app;
    std::string title;
    double last = glfwGetTime(), looked = last, drawn = 0;
    while (!app.isEnded()) {
        if (const std::string now = app.title(); now != title) {
            title = now;
            glfwSetWindowTitle(state.window, title.c_str());
        }
        glfwSetCursor(state.window, state.cursors[static_cast<std::size_t>(app.pointerShape())]);
        const double rest = drawn + app.secondsBetweenFrames() - glfwGetTime();
        if (rest > 0) {
            glfwWaitEventsTimeout(rest);
        } else {
            state.sendMove();
            if (app.needsFrame() || app.isAnimated()) {
                app.drawFrame();
                state.present();
                drawn = glfwGetTime();
                glfwPollEvents();
            } else {
                glfwWaitEventsTimeout(secondsBetweenLooks);
            }
        }
        app.update();
        const double now = glfwGetTime();
        app.pass(now - last);
        last = now;
        if (now - looked >= secondsBetweenLooks) {
            looked = now;
            app.checkFiles();
        }
    }
    state.app = nullptr;
}

} // namespace vdbcage::view
