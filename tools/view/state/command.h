#pragma once

#include <string>
#include <type_traits>
#include <variant>
#include <vector>

#include <tools/view/state/commands/cage_options.h>
#include <tools/view/state/commands/coordinates.h>
#include <tools/view/state/commands/editing.h>
#include <tools/view/state/commands/looks.h>
#include <tools/view/state/commands/model_and_cage.h>
#include <tools/view/state/commands/playing.h>
#include <tools/view/state/commands/poses.h>
#include <tools/view/state/commands/selected.h>

/// Commands change the state. Window, keys and scripts only make commands.
///
/// A command is a line (see line.h) that has an effect, on the document or on the view. Its signature says which:
///
///     void apply(Document& document, const Situation& now) const;
///
///     void apply(ViewState& view) const;
///     static T of(const ViewState& view); // what makes this view; what T is made of is enough, or a vector of T
namespace vdbcage::view {

/// In the order of help.
using Command = std::variant<OpenModel, OpenCage, CloseCage, SetOption, ResetOptions, ApplyPreset, SetCoordinates,
                             OpenWeights, SetMaterial, MoveSelected, RotateSelected, ScaleSelected, EditCage, ResetPose,
                             OpenPose, OpenPoses, SetKey, DeleteKey, MoveKey, MakeInBetweens, ClearPoses, SetCamera,
                             ShowLayer, FadeLayer, ColourLayer, SetCageColours, SetModelColours, SetSection, ShowGround,
                             ShowAxes, SetTurntable, ShowTimes, Select, SetMode, SetTool, SetOrientation, SetPivot,
                             SetSeeThrough, SetSoft, SetMirror, Compare, SetFrame, Play, SetRate>;

/// Whether a command of this type changes the view; else it changes the document.
template <class T>
constexpr bool changesView = std::is_invocable_v<decltype(&T::apply), const T&, ViewState&>;

/// Whether it changes the document; else it changes the view.
bool changesDocument(const Command& command);

/// Its line, without a line break; commandOf gives an equal command back.
std::string toText(const Command& command);

/// The command in `words` (see wordsOf). \throw InputError naming the command, the value and what is allowed
Command commandOf(const Words& words);

/// None: no command has that name. \throw as commandOf
std::optional<Command> tryCommandOf(const Words& words);

/// How each command is written, and what it does in one line, for help and docs.
LineHelp describeCommands();

/// The commands that make this view of the default one, each layer and all.
std::vector<Command> commandsFor(const ViewState& view);

/// The state after the command. OpenModel, OpenCage, OpenPose and OpenPoses read their files. `cage` is the one that is
/// shown: what moves or resets points needs it. `remark` gets what the user is to know of what was done, if there is
/// anything. \throw InputError, IoError; the state is as it was
State applied(const State& state, const Command& command, const ShownCage& cage = nullptr,
              std::string* remark = nullptr);

} // namespace vdbcage::view
