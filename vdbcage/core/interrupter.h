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

/// OpenVDB's interrupter, which every long function of the library takes. A null pointer means that nobody watches.
///
/// `start(name)` and `end()` bracket a stage. They are called from the caller's thread and never nested.
/// `wasInterrupted(percent)` may be called from any thread at any time; true cancels. `end` is also called while an
/// exception is on its way, so it must not throw.
using Interrupter = openvdb::util::NullInterrupter;

/// Asks an interrupter whether to stop.
/// \param interrupter may be null: then nothing happens
/// \param percent progress of the stage, 0 to 100, or -1 if unknown
/// \throw Cancelled when it says to stop
VDBCAGE_API void throwIfInterrupted(Interrupter* interrupter, int percent = -1);

/// A scope that is one stage of work: `start` is called when it is entered, `end` when it is left, also by an
/// exception.
class VDBCAGE_API Stage {
public:
    /// Begins the stage.
    /// \param interrupter told of the stage; may be null
    /// \param name handed to `start` as stageTable has it
    /// \throw Cancelled when the interrupter asks to stop; neither `start` nor `end` is then called
    Stage(Interrupter* interrupter, StageName name);
    ~Stage();
    Stage(const Stage&) = delete;
    Stage& operator=(const Stage&) = delete;

private:
    Interrupter* interrupter_;
};

/// The time that one stage took.
struct StageTime {
    std::string name;      ///< as given to `start`
    double seconds = 0;    ///< wall clock
    double cpuSeconds = 0; ///< of all threads of the process
};

/// An interrupter that records the time of each stage. It passes everything on to another interrupter, if there is one.
class VDBCAGE_API StageClock : public Interrupter {
public:
    /// Makes a clock that has no stages yet.
    /// \param next told of everything, must outlive the clock; may be null: nobody is told then, and nothing cancels
    explicit StageClock(Interrupter* next = nullptr) : next_(next) {}
    ~StageClock() override;

    /// Begins a stage. It is called from one thread at a time.
    /// \param name of the stage; null counts as an empty name
    void start(const char* name = nullptr) override;
    /// Ends the stage that began last, and adds its times to the list.
    void end() override;
    /// Returns the answer of `next`; false without one. It may be called from any thread.
    /// \param percent handed to `next`
    bool wasInterrupted(int percent = -1) override;

    /// Returns the stages, in the order in which they first began. A name that ran more than once is listed once, with
    /// its times added up. One that has not ended yet has the times of its earlier runs.
    const std::vector<StageTime>& stages() const { return stages_; }

private:
    Interrupter* next_;
    std::vector<StageTime> stages_;
    std::size_t current_ = 0; // of `stages_`
    std::chrono::steady_clock::time_point began_;
    std::clock_t cpuBegan_ = 0;
};

} // namespace vdbcage
