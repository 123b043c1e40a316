#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>

#include <tools/view/jobs/posing.h>
#include <tools/view/jobs/worker.h>

namespace vdbcage::view {

/// Writes what is made and posed; what takes time on a thread of its own, one file or sequence at a time. All its
/// functions are for one thread, the owner's, and none of them waits but waitForNews().
class Saver {
public:
    /// `wake`: see Worker.
    explicit Saver(std::function<void()> wake);

    /// What is saved.
    struct Source {
        const State& state;
        const Planner& planner;
        const Posing& posing;
    };
    /// Begins what a verb such as "save-posed-cage" asks for (see verbs.h).
    /// \throw InputError it is not there, or something is still being written; IoError
    void save(const Source& source, const std::string& verb, const std::filesystem::path& path);

    /// What has been written since the last call: the name of a file.
    /// \throw InputError why it could not be written
    std::optional<std::string> take();
    bool isBusy() const { return isBusy_; }
    /// Stops what is under way: nothing is written.
    void stop() { worker_.stop(); }
    /// Waits until there is something to take, or `seconds` have passed.
    void waitForNews(double seconds) { worker_.waitForNews(seconds); }
    WorkProgress progress() const { return worker_.progress(); }

private:
    struct Job {
        std::string name; ///< of what is written
        std::function<void(Interrupter*)> write;
    };
    Worker<Job, std::string> worker_;
    bool isBusy_ = false;
};

/// Whether the verb writes a file for each frame; its path gets a place for their numbers (see files::patternFor).
bool isSequence(const std::string& verb);

/// The cage of the options that are set now, or that was opened. \throw InputError naming the verb: it is not there yet
const CageResult& currentCage(const Planner& planner, std::string_view verb);

} // namespace vdbcage::view
