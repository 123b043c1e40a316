#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include <tools/view/files/model_watch.h>
#include <tools/view/files/saver.h>
#include <tools/view/jobs/making.h>
#include <tools/view/panels/panels.h>
#include <tools/view/picture/picture_control.h>
#include <tools/view/screen.h>
#include <tools/view/state/animation.h>
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

/// The parts of the program behind a window, and what is known beside them. The parts do not know each other.
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

    Document saved; ///< as it was last saved, or opened
    std::vector<std::filesystem::path> recentFiles;
    KeyMap keys{};
    std::vector<std::string> messages; ///< that wait to be dismissed
    std::string note;                  ///< what was done last; empty: nothing yet
    bool isValueDragged = false;       ///< of an option, by its slider or the like
    bool asksToQuit = false, isEnded = false;
    bool arePanelsCurrent = false; ///< they show the state as it is

    bool isSaved() const { return session.state().document == saved; }
    /// What is dragged is of the frame and the camera at which that began.
    bool isAnimated() const { return Animation::isAnimated(session.state()) && !session.isDragging(); }
    /// While a value is dragged the processor is for the cages that follow it, not for fine pictures or many.
    bool awaitsCage() const { return isValueDragged && !making.planner().isSettled(); }
    /// There will be another frame in a moment.
    bool isMoving() const { return control.isCameraDragged() || control.isMoving() || isAnimated() || awaitsCage(); }

    /// Where the picture is in the window, or both of them.
    Rectangle viewport() const;
    /// The one that what is done with the pointer belongs to.
    Rectangle pictureInUse() const;

    void chooseKeys(KeyMap map);
    /// Brings what is made and what is seen in line with the state; the panels follow when they are needed.
    void refresh();
    void say(const std::string& text);
    /// A message, which waits to be dismissed.
    void complain(const std::string& text);
};

} // namespace vdbcage::view
