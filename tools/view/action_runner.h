#pragma once

#include <tools/view/app_parts.h>
#include <tools/view/input/verbs.h>

namespace vdbcage::view {

/// Does what panels, keys and scripts ask for, and records it.
class ActionRunner {
public:
    explicit ActionRunner(AppParts& parts) : parts_(parts) {}

    /// Does it, and waits until what it saves is written. \throw Error it cannot be done; all is as it was
    void perform(const Action& action);
    /// For a user: it is recorded, and what is wrong becomes a message.
    void attempt(const Action& action);
    /// A file that is dropped on the window: a model, or a scene.
    void drop(const std::filesystem::path& path);

    /// Ends a drag: it becomes the line that its end amounts to.
    void endDrag();
    /// Closes what is open on top: a message, a panel, a question. Returns whether there was anything.
    bool dismiss();
    /// So much time has passed for what moves by itself.
    void pass(double seconds);

    /// Takes what was done on other threads.
    void update();
    /// Waits until the cage that is wanted is there, or cannot be had, and all that was to be written is.
    void waitUntilSettled();
    /// Waits until all that was to be written is. \throw InputError why something could not be
    void finishSaving();

private:
    struct VerbEffect; ///< what each verb does that amounts to no command

    void begin(const Action& action);
    void beginAndRecord(const Action& action);
    void run(const Command& command);
    void takeSaved();

    AppParts& parts_;
};

} // namespace vdbcage::view
