#pragma once

#include <string>
#include <utility>
#include <vector>

#include <tools/view/files/preferences.h>
#include <tools/view/input/input.h>
#include <tools/view/input/verbs.h>

/// The actions of keys and mouse buttons in each key map.
namespace vdbcage::view {

/// A key and its action.
struct Shortcut {
    std::string chord; ///< as nameOf(KeyChord)
    Action action;
    std::string line; ///< of the action
    std::string help;
};

/// Returns the shortcuts of the map, with no chord twice.
const std::vector<Shortcut>& shortcuts(KeyMap map);

/// The effect of a drag in the picture.
enum class DragAction : std::uint8_t { turn, pan, zoom, box, lasso };
struct DragBinding {
    ButtonChord chord;
    DragAction action{};
    bool winsOverHandles = false; ///< it also does if it begins on a handle
};

/// The change of the selection when something else is picked.
enum class PickAction : std::uint8_t {
    none,
    replace, ///< only the picked elements are selected
    toggle,  ///< picked elements that were not selected become so; others are removed
    add,
    remove
};
struct PickBinding {
    Modifiers held;
    PickAction action{};
};

/// The actions of the mouse in the picture. In each list the first entry whose modifiers are held decides, whatever
/// else is held.
struct MouseMap {
    std::vector<DragBinding> drags;
    std::vector<PickBinding> clicks; ///< of the left button, by the modifiers held when it goes down
    std::vector<PickBinding> bands;  ///< of boxes and lassos, by the modifiers held at their end
};

const MouseMap& mouseMap(KeyMap map);

/// Returns the binding of the button; null: it has none.
const DragBinding* dragOf(const MouseMap& map, const ButtonChord& held);
PickAction pickOf(const std::vector<PickBinding>& bindings, const Modifiers& held);

/// Returns the effect of modifiers at the end of a box or lasso, such as "shift adds, alt takes out".
std::string describeBands(const MouseMap& map);
/// Returns all acts of the mouse in the picture and their effects, for help and docs.
std::vector<std::pair<std::string, std::string>> describeMouse(KeyMap map);

} // namespace vdbcage::view
