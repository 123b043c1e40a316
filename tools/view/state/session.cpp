#include <tools/view/state/session.h>

#include <utility>

namespace vdbcage::view {

template <class Value>
void Session::note(History<Value>& history, bool& hasDragged, const Value& before, const Value& after,
                   const Command& command)
{
    if (before == after) return;
    if ((isDragging_ && hasDragged) || history.isContinuedBy(command)) {
        history.continued(command);
    } else {
        history.changed(before, command);
    }
    hasDragged = isDragging_;
}

void Session::execute(const Command& command, std::string* remark)
{
    State changed = applied(state_, command, cage_, remark);
    if (changesDocument(command)) {
        note(documents_, hasDraggedDocument_, state_.document, changed.document, command);
    } else {
        note(views_, hasDraggedView_, state_.view, changed.view, command);
    }
    state_ = std::move(changed);
}

void Session::beginDrag()
{
    isDragging_ = true;
    hasDraggedDocument_ = hasDraggedView_ = false;
    beforeDrag_ = state_;
    cageBeforeDrag_ = cage_;
}

void Session::replaceDragged(const Command& command)
{
    State changed = applied(beforeDrag_, command, cageBeforeDrag_);
    note(documents_, hasDraggedDocument_, state_.document, changed.document, command);
    state_.document = std::move(changed.document);
}

void Session::cancelDrag()
{
    isDragging_ = false;
    if (hasDraggedDocument_) documents_.forget(state_.document);
    hasDraggedDocument_ = false;
}

void Session::setCage(PosableCagePtr cage)
{
    const auto hasFacesOf = [&](const Mesh& before) {
        return cage && cage->rest()->triangles == before.triangles && cage->rest()->quads == before.quads;
    };
    if (cage_ && !hasFacesOf(*cage_->rest())) state_.view.selection.ids.clear();
    cage_ = std::move(cage);
}

void Session::undo()
{
    hasDraggedDocument_ = false;
    documents_.undo(state_.document);
}

void Session::redo()
{
    hasDraggedDocument_ = false;
    documents_.redo(state_.document);
}

void Session::undoView()
{
    hasDraggedView_ = false;
    views_.undo(state_.view);
}

void Session::redoView()
{
    hasDraggedView_ = false;
    views_.redo(state_.view);
}

void Session::restart(State state)
{
    *this = Session();
    state_ = std::move(state);
}

} // namespace vdbcage::view
