#pragma once

#include <array>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <openvdb/math/Vec3.h>
#include <tools/view/input/key_map.h>
#include <tools/view/jobs/planner.h>
#include <tools/view/jobs/runner.h>
#include <tools/view/picture/picture_overlay.h>
#include <tools/view/picture/rectangle.h>
#include <tools/view/posing/pose_checker.h>
#include <tools/view/state/cage_changes.h>
#include <tools/view/state/session.h>

namespace vdbcage::view {

/// The numbers of points, edges and faces of a mesh.
struct Counts {
    std::size_t points = 0, edges = 0, faces = 0;
};

/// The content of the panels. They own none of it.
struct PanelContent {
    const Session& session;
    const Planner& planner;
    std::optional<Progress> progress;
    const std::vector<std::string>& messages; ///< the first is shown
    const std::string& note;                  ///< the last thing done; empty: nothing yet
    const std::vector<Shortcut>& shortcuts;
    const std::vector<std::filesystem::path>& recentFiles;
    std::array<openvdb::Vec3d, 3> axes{}; ///< x, y and z as seen: to the right, up, to the viewer
    double gridStep = 0;                  ///< world units
    double largestDistance = 0;           ///< of the colours, as a fraction of the model's longest side; 0: none
    std::optional<Counts> model = {}, cage = {};
    std::optional<openvdb::math::BBox<openvdb::Vec3d>> box = {}; ///< of the model
    PictureOverlay overlay = {};
    std::vector<Rectangle> pictures = {};     ///< of the window: one, or two side by side
    std::optional<WorkProgress> binding = {}; ///< none: nothing is being bound
    bool isPosedCoarsely = false;             ///< a stand-in is shown, as not all points are bound yet
    std::string bindingError = {};            ///< empty: none
    KeyMap keys{};                            ///< the map of the shortcuts
    std::optional<SelectionFrame> selected{}; ///< its axes are not used; none: nothing is selected
    bool isPosed = false;                     ///< the cage is not at rest
    bool hasMaterial = false;                 ///< see Posing
    bool isPoseChecked = false;               ///< a check is under way
    PoseCheckPtr poseCheck = {};              ///< null: the pose is not checked, or not yet
    std::optional<WorkProgress> saving = {};  ///< none: nothing is being written
    bool hasModelChanged = false;             ///< on disk
    bool asksToQuit = false;                  ///< there is unsaved work
};

/// The user's answers: actions, the beginning and end of a drag of a value, and errors of typed texts.
struct PanelAnswer {
    std::vector<Action> actions;
    bool beginsDrag = false, endsDrag = false;
    std::vector<std::string> problems;
};

/// All panels of the window. Every usable widget has a name, by which scripts and tests find it.
class Panels {
public:
    Panels();
    ~Panels();
    Panels(const Panels&) = delete;
    Panels& operator=(const Panels&) = delete;

    /// Builds the panels, for Widgets::Build. Adds the user's actions to `answer`.
    void build(const PanelContent& content, PanelAnswer& answer);

    /// Returns the place of the picture in a window of that size, with the time line or without.
    static Rectangle picturePlace(int width, int height, float scale, bool hasTimeLine);

    /// Returns the places of the last layout's widgets by name.
    const std::map<std::string, Rectangle>& places() const;
    /// Scrolls to the widget in the next layout.
    void reveal(const std::string& name);

    /// Asks for a file, and then performs the line with it. \throw InputError it is no line that takes a file
    void browse(const std::string& line);
    void showHelp();
    /// Closes the topmost open part. Returns whether there was one.
    bool dismiss();

private:
    struct State;
    std::unique_ptr<State> state_;
};

} // namespace vdbcage::view
