#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include <tools/view/action_runner.h>
#include <tools/view/app_parts.h>
#include <tools/view/panel_layout.h>

namespace vdbcage::view {

/// The program behind a window: state, making of cages, panels and picture. It knows neither GLFW nor scripts: events,
/// actions (see verbs.h) and files come in, a picture goes out.
///
/// Its context must be current whenever it is used, and must outlive it. All of it is for one thread.
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

    /// Takes what the maker of cages has done. Call it when woken.
    void update() { actions_.update(); }
    /// Looks whether the model's file has changed; the user is then asked.
    void checkFiles();
    /// So much time has passed for what moves by itself.
    void pass(double seconds) { actions_.pass(seconds); }
    /// Something moves by itself.
    bool isAnimated() const { return parts_.isAnimated(); }

    /// There is something to draw.
    bool needsFrame();
    /// Seconds that should be between two frames at least; until then only update() is called.
    double secondsBetweenFrames() const;
    /// Draws the next frame into canvas(). \throw DeviceError
    void drawFrame();
    const draw::Canvas& canvas() const { return parts_.screen.canvas(); }
    /// What the window shows when nothing moves: draws all that is left to draw. \throw DeviceError
    draw::Picture picture();

    /// See ActionRunner.
    void waitUntilSettled() { actions_.waitUntilSettled(); }
    void waitUntilSaved() { actions_.finishSaving(); }
    /// What a script can expect, by name. \throw InputError no such name
    std::string value(const std::string& name);
    /// All these names.
    std::vector<std::string> valueNames() const;
    /// Where a widget is, or a handle in the picture such as "handle.x"; none: it is not to be seen.
    std::optional<Rectangle> widget(const std::string& name);
    /// Scrolls to a widget.
    void reveal(const std::string& name);
    Rectangle viewport() const { return parts_.viewport(); }
    /// Where the pointer is, pixels from the top left.
    Pixel pointer() const { return parts_.control.pointer(); }

    const Session& session() const { return parts_.session; }
    const Planner& planner() const { return parts_.making.planner(); }
    const std::vector<std::string>& messages() const { return parts_.messages; }
    /// The user wants to go, and has been asked about unsaved work.
    bool isEnded() const { return parts_.isEnded; }
    /// The name of what is worked on, for the window's title.
    std::string title() const;
    PointerShape pointerShape() const { return parts_.widgets.pointerShape(); }

private:
    void press(const KeyDown& down, const Modifiers& modifiers, bool isMessage);
    std::optional<Rectangle> handlePlace(const std::string& name) const;

    AppParts parts_;
    ActionRunner actions_{parts_};
    PanelLayout panels_{parts_, actions_};
};

} // namespace vdbcage::view
