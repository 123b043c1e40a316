#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <tools/view/files/preferences.h>
#include <tools/view/input/input.h>
#include <tools/view/input/verbs.h>

/// What keys and mouse buttons do, in each key map.
namespace vdbcage::view {

/// A key and what it stands for.
struct Shortcut {
    std::string chord; ///< as nameOf(KeyChord)
    Action action;
    std::string line; ///< of the action
    std::string help;
};

/// No chord is there twice.
const std::vector<Shortcut>& shortcuts(KeyMap map);

/// What a drag in the picture does.
enum class DragAction : std::uint8_t { turn, pan, zoom, box, lasso };
struct DragBinding {
    ButtonChord chord;
    DragAction action{};
    bool winsOverHandles = false; ///< it does so where it begins on a handle too
};

/// What becomes of what is selected when something else is picked.
enum class PickAction : std::uint8_t {
    none,
    replace, ///< what is picked alone is selected
    toggle,  ///< what is picked becomes selected if it was not, and is taken out if it was
    add,
    remove
};
struct PickBinding {
    Modifiers held;
    PickAction action{};
};

/// What the mouse does in the picture. Of each list the first entry counts whose modifiers are held, whatever else is.
struct MouseMap {
    std::vector<DragBinding> drags;
    std::vector<PickBinding> clicks; ///< of the left button, by what is held when it goes down
    std::vector<PickBinding> bands;  ///< of boxes and lassos, by what is held at their end
};

const MouseMap& mouseMap(KeyMap map);

/// Null: it does nothing.
const DragBinding* dragOf(const MouseMap& map, const ButtonChord& held);
PickAction pickOf(const std::vector<PickBinding>& bindings, const Modifiers& held);

/// What modifiers do at the end of a box or lasso, such as "shift adds, alt takes out".
std::string describeBands(const MouseMap& map);
/// All that the mouse does in the picture: (what is done, what it does), for help and docs.
std::vector<std::pair<std::string, std::string>> describeMouse(KeyMap map);

} // namespace vdbcage::view
