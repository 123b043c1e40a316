#include <vdbcage/core/interrupter.h>

#include <algorithm>

#include <vdbcage/core/error.h>

namespace vdbcage {

static_assert(
    [] {
        std::size_t row = 0;
        for (const StageInfo& info : stageTable) {
            if (info.stage != static_cast<StageName>(row++)) return false;
        }
        return stageTable.back().stage == StageName::write;
    }(),
    "stageTable has a row for each StageName, in the same order");

void throwIfInterrupted(Interrupter* interrupter, int percent)
{
    if (interrupter && interrupter->wasInterrupted(percent)) throw Cancelled();
}

Stage::Stage(Interrupter* interrupter, StageName name) : interrupter_(interrupter)
{
    throwIfInterrupted(interrupter_);
    if (interrupter_) interrupter_->start(stageInfo(name).name);
}

Stage::~Stage()
{
    if (interrupter_) interrupter_->end();
}

StageClock::~StageClock() = default;

void StageClock::start(const char* name)
{
    // All allocations are made here: `end` may run while an exception is on its way.
    const std::string stage = name ? name : "";
    current_ = static_cast<std::size_t>(
        std::find_if(stages_.begin(), stages_.end(), [&](const StageTime& known) { return known.name == stage; }) -
        stages_.begin());
    if (current_ == stages_.size()) stages_.push_back({stage, 0, 0});
    began_ = std::chrono::steady_clock::now();
    cpuBegan_ = std::clock();
    if (next_) next_->start(name);
}

void StageClock::end()
{
    if (current_ < stages_.size()) {
        StageTime& stage = stages_[current_];
        stage.seconds += std::chrono::duration<double>(std::chrono::steady_clock::now() - began_).count();
        stage.cpuSeconds += static_cast<double>(std::clock() - cpuBegan_) / CLOCKS_PER_SEC;
    }
    if (next_) next_->end();
}

bool StageClock::wasInterrupted(int percent)
{
    return next_ && next_->wasInterrupted(percent);
}

} // namespace vdbcage
