#pragma once

#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include <tools/view/state/state.h>

/// Commands change the state. The window, keys and scripts do nothing but make them. Each has a text form of one line.
namespace vdbcage::view {

/// open FILE: another model, whose cage is made.
struct OpenModel {
    std::string path;
};
/// open-cage FILE: a cage instead of one that is made.
struct OpenCage {
    std::string path;
};
/// close-cage: back to the cage that the options make.
struct CloseCage {};
/// set OPTION VALUE, as `vdbcage make --OPTION VALUE`. A cage that was opened gives way to the one that is made.
struct SetOption {
    std::string name, value;
};
/// reset [OPTION...]: options as they are by default; all if none is named.
struct ResetOptions {
    std::vector<std::string> names;
};
/// preset NAME: the options of a preset; those that it does not name are reset.
struct ApplyPreset {
    std::string name; ///< of a preset of ours, or a file's path
};

/// coordinates FAMILY: by which the model follows the cage; one of coordinateFamilies().
struct SetCoordinates {
    Coordinates family{};
};
/// open-weights FILE: the model follows the cage by weights from a file.
struct OpenWeights {
    std::string path;
};
/// material NU global|local LOCAL GLOBAL: what Somigliana coordinates move (see Elasticity).
struct SetMaterial {
    Elasticity elasticity;
};
/// move X Y Z: what is selected, in world units.
struct MoveSelected {
    openvdb::Vec3d by{0};
};
/// rotate X Y Z DEGREES PX PY PZ: what is selected, around the axis X Y Z through the point PX PY PZ.
struct RotateSelected {
    openvdb::Vec3d axis{0, 0, 1}; ///< not zero
    double degrees = 0;
    openvdb::Vec3d pivot{0};
};
/// scale FX FY FZ PX PY PZ [X Y Z X Y Z]: what is selected, from the point PX PY PZ, along the axes of the world or
/// along two others that are at right angles, and the one at right angles to both.
struct ScaleSelected {
    openvdb::Vec3d factors{1};
    openvdb::Vec3d pivot{0};
    std::array<openvdb::Vec3d, 2> axes{openvdb::Vec3d(1, 0, 0), openvdb::Vec3d(0, 1, 0)};
};
/// edit-cage split|collapse|flip|merge|cut: what is selected of the cage at rest, in mode shape.
struct EditCage {
    CageEdit edit{};
};
/// reset-pose all|selected: back to where it is at rest, at the view's frame.
struct ResetPose {
    bool onlySelected = false;
};
/// open-pose FILE: the cage that is shown, posed; at the view's frame.
struct OpenPose {
    std::string path;
};
/// open-poses FILE [FRAMES]: a sequence of posed cages, or a file of parameters, in place of all poses.
struct OpenPoses {
    std::string path;
    int frames = 25; ///< of a file of parameters, 1 to lastFrame + 1
};
/// set-key FRAME [NAME]: what is seen at the frame becomes a key of the time line, if it is none yet, and gets the
/// name.
struct SetKey {
    int frame = 0;
    std::optional<std::string> name = {}; ///< none: as it is
};
/// delete-key FRAME
struct DeleteKey {
    int frame = 0;
};
/// move-key FROM TO: from one frame to another that has no key.
struct MoveKey {
    int from = 0, to = 0;
};
/// in-betweens FRAMES: so many frames from rest to the pose that is seen, in place of all poses.
struct MakeInBetweens {
    int frames = 25; ///< 2 to lastFrame + 1
};
/// clear-poses: all is at rest.
struct ClearPoses {};

/// camera PROJECTION UP AZIMUTH ELEVATION X Y Z DISTANCE (see draw::Camera).
struct SetCamera {
    draw::Camera camera;
};
/// layer NAME on|off
struct ShowLayer {
    LayerId layer{};
    bool shown = true;
};
/// opacity NAME VALUE, 0 to 1
struct FadeLayer {
    LayerId layer{};
    double opacity = 1;
};
/// colour NAME RED GREEN BLUE, each 0 to 1
struct ColourLayer {
    LayerId layer{};
    draw::Colour colour{};
};
/// cage-colours plain|kinds|distance
struct SetCageColours {
    CageColours colours{};
};
/// model-colours plain|influence|stretch|inverted
struct SetModelColours {
    ModelColours colours{};
};
/// section off | section X Y Z OFFSET (see SectionPlane)
struct SetSection {
    std::optional<SectionPlane> section;
};
/// ground on|off
struct ShowGround {
    bool shown = true;
};
/// axes on|off
struct ShowAxes {
    bool shown = true;
};
/// turntable on|off
struct SetTurntable {
    bool on = true;
};
/// times on|off
struct ShowTimes {
    bool shown = true;
};
/// select points|edges|faces [NUMBER...]: parts of the cage, or none of them. Faces count triangles first; edges are in
/// the order of their two points.
struct Select {
    edit::Selection selection;
};
/// mode shape|pose
struct SetMode {
    Mode mode{};
};
/// tool select|move|rotate|scale
struct SetTool {
    Tool tool{};
};
/// orientation world|local|normal|view
struct SetOrientation {
    Orientation orientation{};
};
/// pivot mean|box|origin | pivot X Y Z: what is turned and scaled by hand turns about it (see Pivot).
struct SetPivot {
    Pivot pivot;
};
/// see-through on|off
struct SetSeeThrough {
    bool on = true;
};
/// soft RADIUS: what is near to what is selected, along the cage's surface, moves too, less and less; 0: off.
struct SetSoft {
    double radius = 0; ///< a part of the model's longest side
};
/// compare off | compare FAMILY: a second picture beside the first has the model by another family, in mode pose.
struct Compare {
    std::optional<Coordinates> family;
};
/// time FRAME: whose pose is seen.
struct SetFrame {
    int frame = 0;
};
/// play on|off: frames follow each other.
struct Play {
    bool on = true;
};
/// rate FRAMES: so many a second, 1 to 240.
struct SetRate {
    double framesPerSecond = 24;
};
/// mirror off | mirror x|y|z OFFSET: what is done on one side of a plane across an axis is done on the other too, to
/// points that have a partner there, exactly.
struct SetMirror {
    std::optional<SymmetryPlane> plane;
};

using Command = std::variant<OpenModel, OpenCage, CloseCage, SetOption, ResetOptions, ApplyPreset, SetCoordinates,
                             OpenWeights, SetMaterial, MoveSelected, RotateSelected, ScaleSelected, EditCage, ResetPose,
                             OpenPose, OpenPoses, SetKey, DeleteKey, MoveKey, MakeInBetweens, ClearPoses, SetCamera,
                             ShowLayer, FadeLayer, ColourLayer, SetCageColours, SetModelColours, SetSection, ShowGround,
                             ShowAxes, SetTurntable, ShowTimes, Select, SetMode, SetTool, SetOrientation, SetPivot,
                             SetSeeThrough, SetSoft, SetMirror, Compare, SetFrame, Play, SetRate>;

/// Whether it changes the document; else it changes the view.
bool changesDocument(const Command& command);

/// Its line, without a line break; commandOf gives an equal command back.
std::string toText(const Command& command);

/// The command in `words` (see wordsOf). \throw InputError naming the command, the value and what is allowed
Command commandOf(const std::vector<std::string>& words);

/// Whether a command begins with `word`.
bool isCommand(const std::string& word);

/// How each command is written, and what it does in one line: (usage, help), for help and docs.
std::vector<std::pair<std::string, std::string>> describeCommands();

/// The commands that make this view of the default one, each layer and all.
std::vector<Command> commandsFor(const ViewState& view);

/// The state after the command. OpenModel, OpenCage, OpenPose and OpenPoses read their files. What moves or resets
/// points needs a cage that is shown. `remark` gets what the user is to know of what was done, if there is anything.
/// \throw InputError, IoError; the state is as it was
State applied(const State& state, const Command& command, std::string* remark = nullptr);

} // namespace vdbcage::view
