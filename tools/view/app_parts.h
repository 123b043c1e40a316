#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include <tools/view/files/model_watch.h>
#include <tools/view/files/saver.h>
#include <tools/view/making.h>
#include <tools/view/panels/panels.h>
#include <tools/view/picture/picture_control.h>
#include <tools/view/screen.h>
#include <tools/view/state/animation.h>
#include <tools/view/widgets/widgets.h>

namespace vdbcage::view {

/// The settings that a window starts with.
struct AppSetup {
    int width = 1280, height = 800; ///< pixels
    float scale = 1;                ///< pixels per unit of length
    bool isSoftware = false;        ///< the CPU draws
    Clipboard clipboard = {};
    std::function<void()> wake = [] {};                  ///< called from any thread when update() has something to do
    std::filesystem::path recentFiles = {};              ///< their list; empty: none is kept
    std::filesystem::path preferences = {};              ///< their file; empty: the defaults, and nothing is kept
    std::unique_ptr<CageMaker> maker = {};               ///< null: pipelines
    Binder::Work binding = {};                           ///< empty: by the library
    std::function<void(const std::string&)> record = {}; ///< gets each line that the user's actions amount to
};

/// The parts of the program behind a window, and the data beside them. Parts know only those passed to their
/// constructors.
struct AppParts {
    /// `attempt`, `endDrag`: see PictureControl. \throw DeviceError
    AppParts(const gl::Api& api, AppSetup given, std::function<void(const Command&)> attempt,
             std::function<void()> endDrag);

    AppSetup setup;
    Session session;
    Making making;
    Saver saver;
    ModelWatch watch;
    Animation animation;
    Widgets widgets;
    Panels panels;
    Screen screen;
    PictureControl control;

    Document saved; ///< when last saved or opened
    std::vector<std::filesystem::path> recentFiles;
    KeyMap keys{};
    std::vector<std::string> messages; ///< waiting to be dismissed
    std::string note;                  ///< the last thing done; empty: nothing yet
    bool isValueDragged = false;       ///< an option's, by its slider or the like
    bool asksToQuit = false, isEnded = false;
    bool arePanelsCurrent = false; ///< they show the present state

    bool isSaved() const { return session.state().document == saved; }
    /// Returns whether a turntable or poses are moving. They stand still in a drag, which belongs to its first frame
    /// and camera.
    bool isAnimated() const { return Animation::isAnimated(session.state()) && !session.isDragging(); }
    /// Returns whether cages are following a dragged value: they need the processor more than many or refined pictures
    /// do.
    bool awaitsCage() const { return isValueDragged && !making.planner().isSettled(); }
    /// Returns whether another frame will follow in a moment.
    bool isMoving() const { return control.isCameraDragged() || control.hasGrip() || isAnimated() || awaitsCage(); }

    /// Returns the place of the picture in the window, or of both pictures.
    Rectangle picturePlace() const;
    /// Returns the place of the picture in which the pointer acts.
    Rectangle pictureInUse() const;

    void chooseKeys(KeyMap map);
    /// Updates results and pictures to the state; the panels follow when they are needed.
    void refresh();
    void say(const std::string& text);
    /// Adds a message, which waits to be dismissed.
    void complain(const std::string& text);
};

} // namespace vdbcage::view
