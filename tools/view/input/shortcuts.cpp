#include <array>

#include <tools/view/input/key_map.h>

namespace vdbcage::view {

namespace {

struct Row {
    const char* blender; ///< the chord in this map; empty: none
    const char* line;
    const char* help;
    const char* maya = nullptr; ///< the chord in this map; empty: none; null: that of Blender's
};

const std::vector<Row>& rows()
{
    static const std::vector<Row> list{
        {"control+o", "browse open", "opens a model"},
        {"control+s", "browse save-cage", "saves the cage"},
        {"control+shift+s", "browse save-scene", "saves the scene: options, view, names of files, cage"},
        {"control+q", "quit", "ends the program"},
        {"control+z", "undo", "takes back the last change of options or files"},
        {"control+shift+z", "redo", "does it again"},
        {"control+y", "redo", "does it again"},
        {"", "undo", "takes back the last change of options or files", "z"},
        {"", "redo", "does it again", "shift+z"},
        {"alt+z", "undo-view", "takes back the last change of the view", "left-bracket"},
        {"shift+alt+z", "redo-view", "does it again", "right-bracket"},
        {"escape", "cancel", "closes a message, or stops what is written, made or bound"},
        {"control+enter", "make", "makes the cage that was cancelled"},
        {"page-up", "more", "a twentieth more faces"},
        {"page-down", "fewer", "a twentieth fewer faces"},
        {"home", "frame all", "moves the view so that all is seen"},
        {"", "frame all", "moves the view so that all is seen", "a"},
        {"f", "frame selected", "the same for what is selected, or all if nothing is"},
        {"keypad-1", "look front", "looks from the front"},
        {"control+keypad-1", "look back", "looks from the back"},
        {"keypad-3", "look right", "looks from the right"},
        {"control+keypad-3", "look left", "looks from the left"},
        {"keypad-7", "look top", "looks from above"},
        {"control+keypad-7", "look bottom", "looks from below"},
        {"alt+1", "look front", "looks from the front"},
        {"alt+3", "look right", "looks from the right"},
        {"alt+7", "look top", "looks from above"},
        {"5", "projection toggle", "perspective or orthographic"},
        {"keypad-5", "projection toggle", "perspective or orthographic"},
        {"m", "toggle model", "shows or hides the model"},
        {"c", "toggle cage", "shows or hides the cage"},
        {"v", "toggle solid", "shows or hides the voxels"},
        {"k", "toggle closed", "shows or hides the closing"},
        {"shift+g", "toggle ground", "shows or hides the ground grid"},
        {"t", "toggle turntable", "turns the view by itself"},
        {"tab", "toggle mode", "poses the model by the cage, or shapes the cage"},
        {"", "toggle mode", "poses the model by the cage, or shapes the cage", "f8"},
        {"1", "select-kind points", "selects points from now on"},
        {"2", "select-kind edges", "selects edges from now on"},
        {"3", "select-kind faces", "selects faces from now on"},
        {"", "select-kind points", "selects points from now on", "f9"},
        {"", "select-kind edges", "selects edges from now on", "f10"},
        {"", "select-kind faces", "selects faces from now on", "f11"},
        {"a", "select-all", "selects all of the cage", "control+shift+a"},
        {"alt+a", "select-none", "selects nothing", "shift+alt+d"},
        {"control+i", "select-invert", "selects what is not selected", "control+shift+i"},
        {"l", "select-linked", "selects all that hangs together with what is selected"},
        {"shift+l", "select-loop", "selects the loops through what is selected"},
        {"control+keypad-add", "select-grow", "selects the neighbours too"},
        {"control+keypad-subtract", "select-shrink", "selects what has no neighbour that is not selected"},
        {"control+up", "select-grow", "selects the neighbours too"},
        {"control+down", "select-shrink", "selects what has no neighbour that is not selected"},
        {"", "select-grow", "selects the neighbours too", "shift+period"},
        {"", "select-shrink", "selects what has no neighbour that is not selected", "shift+comma"},
        {"b", "box", "selects what is in the box that is dragged next", ""},
        {"shift+z", "toggle see-through", "selects what is hidden too, or only what is seen", "shift+x"},
        {"g", "grab move", "moves what is selected with the pointer; x, y, z and numbers say where to", ""},
        {"r", "grab rotate", "turns what is selected with the pointer", ""},
        {"s", "grab scale", "scales what is selected with the pointer", ""},
        {"w", "tool select", "no handles", "q"},
        {"shift+w", "tool move", "handles that move", "w"},
        {"shift+e", "tool rotate", "handles that turn", "e"},
        {"shift+r", "tool scale", "handles that scale", "r"},
        {"alt+g", "reset-pose selected", "moves what is selected back to where it is at rest"},
        {"i", "insert-key", "keeps the pose on the time line", "s"},
        {"shift+i", "remove-key", "takes the key at this frame off the time line"},
        {"right", "next-frame", "the next frame"},
        {"left", "previous-frame", "the frame before"},
        {"up", "next-key", "the next key of the time line"},
        {"down", "previous-key", "the key before"},
        {"", "next-key", "the next key of the time line", "period"},
        {"", "previous-key", "the key before", "comma"},
        {"space", "toggle play", "plays the time line, or stops it"},
        {"", "toggle play", "plays the time line, or stops it", "alt+v"},
        {"f1", "help", "shows keys, mouse and commands"},
    };
    return list;
}

std::vector<Shortcut> listOf(KeyMap map)
{
    std::vector<Shortcut> list;
    for (const Row& row : rows()) {
        const char* const chord = map == KeyMap::maya && row.maya ? row.maya : row.blender;
        if (*chord) list.push_back({chord, row.line, row.help});
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
