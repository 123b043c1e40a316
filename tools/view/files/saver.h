#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>

#include <tools/view/files/saves.h>
#include <tools/view/jobs/worker.h>

namespace vdbcage::view {

/// Writes files on a thread of its own, one file or sequence at a time. All its functions are for one thread, the
/// owner's, and none of them waits but waitForNews().
class Saver {
public:
    /// `wake`: see Worker.
    explicit Saver(std::function<void()> wake);

    /// Begins to write a file; `makeWriter` is called with its path. \throw InputError something is still being
    /// written, or as makeWriter
    void save(const std::filesystem::path& path, bool isSequence,
              const std::function<Write(const std::filesystem::path&)>& makeWriter);

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
        Write write;
    };
    Worker<Job, std::string> worker_;
    bool isBusy_ = false;
};

} // namespace vdbcage::view
