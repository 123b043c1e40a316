#include <tools/view/app.h>

namespace vdbcage::view {

const std::vector<Shortcut>& shortcuts()
{
    static const std::vector<Shortcut> list{
        {"control+o", "browse open", "opens a model"},
        {"control+s", "browse save-cage", "saves the cage"},
        {"control+shift+s", "browse save-scene", "saves the scene: options, view, names of files, cage"},
        {"control+q", "quit", "ends the program"},
        {"control+z", "undo", "takes back the last change of options or files"},
        {"control+shift+z", "redo", "does it again"},
        {"control+y", "redo", "does it again"},
        {"alt+z", "undo-view", "takes back the last change of the view"},
        {"shift+alt+z", "redo-view", "does it again"},
        {"escape", "cancel", "closes a message, or stops the making of a cage"},
        {"control+enter", "make", "makes the cage that was cancelled"},
        {"page-up", "more", "a twentieth more faces"},
        {"page-down", "fewer", "a twentieth fewer faces"},
        {"home", "frame all", "moves the view so that all is seen"},
        {"f", "frame selected", "the same for what is selected, or all if nothing is"},
        {"1", "look front", "looks from the front"},
        {"control+1", "look back", "looks from the back"},
        {"3", "look right", "looks from the right"},
        {"control+3", "look left", "looks from the left"},
        {"7", "look top", "looks from above"},
        {"control+7", "look bottom", "looks from below"},
        {"keypad-1", "look front", "looks from the front"},
        {"keypad-3", "look right", "looks from the right"},
        {"keypad-7", "look top", "looks from above"},
        {"5", "projection toggle", "perspective or orthographic"},
        {"keypad-5", "projection toggle", "perspective or orthographic"},
        {"m", "toggle model", "shows or hides the model"},
        {"c", "toggle cage", "shows or hides the cage"},
        {"v", "toggle solid", "shows or hides the voxels"},
        {"b", "toggle closed", "shows or hides the closing"},
        {"g", "toggle ground", "shows or hides the ground grid"},
        {"t", "toggle turntable", "turns the view by itself"},
        {"f1", "help", "shows keys, mouse and commands"},
    };
    return list;
}

} // namespace vdbcage::view
