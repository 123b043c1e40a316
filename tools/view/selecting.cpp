#include <tools/view/selecting.h>

#include <algorithm>

#include <tools/edit/selection.h>
#include <tools/view/state/move.h>
#include <vdbcage/core/error.h>

namespace vdbcage::view {

namespace {

edit::Element kindNamed(const std::string& name)
{
    const auto* const found = std::find(edit::elementNames.begin(), edit::elementNames.end(), name);
    if (found == edit::elementNames.end()) {
        throw InputError("select-kind: '" + name + "' is not allowed; it must be points, edges or faces");
    }
    return static_cast<edit::Element>(found - edit::elementNames.begin());
}

} // namespace

edit::Selection selectionAfter(const State& state, const std::string& verb, const std::string& kind)
{
    if (!state.cage) throw InputError(verb + ": there is no cage yet");
    const edit::Elements elements(*state.cage);
    const edit::Selection selected = withinCage(state.view.selection, elements);
    if (verb == "select-kind") return edit::converted(elements, selected, kindNamed(kind));
    if (verb == "select-all") return edit::all(elements, selected.kind);
    if (verb == "select-none") return {selected.kind, {}};
    if (verb == "select-invert") return edit::inverted(elements, selected);
    if (verb == "select-linked") return edit::linked(elements, selected);
    if (verb == "select-grow") return edit::grown(elements, selected);
    if (verb == "select-shrink") return edit::shrunk(elements, selected);
    return edit::loop(elements, selected);
}

} // namespace vdbcage::view
