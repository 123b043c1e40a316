#pragma once

#include <string>
#include <type_traits>
#include <variant>
#include <vector>

#include <tools/view/state/commands/cage_options.h>
#include <tools/view/state/commands/coordinates.h>
#include <tools/view/state/commands/editing.h>
#include <tools/view/state/commands/fitting.h>
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
///     static T of(const ViewState& view); // a T for this view, a value that converts to T, or a vector of T
namespace vdbcage::view {

/// All commands, in the order of help.
using Command =
    std::variant<OpenModel, OpenCage, CloseCage, SetOption, ResetOptions, ApplyPreset, SetCoordinates, OpenWeights,
                 SetMaterial, MoveSelected, RotateSelected, ScaleSelected, EditCage, FitCage, LockPoints, UnlockPoints,
                 ResetPose, OpenPose, OpenPoses, SetKey, DeleteKey, MoveKey, MakeInBetweens, ClearPoses, SetCamera,
                 ShowLayer, FadeLayer, ColourLayer, SetCageColours, SetModelColours, SetSection, ShowGround, ShowAxes,
                 SetTurntable, ShowTimes, Select, SetMode, SetTool, SetOrientation, SetPivot, SetSeeThrough, SetSoft,
                 SetMirror, Compare, SetFrame, Play, SetRate>;

/// Whether a command of this type changes the view; else it changes the document.
template <class T>
constexpr bool changesView = std::is_invocable_v<decltype(&T::apply), const T&, ViewState&>;

/// Returns whether it changes the document; else it changes the view.
bool changesDocument(const Command& command);

/// Returns its line, without a line break; commandOf makes an equal command of it.
std::string toText(const Command& command);

/// Returns the command in `words` (see wordsOf). \throw InputError naming the command, the value and the allowed values
Command commandOf(const Words& words);

/// Returns the command in `words`; none: no command has that name. \throw as commandOf
std::optional<Command> tryCommandOf(const Words& words);

/// Returns the syntax of each command and a line of help, for help and docs.
LineHelp describeCommands();

/// Returns the commands that turn the default view into this one, including each layer.
std::vector<Command> commandsFor(const ViewState& view);

/// Returns the state after the command. OpenModel, OpenCage, OpenPose and OpenPoses read their files. `cage` is the
/// shown one: commands that move or reset points need it. `remark` gets a note for the user, if there is one.
/// \throw InputError, IoError; the state is unchanged
State applied(const State& state, const Command& command, const PosableCagePtr& cage = nullptr,
              std::string* remark = nullptr);

} // namespace vdbcage::view
