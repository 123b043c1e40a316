#pragma once

#include <chrono>
#include <cstddef>
#include <ctime>
#include <string>
#include <vector>

#include <openvdb/util/NullInterrupter.h>
#include <vdbcage/core/export.h>
#include <vdbcage/core/stages.h>

namespace vdbcage {

/// OpenVDB's interrupter. Every long function of the library takes one; null means nobody watches.
///
/// `start(name)` and `end()` bracket a stage. They are called from the caller's thread and never nested.
/// `wasInterrupted(percent)` may be called from any thread at any time; true cancels. `end` is also called while an
/// exception is on its way, so it must not throw.
using Interrupter = openvdb::util::NullInterrupter;

/// Asks `interrupter`, which may be null, whether to stop. `percent` is the progress of the stage, 0 to 100, or -1 if
/// unknown.
/// \throw Cancelled if asked to stop
VDBCAGE_API void throwIfInterrupted(Interrupter* interrupter, int percent = -1);

/// Brackets one stage of work: `start` now, `end` when the scope is left, also by an exception.
class VDBCAGE_API Stage {
public:
    /// `interrupter` may be null.
    /// \throw Cancelled if asked to stop
    Stage(Interrupter* interrupter, StageName name);
    ~Stage();
    Stage(const Stage&) = delete;
    Stage& operator=(const Stage&) = delete;

private:
    Interrupter* interrupter_;
};

/// How long one stage took.
struct StageTime {
    std::string name;      ///< as given to `start`
    double seconds = 0;    ///< wall clock
    double cpuSeconds = 0; ///< of all threads of the process
};

/// An interrupter that records what each stage took. It passes everything on to another interrupter, if there is one.
class VDBCAGE_API StageClock : public Interrupter {
public:
    /// `next` may be null: then nobody is told, and nothing cancels. It must outlive this.
    explicit StageClock(Interrupter* next = nullptr) : next_(next) {}
    ~StageClock() override;

    /// The stage `name` begins; null counts as an empty name. From one thread at a time.
    void start(const char* name = nullptr) override;
    /// The stage that began last ends, and its times are added to the list.
    void end() override;
    /// What `next` answers; false without one. From any thread.
    bool wasInterrupted(int percent = -1) override;

    /// The stages, in the order in which they first began. A name that ran more than once is listed once, with its
    /// times added up. One that has not ended yet has the times of its earlier runs.
    const std::vector<StageTime>& stages() const { return stages_; }

private:
    Interrupter* next_;
    std::vector<StageTime> stages_;
    std::size_t current_ = 0; // of `stages_`
    std::chrono::steady_clock::time_point began_;
    std::clock_t cpuBegan_ = 0;
};

} // namespace vdbcage
