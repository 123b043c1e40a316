#include <array>

#include <tools/view/input/key_map.h>

namespace vdbcage::view {

namespace {

struct Row {
    const char* blender; ///< the chord in this map; empty: none
    Action action;
    const char* help;
    const char* maya = nullptr; ///< the chord in this map; empty: none; null: the one of Blender
};

const std::vector<Row>& rows()
{
    static const std::vector<Row> list{
        {"control+o", Browse{"open"}, "opens a model"},
        {"control+s", Browse{"save-cage"}, "saves the cage"},
        {"control+shift+s", Browse{"save-scene"}, "saves the scene: options, view, names of files, cage"},
        {"control+q", Quit{}, "ends the program"},
        {"control+z", Undo{}, "takes back the last change of options or files"},
        {"control+shift+z", Redo{}, "does it again"},
        {"control+y", Redo{}, "does it again"},
        {"", Undo{}, "takes back the last change of options or files", "z"},
        {"", Redo{}, "does it again", "shift+z"},
        {"alt+z", UndoView{}, "takes back the last change of the view", "left-bracket"},
        {"shift+alt+z", RedoView{}, "does it again", "right-bracket"},
        {"escape", Cancel{}, "closes a message, or stops writing, making or binding"},
        {"control+enter", MakeAgain{}, "makes the cage that was cancelled"},
        {"page-up", MoreFaces{}, "a twentieth more faces"},
        {"page-down", FewerFaces{}, "a twentieth fewer faces"},
        {"home", FrameView{false}, "moves the view so that all is seen"},
        {"", FrameView{false}, "moves the view so that all is seen", "a"},
        {"f", FrameView{true}, "the same for the selection, or all if nothing is selected"},
        {"keypad-1", Look{Look::From::front}, "looks from the front"},
        {"control+keypad-1", Look{Look::From::back}, "looks from the back"},
        {"keypad-3", Look{Look::From::right}, "looks from the right"},
        {"control+keypad-3", Look{Look::From::left}, "looks from the left"},
        {"keypad-7", Look{Look::From::top}, "looks from above"},
        {"control+keypad-7", Look{Look::From::bottom}, "looks from below"},
        {"alt+1", Look{Look::From::front}, "looks from the front"},
        {"alt+3", Look{Look::From::right}, "looks from the right"},
        {"alt+7", Look{Look::From::top}, "looks from above"},
        {"5", SetProjection{}, "perspective or orthographic"},
        {"keypad-5", SetProjection{}, "perspective or orthographic"},
        {"m", Toggle{"model"}, "shows or hides the model"},
        {"c", Toggle{"cage"}, "shows or hides the cage"},
        {"v", Toggle{"solid"}, "shows or hides the voxels"},
        {"k", Toggle{"closed"}, "shows or hides the closing"},
        {"shift+g", Toggle{"ground"}, "shows or hides the ground grid"},
        {"t", Toggle{"turntable"}, "turns the view by itself"},
        {"tab", Toggle{"mode"}, "poses the model by the cage, or shapes the cage"},
        {"", Toggle{"mode"}, "poses the model by the cage, or shapes the cage", "f8"},
        {"1", SelectKind{edit::Element::point}, "selects points from now on"},
        {"2", SelectKind{edit::Element::edge}, "selects edges from now on"},
        {"3", SelectKind{edit::Element::face}, "selects faces from now on"},
        {"", SelectKind{edit::Element::point}, "selects points from now on", "f9"},
        {"", SelectKind{edit::Element::edge}, "selects edges from now on", "f10"},
        {"", SelectKind{edit::Element::face}, "selects faces from now on", "f11"},
        {"a", SelectAll{}, "selects all of the cage", "control+shift+a"},
        {"alt+a", SelectNone{}, "selects nothing", "shift+alt+d"},
        {"control+i", SelectInvert{}, "inverts the selection", "control+shift+i"},
        {"l", SelectLinked{}, "selects the connected part of the cage"},
        {"shift+l", SelectLoop{}, "selects the loops through the selection"},
        {"control+keypad-add", SelectGrow{}, "selects the neighbours too"},
        {"control+keypad-subtract", SelectShrink{}, "shrinks the selection by one ring"},
        {"control+up", SelectGrow{}, "selects the neighbours too"},
        {"control+down", SelectShrink{}, "shrinks the selection by one ring"},
        {"", SelectGrow{}, "selects the neighbours too", "shift+period"},
        {"", SelectShrink{}, "shrinks the selection by one ring", "shift+comma"},
        {"b", StartBox{}, "selects elements in the box that is dragged next", ""},
        {"shift+z", Toggle{"see-through"}, "selects hidden elements too, or only visible ones", "shift+x"},
        {"g", Grab{Tool::move}, "moves the selection with the pointer; x, y, z and numbers say where to", ""},
        {"r", Grab{Tool::rotate}, "turns the selection with the pointer", ""},
        {"s", Grab{Tool::scale}, "scales the selection with the pointer", ""},
        {"w", SetTool{Tool::select}, "no handles", "q"},
        {"shift+w", SetTool{Tool::move}, "handles that move", "w"},
        {"shift+e", SetTool{Tool::rotate}, "handles that turn", "e"},
        {"shift+r", SetTool{Tool::scale}, "handles that scale", "r"},
        {"alt+g", ResetPose{true}, "moves the selection back to its place at rest"},
        {"i", InsertKey{}, "keeps the pose on the time line", "s"},
        {"shift+i", RemoveKey{}, "takes the key at this frame off the time line"},
        {"right", NextFrame{}, "the next frame"},
        {"left", PreviousFrame{}, "the frame before"},
        {"up", NextKey{}, "the next key of the time line"},
        {"down", PreviousKey{}, "the key before"},
        {"", NextKey{}, "the next key of the time line", "period"},
        {"", PreviousKey{}, "the key before", "comma"},
        {"space", Toggle{"play"}, "plays the time line, or stops it"},
        {"", Toggle{"play"}, "plays the time line, or stops it", "alt+v"},
        {"f1", ShowHelp{}, "shows keys, mouse and commands"},
    };
    return list;
}

std::vector<Shortcut> listOf(KeyMap map)
{
    std::vector<Shortcut> list;
    for (const Row& row : rows()) {
        const char* const chord = map == KeyMap::maya && row.maya ? row.maya : row.blender;
        if (*chord) list.push_back({chord, row.action, textOf(row.action), row.help});
    }
    return list;
}

} // namespace

const std::vector<Shortcut>& shortcuts(KeyMap map)
{
    static const std::array<std::vector<Shortcut>, keyMapNames.size()> lists{listOf(KeyMap::blender),
                                                                             listOf(KeyMap::maya)};
    return lists[static_cast<std::size_t>(map)];
}

} // namespace vdbcage::view
