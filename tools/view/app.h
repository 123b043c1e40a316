#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include <tools/view/action_runner.h>
#include <tools/view/app_parts.h>
#include <tools/view/panel_driver.h>

namespace vdbcage::view {

/// The program behind a window: state, making of cages, panels and picture. It knows neither GLFW nor scripts: events,
/// actions (see verbs.h) and files come in, a picture goes out.
///
/// Its context must be current in each call, and must outlive it. Use it from one thread.
class App {
public:
    /// \throw DeviceError
    App(const gl::Api& api, AppSetup setup);
    App(const App&) = delete;
    App& operator=(const App&) = delete;

    /// See ActionRunner.
    void perform(const Action& action) { actions_.perform(action); }
    void attempt(const Action& action) { actions_.attempt(action); }
    void drop(const std::filesystem::path& path) { actions_.drop(path); }
    void handle(const InputEvent& event);
    /// \throw DeviceError
    void resize(int width, int height);

    /// Takes the results of other threads. Call it when woken.
    void update() { actions_.update(); }
    /// Checks whether the model's file has changed; if so, asks the user.
    void checkFiles();
    /// Advances animations by that time.
    void pass(double seconds) { actions_.pass(seconds); }
    /// Returns whether a turntable or poses are moving.
    bool isAnimated() const { return parts_.isAnimated(); }

    /// Returns whether there is something to draw.
    bool needsFrame();
    /// Returns the least time between two frames, in seconds; between them only update() is called.
    double secondsBetweenFrames() const;
    /// Draws the next frame into canvas(). \throw DeviceError
    void drawFrame();
    const draw::Canvas& canvas() const { return parts_.screen.canvas(); }
    /// Returns the window's picture at rest: draws all that is left to draw. \throw DeviceError
    draw::Picture picture();

    /// See ActionRunner.
    void waitUntilSettled() { actions_.waitUntilSettled(); }
    void waitUntilSaved() { actions_.finishSaving(); }
    /// Returns the value of that name, for a script's `expect`. \throw InputError no such name
    std::string value(const std::string& name);
    /// Returns the names of all values.
    std::vector<std::string> valueNames() const;
    /// Returns the place of a widget, or of a handle in the picture such as "handle.x"; none: it is invisible.
    std::optional<Rectangle> widget(const std::string& name);
    /// Scrolls to a widget.
    void reveal(const std::string& name);
    /// See AppParts.
    Rectangle picturePlace() const { return parts_.picturePlace(); }
    /// Returns the pointer's position, in pixels from the top left.
    Pixel pointer() const { return parts_.control.pointer(); }

    const Session& session() const { return parts_.session; }
    const Planner& planner() const { return parts_.making.planner(); }
    const std::vector<std::string>& messages() const { return parts_.messages; }
    /// Returns whether the user has quit, after the question about unsaved work.
    bool isEnded() const { return parts_.isEnded; }
    /// Returns the window's title: the names of the model and the program.
    std::string title() const;
    PointerShape pointerShape() const { return parts_.widgets.pointerShape(); }

private:
    void press(const KeyDown& down, const Modifiers& modifiers, bool isMessage);
    std::optional<Rectangle> handlePlace(const std::string& name) const;

    AppParts parts_;
    ActionRunner actions_{parts_};
    PanelDriver panels_{parts_, actions_};
};

} // namespace vdbcage::view
