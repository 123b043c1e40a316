#pragma once

#include <string>
#include <utility>
#include <vector>

#include <tools/view/state/command.h>

namespace vdbcage::view {

/// A value with its past and future, without limit.
template <class Value>
class History {
public:
    bool canUndo() const { return !past_.empty(); }
    bool canRedo() const { return !future_.empty(); }
    /// Returns the line of the change that would be undone, or redone. \pre canUndo(), canRedo()
    std::string undone() const { return toText(past_.back().change); }
    std::string redone() const { return toText(future_.back().change); }
    /// Returns the number of steps that can be undone.
    std::size_t depth() const { return past_.size(); }

    /// Notes that `before` was changed. Steps that were undone can no longer be redone.
    void changed(const Value& before, const Command& change)
    {
        past_.push_back({before, change});
        future_.clear();
    }
    /// Sets `value` to its state before the last change, and drops that change. \pre canUndo()
    void forget(Value& value)
    {
        value = std::move(past_.back().value);
        past_.pop_back();
    }
    /// Returns whether the change is part of the last step: fits that follow each other are one.
    bool isContinuedBy(const Command& change) const
    {
        return canUndo() && std::holds_alternative<FitCage>(past_.back().change) &&
               std::holds_alternative<FitCage>(change);
    }
    /// Replaces the command of the last step, which goes on. Steps that were undone can no longer be redone.
    /// \pre canUndo()
    void continued(const Command& change)
    {
        past_.back().change = change;
        future_.clear();
    }

    /// Sets `value` to its state before the last change, or after it again. Does nothing if there is no such step.
    void undo(Value& value) { step(past_, future_, value); }
    void redo(Value& value) { step(future_, past_, value); }

private:
    struct Step {
        Value value;
        Command change;
    };
    static void step(std::vector<Step>& from, std::vector<Step>& to, Value& value)
    {
        if (from.empty()) return;
        Step step = std::move(from.back());
        from.pop_back();
        std::swap(value, step.value);
        to.push_back(std::move(step));
    }

    std::vector<Step> past_, future_;
};

/// The state with two histories: of the document, for undo and redo, and of the view. Beside it the shown cage, whose
/// parts are selected and moved.
class Session {
public:
    const State& state() const { return state_; }
    const PosableCagePtr& cage() const { return cage_; }

    /// Applies the command. One that changes nothing leaves no step. `remark` as applied().
    /// \throw InputError, IoError; nothing has changed
    void execute(const Command& command, std::string* remark = nullptr);

    /// Begins a drag of the mouse: until endDrag() all commands on the document make one step, and all on the view
    /// another.
    void beginDrag();
    void endDrag() { isDragging_ = false; }
    /// Applies the command to the document as it was at beginDrag(), in place of the drag's previous changes.
    /// \pre isDragging(), changesDocument(command) \throw as execute
    void replaceDragged(const Command& command);
    /// Ends the drag and takes its changes of the document back.
    void cancelDrag();
    bool isDragging() const { return isDragging_; }
    /// Returns whether the last drag made a step, or goes on with one.
    bool hasDraggedDocument() const { return hasDraggedDocument_; }
    bool hasDraggedView() const { return hasDraggedView_; }
    /// Returns the state at the last beginDrag().
    const State& beforeDrag() const { return beforeDrag_; }

    const History<Document>& documents() const { return documents_; }
    const History<ViewState>& views() const { return views_; }
    /// Undoes or redoes a step. If a drag goes on after it, its further changes are another step.
    void undo();
    void redo();
    void undoView();
    void redoView();

    /// Replaces the view without a step, as when it turns by itself.
    void replaceView(const ViewState& view) { state_.view = view; }

    /// Sets the shown cage. The selection stays if the faces are the same.
    void setCage(PosableCagePtr cage);

    /// Takes another state, such as a scene's, and clears the histories.
    void restart(State state);

private:
    template <class Value>
    void note(History<Value>& history, bool& hasDragged, const Value& before, const Value& after,
              const Command& command);

    State state_;
    PosableCagePtr cage_; ///< follows from the document, so it has no history
    History<Document> documents_;
    History<ViewState> views_;
    State beforeDrag_;
    PosableCagePtr cageBeforeDrag_;
    bool isDragging_ = false, hasDraggedDocument_ = false, hasDraggedView_ = false;
};

} // namespace vdbcage::view
