#pragma once

#include <optional>
#include <string_view>

namespace vdbcage::report {

/// Turns the stages that an interrupter is told into how far the whole run is, and how long it will still take.
///
/// A run goes through several stages, and through all of them again where a cage was not good enough: nobody knows how
/// often. So another try shares out what is left of the run, and from then on no time left is told.
///
/// It reads no clock: `seconds` are of the run so far. One thread at a time.
class RunProgress {
public:
    /// The stage `name` begins; empty if it has none.
    void start(std::string_view name, double seconds);
    /// The stage says that it is so far, 0 to 100 %. What is less than it said before changes nothing.
    void advance(int percent, double seconds);

    /// How far the run is, 0 to 99 %: never less than it was.
    int percent() const;
    /// How long the run still takes, in whole seconds from 1; nothing where that is a guess. It is counted down until
    /// the stage says how far it is.
    std::optional<int> secondsLeft(double seconds) const;

private:
    /// Where a stage begins and ends in one try, in percent.
    struct Share {
        int from, to;
    };
    /// As stageTable has it; of others the first is the whole run, later ones take none of it.
    Share shareOf(std::string_view name) const;
    static bool isLong(const Share& share);
    /// How much of the run is done where the try is so far, 0 to 1.
    double wholeAt(double inTry) const;

    bool isFirstTry_ = true, hasBegun_ = false;
    Share stage_{0, 100};
    int stagePercent_ = 0;
    double stageBegan_ = 0;
    double tryFrom_ = 0;     ///< where the try began, in percent of a try
    double triesBefore_ = 0; ///< how much of the run came before it, 0 to 1
    double inTry_ = 0;       ///< how far it is, in percent
    std::optional<double> end_;
};

} // namespace vdbcage::report
