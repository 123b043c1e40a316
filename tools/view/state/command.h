#pragma once

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
/// select [FACE...]: faces of the cage, triangles first; nothing if none is named.
struct Select {
    std::vector<openvdb::Index32> faces;
};

using Command =
    std::variant<OpenModel, OpenCage, CloseCage, SetOption, ResetOptions, ApplyPreset, SetCamera, ShowLayer, FadeLayer,
                 ColourLayer, SetCageColours, SetSection, ShowGround, ShowAxes, SetTurntable, ShowTimes, Select>;

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

/// The state after the command. OpenModel and OpenCage read their file.
/// \throw InputError, IoError; the state is as it was
State applied(const State& state, const Command& command);

} // namespace vdbcage::view
