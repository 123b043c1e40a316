#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <tools/draw/canvas.h>
#include <tools/draw/picture.h>
#include <tools/view/input/input.h>
#include <tools/view/jobs/binder.h>
#include <tools/view/jobs/runner.h>
#include <tools/view/panels/panels.h>
#include <tools/view/state/session.h>
#include <tools/view/widgets/widgets.h>

namespace vdbcage::view {

/// With what a window begins.
struct AppSetup {
    int width = 1280, height = 800; ///< pixels
    float scale = 1;                ///< pixels that a length of 1 has
    bool isSoftware = false;        ///< a program on the CPU draws
    Clipboard clipboard = {};
    std::function<void()> wake = [] {};                  ///< called from any thread when update() has something to do
    std::filesystem::path recentFiles = {};              ///< the list of them; empty: none is kept
    std::filesystem::path preferences = {};              ///< the file of them; empty: those by default, not kept
    std::unique_ptr<CageMaker> maker = {};               ///< null: pipelines
    Binder::Work binding = {};                           ///< empty: by the library
    std::function<void(const std::string&)> record = {}; ///< gets each line that the user's doing amounts to
};

/// The program behind a window: state, making of cages, panels and picture. It knows neither GLFW nor scripts: events,
/// actions (see verbs.h) and files come in, a picture goes out.
///
/// Its context must be current whenever it is used, and must outlive it. All of it is for one thread.
class App {
public:
    /// \throw DeviceError
    App(const gl::Api& api, AppSetup setup);
    ~App();
    App(const App&) = delete;
    App& operator=(const App&) = delete;

    /// Does it, and waits until what it saves is written. \throw Error it cannot be done; all is as it was
    void perform(const Action& action);
    /// For a user: what is wrong becomes a message.
    void attempt(const Action& action);
    void handle(const InputEvent& event);
    /// A file that is dropped on the window: a model, or a scene.
    void drop(const std::filesystem::path& path);
    /// \throw DeviceError
    void resize(int width, int height);

    /// Takes what the maker of cages has done. Call it when woken.
    void update();
    /// Looks whether the model's file has changed; the user is then asked.
    void checkFiles();
    /// So much time has passed for what moves by itself.
    void pass(double seconds);
    /// Something moves by itself.
    bool isAnimated() const;

    /// There is something to draw.
    bool needsFrame();
    /// Seconds that should be between two frames at least; until then only update() is called.
    double secondsBetweenFrames() const;
    /// Draws the next frame into canvas(). \throw DeviceError
    void drawFrame();
    const draw::Canvas& canvas() const;
    /// What the window shows when nothing moves: draws all that is left to draw. \throw DeviceError
    draw::Picture picture();

    /// Waits until the cage that is wanted is there, or cannot be had, and all that was to be written is.
    void waitUntilSettled();
    /// Waits until all that was to be written is. \throw InputError why it cannot be
    void waitUntilSaved();
    /// What a script can expect, by name. \throw InputError no such name
    std::string value(const std::string& name) const;
    /// All these names.
    std::vector<std::string> valueNames() const;
    /// Where a widget is, or a handle in the picture such as "handle.x"; none: it is not to be seen.
    std::optional<Rectangle> widget(const std::string& name) const;
    /// Scrolls to a widget.
    void reveal(const std::string& name);
    Rectangle viewport() const;
    /// Where the pointer is, pixels from the top left.
    std::array<double, 2> pointer() const;

    const Session& session() const;
    const Planner& planner() const;
    const std::vector<std::string>& messages() const;
    /// The user wants to go, and has been asked about unsaved work.
    bool isEnded() const;
    /// The name of what is worked on, for the window's title.
    std::string title() const;
    PointerShape pointerShape() const;

private:
    class Impl;
    std::unique_ptr<Impl> impl_;
};

} // namespace vdbcage::view
