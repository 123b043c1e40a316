#include <algorithm>
#include <array>

#include <tools/view/input/key_map.h>

namespace vdbcage::view {

namespace {

constexpr Modifiers nothing{}, shift{true, false, false}, control{false, true, false}, alt{false, false, true},
    controlShift{true, true, false};

/// Returns whether all modifiers of `wanted` are held.
bool areHeld(const Modifiers& wanted, const Modifiers& held)
{
    return (held.shift || !wanted.shift) && (held.control || !wanted.control) && (held.alt || !wanted.alt);
}

MouseMap blenderMouse()
{
    return {{{{Button::left, control}, DragAction::box, true},
             {{Button::right, control}, DragAction::lasso, true},
             {{Button::left, shift}, DragAction::pan},
             {{Button::left, nothing}, DragAction::turn},
             {{Button::middle, nothing}, DragAction::pan},
             {{Button::right, nothing}, DragAction::zoom}},
            {{shift, PickAction::toggle}, {nothing, PickAction::replace}},
            {{alt, PickAction::remove}, {shift, PickAction::add}, {nothing, PickAction::replace}}};
}

MouseMap mayaMouse()
{
    const std::vector<PickBinding> picks{{controlShift, PickAction::add},
                                         {control, PickAction::remove},
                                         {shift, PickAction::toggle},
                                         {nothing, PickAction::replace}};
    MouseMap map{{{{Button::left, alt}, DragAction::turn, true},
                  {{Button::middle, alt}, DragAction::pan, true},
                  {{Button::right, alt}, DragAction::zoom, true},
                  {{Button::left, nothing}, DragAction::box},
                  {{Button::right, nothing}, DragAction::lasso}},
                 picks,
                 picks};
    // A click that begins to turn the view, without a drag, keeps the selection.
    map.clicks.insert(map.clicks.begin(), {alt, PickAction::none});
    return map;
}

std::string withModifiers(const Modifiers& held, const std::string& what)
{
    const std::string name = nameOf(held);
    return name.empty() ? what : name + '+' + what;
}

const char* textOf(DragAction action)
{
    switch (action) {
    case DragAction::turn:
        return "turns the view around the place under the pointer";
    case DragAction::pan:
        return "moves the view";
    case DragAction::zoom:
        return "zooms";
    case DragAction::box:
        return "selects elements in a box";
    case DragAction::lasso:
        return "selects elements in a lasso";
    }
    return "";
}

const char* textOf(PickAction action)
{
    switch (action) {
    case PickAction::none:
        return "does nothing";
    case PickAction::replace:
        return "selects only the element under the pointer";
    case PickAction::toggle:
        return "selects one more, or one less";
    case PickAction::add:
        return "selects one more";
    case PickAction::remove:
        return "takes it out";
    }
    return "";
}

/// Returns the effect of a box or a lasso.
const char* bandTextOf(PickAction action)
{
    switch (action) {
    case PickAction::toggle:
        return "inverts";
    case PickAction::add:
        return "adds";
    case PickAction::remove:
        return "takes out";
    case PickAction::none:
    case PickAction::replace:
        break;
    }
    return "";
}

} // namespace

const MouseMap& mouseMap(KeyMap map)
{
    static const std::array<MouseMap, keyMapNames.size()> maps{blenderMouse(), mayaMouse()};
    return maps[static_cast<std::size_t>(map)];
}

const DragBinding* dragOf(const MouseMap& map, const ButtonChord& held)
{
    const auto found = std::find_if(map.drags.begin(), map.drags.end(), [&](const DragBinding& binding) {
        return binding.chord.button == held.button && areHeld(binding.chord.modifiers, held.modifiers);
    });
    return found == map.drags.end() ? nullptr : &*found;
}

PickAction pickOf(const std::vector<PickBinding>& bindings, const Modifiers& held)
{
    const auto found = std::find_if(bindings.begin(), bindings.end(),
                                    [&](const PickBinding& binding) { return areHeld(binding.held, held); });
    return found == bindings.end() ? PickAction::none : found->action;
}

std::string describeBands(const MouseMap& map)
{
    std::string text;
    for (const PickBinding& binding : map.bands) {
        const std::string does = bandTextOf(binding.action);
        if (!does.empty()) text += (text.empty() ? "" : ", ") + nameOf(binding.held) + ' ' + does;
    }
    return text;
}

std::vector<std::pair<std::string, std::string>> describeMouse(KeyMap map)
{
    const MouseMap& mouse = mouseMap(map);
    std::vector<std::pair<std::string, std::string>> rows;
    for (const DragBinding& binding : mouse.drags) {
        std::string does = textOf(binding.action);
        const bool isBand = binding.action == DragAction::box || binding.action == DragAction::lasso;
        if (isBand) does += "; at its end " + describeBands(mouse);
        rows.emplace_back(withModifiers(binding.chord.modifiers, nameOf(binding.chord.button) + " button, drag"), does);
    }
    rows.emplace_back("wheel", "zooms to the pointer");
    for (auto binding = mouse.clicks.rbegin(); binding != mouse.clicks.rend(); ++binding) {
        if (binding->action == PickAction::none) continue;
        rows.emplace_back(withModifiers(binding->held, "left button, click"), textOf(binding->action));
    }
    rows.emplace_back("left button on a handle, drag", "moves, turns or scales the selection; control: in steps");
    return rows;
}

} // namespace vdbcage::view
