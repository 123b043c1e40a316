#include <tools/report/run_progress.h>

#include <algorithm>
#include <cmath>

#include <vdbcage/core/stages.h>

namespace vdbcage::report {

namespace {

constexpr int prepared = stageInfo(StageName::surface).to; // until here stages may repeat within one try
constexpr int longStage = 20;   // percent, the least of a stage from which the time left is estimated
constexpr int leastPercent = 5; // of the stage; below, and in its first second, the time left is a guess
constexpr double leastSeconds = 1;

} // namespace

RunProgress::Share RunProgress::shareOf(std::string_view name) const
{
    for (const StageInfo& stage : stageTable) {
        if (stage.name == name && stage.from >= 0) return {stage.from, stage.to};
    }
    if (!hasBegun_) return {0, 100};
    const int here = static_cast<int>(inTry_);
    return {here, here};
}

double RunProgress::wholeAt(double inTry) const
{
    const double share = tryFrom_ < 100 ? (inTry - tryFrom_) / (100 - tryFrom_) : 1;
    return triesBefore_ + (1 - triesBefore_) * std::clamp(share, 0.0, 1.0);
}

bool RunProgress::isLong(const Share& share)
{
    return share.to - share.from >= longStage;
}

void RunProgress::start(std::string_view name, double seconds)
{
    const Share next = shareOf(name);
    if (!hasBegun_) {
        tryFrom_ = inTry_ = next.from;
    } else if (inTry_ > prepared && (next.from < stage_.from || (isLong(stage_) && next.from == stage_.from))) {
        triesBefore_ = wholeAt(inTry_);
        tryFrom_ = inTry_ = next.from;
        isFirstTry_ = false;
        end_.reset();
    }
    hasBegun_ = true;
    stage_ = next;
    stagePercent_ = 0;
    stageBegan_ = seconds;
    inTry_ = std::max(inTry_, static_cast<double>(next.from));
}

void RunProgress::advance(int percent, double seconds)
{
    percent = std::min(percent, 100);
    if (percent <= stagePercent_) return;
    stagePercent_ = percent;
    hasBegun_ = true; // also without a stage
    inTry_ = std::max(inTry_, stage_.from + 0.01 * (stage_.to - stage_.from) * percent);
    const double took = seconds - stageBegan_;
    if (!isFirstTry_ || !isLong(stage_) || percent < leastPercent || took < leastSeconds) return;
    // The stage continues at its speed; the stages after it take their shares of all.
    const double stageEnd = seconds + took * (100 - percent) / percent;
    end_ = stageEnd / wholeAt(stage_.to);
}

int RunProgress::percent() const
{
    return std::min(99, static_cast<int>(100 * wholeAt(inTry_) + 1e-9));
}

std::optional<int> RunProgress::secondsLeft(double seconds) const
{
    if (!end_ || !(*end_ > seconds)) return std::nullopt;
    return static_cast<int>(std::min(1e9, std::ceil(*end_ - seconds)));
}

} // namespace vdbcage::report
