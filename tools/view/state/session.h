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
    /// The line of the change that would be undone, or redone. \pre canUndo(), canRedo()
    std::string undone() const { return toText(past_.back().change); }
    std::string redone() const { return toText(future_.back().change); }
    /// Steps that can be undone.
    std::size_t depth() const { return past_.size(); }

    /// Notes that `before` was changed. What was undone can no longer be redone.
    void changed(const Value& before, const Command& change)
    {
        past_.push_back({before, change});
        future_.clear();
    }
    /// Makes `value` what it was before the last change, which then never was. \pre canUndo()
    void forget(Value& value)
    {
        value = std::move(past_.back().value);
        past_.pop_back();
    }
    /// The last step goes on: this is what it amounts to now. \pre canUndo()
    void continued(const Command& change) { past_.back().change = change; }

    /// Makes `value` what it was before the last change, or after it again. Nothing happens where there is no such
    /// step.
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

/// The state with two histories: of the document, which undo and redo are about, and of the view. Beside it the cage
/// that is shown: what is selected and moved are parts of it.
class Session {
public:
    const State& state() const { return state_; }
    const ShownCage& cage() const { return cage_; }

    /// Applies the command. One that changes nothing leaves no step. `remark` as applied().
    /// \throw InputError, IoError; all is as it was
    void execute(const Command& command, std::string* remark = nullptr);

    /// Between these the commands of each part make one step, as a drag of the mouse does.
    void beginDrag();
    void endDrag() { isDragging_ = false; }
    /// Does the command to the document as it was at beginDrag(), in place of what the drag did so far.
    /// \pre isDragging(), changesDocument(command) \throw as execute
    void replaceDragged(const Command& command);
    /// Ends the drag; the document is as if it had not been.
    void cancelDrag();
    bool isDragging() const { return isDragging_; }
    /// Whether the last drag made a step, or goes on with one.
    bool hasDraggedDocument() const { return hasDraggedDocument_; }
    bool hasDraggedView() const { return hasDraggedView_; }
    /// The state at the last beginDrag().
    const State& dragged() const { return dragged_; }

    const History<Document>& documents() const { return documents_; }
    const History<ViewState>& views() const { return views_; }
    /// What a drag goes on with after one of these is another step.
    void undo();
    void redo();
    void undoView();
    void redoView();

    /// Another view without a step, as when it turns by itself.
    void replaceView(const ViewState& view) { state_.view = view; }

    /// The cage that is shown from now on. What is selected of it stays selected if its faces are the same.
    void setCage(ShownCage cage);

    /// Takes another state, such as a scene's, and forgets the past.
    void restart(State state);

private:
    template <class Value>
    void note(History<Value>& history, bool& hasDragged, const Value& before, const Value& after,
              const Command& command);

    State state_;
    ShownCage cage_; ///< it follows from the document, so it has no history
    History<Document> documents_;
    History<ViewState> views_;
    State dragged_; ///< before the drag
    ShownCage draggedCage_;
    bool isDragging_ = false, hasDraggedDocument_ = false, hasDraggedView_ = false;
};

} // namespace vdbcage::view
