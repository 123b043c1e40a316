#pragma once

#include <optional>
#include <string>
#include <type_traits>
#include <variant>

#include <tools/view/files/preferences.h>
#include <tools/view/files/save_verbs.h>
#include <tools/view/state/command.h>

/// Verbs are the lines (see line.h) beside the commands: the actions of menus and keys. Some amount to a command:
///
///     Command command(const Situation& now) const; // \throw InputError naming the missing thing
///
/// The app performs the others. Those that a recording needs have: static constexpr bool isRecorded = true.
namespace vdbcage::view {

struct Undo {
    static constexpr bool isRecorded = true;
    static LineInfo info() { return {"undo", "", 0, 0, "takes back the last change of options or files"}; }
};
struct Redo {
    static constexpr bool isRecorded = true;
    static LineInfo info() { return {"redo", "", 0, 0, "makes the change again that was undone"}; }
};
struct UndoView {
    static constexpr bool isRecorded = true;
    static LineInfo info() { return {"undo-view", "", 0, 0, "takes back the last change of the view"}; }
};
struct RedoView {
    static constexpr bool isRecorded = true;
    static LineInfo info() { return {"redo-view", "", 0, 0, "does it again"}; }
};
struct MakeAgain {
    static constexpr bool isRecorded = true;
    static LineInfo info() { return {"make", "", 0, 0, "makes the cage that was cancelled or failed"}; }
};
struct Cancel {
    static constexpr bool isRecorded = true;
    static LineInfo info()
    {
        return {"cancel", "", 0, 0, "closes a menu or dialog, or stops writing, making or binding"};
    }
};
struct MoreFaces {
    static LineInfo info() { return {"more", "", 0, 0, "a twentieth more faces"}; }
    static Command command(const Situation& now);
};
struct FewerFaces {
    static LineInfo info() { return {"fewer", "", 0, 0, "a twentieth fewer faces"}; }
    static Command command(const Situation& now);
};
struct Toggle {
    std::string what;

    static LineInfo info()
    {
        return {"toggle", "LAYER|ground|axes|turntable|mode|play|see-through|mirror-x|mirror-y|mirror-z", 1, 1,
                "shows a hidden layer and hides a shown one"};
    }
    static Toggle read(const Arguments& arguments) { return {arguments[0]}; }
    std::string text() const { return written(what); }
    Command command(const Situation& now) const;
};
struct FrameView {
    bool onlySelected = false;

    static LineInfo info() { return {"frame", "all|selected", 1, 1, "moves the view so that all is seen"}; }
    static FrameView read(const Arguments& arguments) { return {arguments.choice<int>(0, parts) == 1}; }
    std::string text() const { return written(nameIn(parts, onlySelected)); }

private:
    static constexpr std::array<const char*, 2> parts{"all", "selected"};
};
struct Look {
    enum class From : std::uint8_t { front, back, left, right, top, bottom };
    static constexpr std::array<const char*, 6> names{"front", "back", "left", "right", "top", "bottom"};
    From from{};

    static LineInfo info() { return {"look", "front|back|left|right|top|bottom", 1, 1, "looks from there"}; }
    static Look read(const Arguments& arguments) { return {arguments.choice<From>(0, names)}; }
    std::string text() const { return written(nameIn(names, from)); }
    Command command(const Situation& now) const;
};
struct SetProjection {
    std::optional<draw::Projection> projection; ///< none: the other one

    static LineInfo info()
    {
        return {"projection", "perspective|orthographic|toggle", 1, 1, "the projection of the view"};
    }
    static SetProjection read(const Arguments& arguments);
    std::string text() const { return written(projection ? nameIn(projectionNames, *projection) : "toggle"); }
    Command command(const Situation& now) const;
};
struct SetUp {
    std::optional<draw::UpAxis> up; ///< none: the other one

    static LineInfo info() { return {"up", "y|z|toggle", 1, 1, "which axis points up"}; }
    static SetUp read(const Arguments& arguments);
    std::string text() const { return written(!up ? "toggle" : *up == draw::UpAxis::y ? "y" : "z"); }
    Command command(const Situation& now) const;
};
struct SelectKind {
    edit::Element kind{};

    static LineInfo info()
    {
        return {"select-kind", "points|edges|faces", 1, 1, "selects these from now on; the selection becomes such"};
    }
    static SelectKind read(const Arguments& arguments)
    {
        return {arguments.choice<edit::Element>(0, edit::elementNames)};
    }
    std::string text() const { return written(nameIn(edit::elementNames, kind)); }
    Command command(const Situation& now) const;
};
struct SelectAll {
    static LineInfo info() { return {"select-all", "", 0, 0, "selects all of the cage"}; }
    static Command command(const Situation& now);
};
struct SelectNone {
    static LineInfo info() { return {"select-none", "", 0, 0, "selects nothing"}; }
    static Command command(const Situation& now);
};
struct SelectInvert {
    static LineInfo info() { return {"select-invert", "", 0, 0, "inverts the selection"}; }
    static Command command(const Situation& now);
};
struct SelectLinked {
    static LineInfo info() { return {"select-linked", "", 0, 0, "selects the connected part of the cage"}; }
    static Command command(const Situation& now);
};
struct SelectGrow {
    static LineInfo info() { return {"select-grow", "", 0, 0, "selects the neighbours too"}; }
    static Command command(const Situation& now);
};
struct SelectShrink {
    static LineInfo info() { return {"select-shrink", "", 0, 0, "shrinks the selection by one ring"}; }
    static Command command(const Situation& now);
};
struct SelectLoop {
    static LineInfo info() { return {"select-loop", "", 0, 0, "selects the loops through the selection"}; }
    static Command command(const Situation& now);
};
struct StartBox {
    static LineInfo info() { return {"box", "", 0, 0, "selects elements in the box that is dragged next"}; }
};
struct Grab {
    Tool tool = Tool::move; ///< not select

    static LineInfo info() { return {"grab", "move|rotate|scale", 1, 1, "moves the selection with the pointer"}; }
    static Grab read(const Arguments& arguments);
    std::string text() const { return written(nameIn(toolNames, tool)); }
};
struct NextFrame {
    static LineInfo info() { return {"next-frame", "", 0, 0, "shows the pose of the next frame"}; }
    static Command command(const Situation& now);
};
struct PreviousFrame {
    static LineInfo info() { return {"previous-frame", "", 0, 0, "shows the pose of the frame before"}; }
    static Command command(const Situation& now);
};
struct NextKey {
    static LineInfo info() { return {"next-key", "", 0, 0, "goes to the next key of the time line"}; }
    static Command command(const Situation& now);
};
struct PreviousKey {
    static LineInfo info() { return {"previous-key", "", 0, 0, "goes to the key before"}; }
    static Command command(const Situation& now);
};
struct InsertKey {
    static LineInfo info() { return {"insert-key", "", 0, 0, "keeps the pose that is seen on the time line"}; }
    static Command command(const Situation& now);
};
struct RemoveKey {
    static LineInfo info() { return {"remove-key", "", 0, 0, "takes the key at this frame off the time line"}; }
    static Command command(const Situation& now);
};
struct SaveStages : SaveFile {
    using SaveFile::SaveFile;
    static LineInfo info() { return {"save-stages", "FOLDER", 1, 1, "writes every stage (.vdb, .obj)"}; }
};
struct SaveScene : SaveFile {
    using SaveFile::SaveFile;
    static LineInfo info()
    {
        return {"save-scene", "FILE.json", 1, 1,
                "writes options, view and names of files, and the cage and poses beside it"};
    }
};
struct SavePicture : SaveFile {
    using SaveFile::SaveFile;
    static LineInfo info()
    {
        return {"save-picture", "FILE.png", 1, 1,
                "writes the picture without the panels; of two pictures the left one"};
    }
};
struct OpenScene {
    static constexpr bool isRecorded = true;
    std::string path;

    static LineInfo info() { return {"open-scene", "FILE.json", 1, 1, "opens a scene of save-scene"}; }
    static OpenScene read(const Arguments& arguments) { return {arguments[0]}; }
    std::string text() const { return written(path); }
};
struct Drop {
    std::string path;

    static LineInfo info() { return {"drop", "FILE", 1, 1, "as if FILE was dropped on the window"}; }
    static Drop read(const Arguments& arguments) { return {arguments[0]}; }
    std::string text() const { return written(path); }
};
struct Reload {
    static constexpr bool isRecorded = true;
    static LineInfo info() { return {"reload", "", 0, 0, "reads the model's file anew"}; }
};
struct Browse {
    std::string line; ///< the name of a line that takes a file

    static LineInfo info() { return {"browse", "LINE", 1, 1, "asks for a file, and then does LINE with it"}; }
    static Browse read(const Arguments& arguments) { return {arguments[0]}; }
    std::string text() const { return written(line); }
};
struct ChooseKeys {
    KeyMap map{};

    static LineInfo info()
    {
        return {"keys", "blender|maya", 1, 1, "has the keys and mouse buttons of that program from now on"};
    }
    static ChooseKeys read(const Arguments& arguments) { return {arguments.choice<KeyMap>(0, keyMapNames)}; }
    std::string text() const { return written(nameIn(keyMapNames, map)); }
};
struct ShowHelp {
    static LineInfo info() { return {"help", "", 0, 0, "shows keys, mouse and commands"}; }
};
struct Dismiss {
    static LineInfo info() { return {"dismiss", "", 0, 0, "closes a message or a question"}; }
};
struct Quit {
    static LineInfo info() { return {"quit", "", 0, 0, "ends; asks if there is unsaved work"}; }
};
struct QuitUnsaved {
    static LineInfo info() { return {"quit!", "", 0, 0, "ends"}; }
};
struct Tick {
    double seconds = 0;

    static LineInfo info() { return {"tick", "SECONDS", 1, 1, "lets time pass for playing poses and the turntable"}; }
    static Tick read(const Arguments& arguments) { return {arguments.number(0, {0, 86400})}; }
    std::string text() const { return written(seconds); }
};

/// All verbs, in the order of help.
using Verb =
    std::variant<Undo, Redo, UndoView, RedoView, MakeAgain, Cancel, MoreFaces, FewerFaces, Toggle, FrameView, Look,
                 SetProjection, SetUp, SelectKind, SelectAll, SelectNone, SelectInvert, SelectLinked, SelectGrow,
                 SelectShrink, SelectLoop, StartBox, Grab, NextFrame, PreviousFrame, NextKey, PreviousKey, InsertKey,
                 RemoveKey, SavePosedCage, SavePosedModel, SavePosedCages, SavePosedModels, SaveColours, SaveWeights,
                 SaveCage, SaveStages, SaveReport, SaveOptions, SaveScene, SavePicture, OpenScene, Drop, Reload, Browse,
                 ChooseKeys, ShowHelp, Dismiss, Quit, QuitUnsaved, Tick>;

/// Whether verbs of this type amount to a command.
template <class T, class = void>
constexpr bool amountsToCommand = false;
template <class T>
constexpr bool amountsToCommand<T, std::void_t<decltype(&T::command)>> = true;

/// Returns the syntax and a line of help of each verb, for help and docs.
LineHelp describeVerbs();

/// Everything that panels, keys and scripts can ask for.
using Action = std::variant<Command, Verb>;

/// Returns its line, without a line break; actionOf makes an equal action of it.
std::string textOf(const Action& action);

/// Returns the command or verb in `words` (see wordsOf). \throw InputError naming it, the value and the allowed values
Action actionOf(const Words& words);

/// Returns whether a recording needs it: commands, and verbs with isRecorded.
bool isRecorded(const Action& action);

} // namespace vdbcage::view
