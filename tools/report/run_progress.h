#pragma once

#include <optional>
#include <string_view>

namespace vdbcage::report {

/// The progress of a whole run, and the time left, computed from the stages that an interrupter is told.
///
/// A run goes through several stages, and through all of them again if a cage was not good enough: their number is
/// unknown. So another try divides the rest of the run, and from then on no time left is told.
///
/// It reads no clock: `seconds` are those of the run so far. Use it from one thread at a time.
class RunProgress {
public:
    /// Begins the stage `name`; empty if it has none.
    void start(std::string_view name, double seconds);
    /// Sets the stage's percentage, 0 to 100. Values less than before are ignored.
    void advance(int percent, double seconds);

    /// Returns the run's percentage, 0 to 99, which never falls.
    int percent() const;
    /// Returns the time left in whole seconds, at least 1; nothing if it would be a guess. It is counted down until the
    /// stage reports its next percentage.
    std::optional<int> secondsLeft(double seconds) const;

private:
    /// The beginning and end of a stage in one try, in percent.
    struct Share {
        int from, to;
    };
    /// Returns the share by stageTable; the first stage that it lacks gets the whole run, later ones none.
    Share shareOf(std::string_view name) const;
    static bool isLong(const Share& share);
    /// Returns the done part of the run when `inTry` of the try is done, 0 to 1.
    double wholeAt(double inTry) const;

    bool isFirstTry_ = true, hasBegun_ = false;
    Share stage_{0, 100};
    int stagePercent_ = 0;
    double stageBegan_ = 0;
    double tryFrom_ = 0;     ///< the try's beginning, in percent of a try
    double triesBefore_ = 0; ///< the part of the run before it, 0 to 1
    double inTry_ = 0;       ///< its progress, in percent
    std::optional<double> end_;
};

} // namespace vdbcage::report
