#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>

#include <tools/view/files/save_verbs.h>
#include <tools/view/jobs/worker.h>

namespace vdbcage::view {

/// A writer of files on its own thread, one file or sequence at a time. Call it from one thread, the owner's. Only
/// waitForNews() waits.
class Saver {
public:
    /// `wake`: see Worker.
    explicit Saver(std::function<void()> wake);

    /// Begins to write a file; `makeWriter` is called with its path. \throw InputError another one is still being
    /// written, or as makeWriter
    void save(const std::filesystem::path& path, bool isSequence,
              const std::function<Write(const std::filesystem::path&)>& makeWriter);

    /// Returns the name of the file that has been written since the last call.
    /// \throw InputError the reason why it could not be written
    std::optional<std::string> take();
    bool isBusy() const { return isBusy_; }
    /// Stops the present job: nothing is written.
    void stop() { worker_.stop(); }
    /// Waits until there is something to take, or `seconds` have passed.
    void waitForNews(double seconds) { worker_.waitForNews(seconds); }
    WorkProgress progress() const { return worker_.progress(); }

private:
    struct Job {
        std::string name; ///< of the file
        Write write;
    };
    Worker<Job, std::string> worker_;
    bool isBusy_ = false;
};

} // namespace vdbcage::view
