#pragma once

#include <tools/view/app_parts.h>
#include <tools/view/input/verbs.h>

namespace vdbcage::view {

/// The performer of the actions of panels, keys and scripts, which also records them.
class ActionRunner {
public:
    explicit ActionRunner(AppParts& parts) : parts_(parts) {}

    /// Performs it and waits until its files are written. \throw Error the action failed; nothing has changed
    void perform(const Action& action);
    /// Performs and records the action of a user; errors become messages.
    void attempt(const Action& action);
    /// Opens a file that was dropped on the window: a model or a scene.
    void drop(const std::filesystem::path& path);

    /// Ends a drag and records it as one line.
    void endDrag();
    /// Closes the topmost open message, panel or question. Returns whether there was one.
    bool dismiss();
    /// Advances animations by that time.
    void pass(double seconds);

    /// Takes the results of other threads.
    void update();
    /// Waits until the wanted cage is made or has failed, and all files are written.
    void waitUntilSettled();
    /// Waits until all files are written. \throw InputError the reason why one could not be written
    void finishSaving();

private:
    struct VerbEffect; ///< the effects of verbs that amount to no command

    void begin(const Action& action);
    void beginAndRecord(const Action& action);
    void run(const Command& command);
    void takeSaved();

    AppParts& parts_;
};

} // namespace vdbcage::view
