#include <vdbcage/core/interrupter.h>

#include <algorithm>

#include <vdbcage/core/error.h>

namespace vdbcage {

void throwIfInterrupted(Interrupter* interrupter, int percent)
{
    if (interrupter && interrupter->wasInterrupted(percent)) throw Cancelled();
}

Stage::Stage(Interrupter* interrupter, const char* name) : interrupter_(interrupter)
{
    throwIfInterrupted(interrupter_);
    if (interrupter_) interrupter_->start(name);
}

Stage::~Stage()
{
    if (interrupter_) interrupter_->end();
}

StageClock::~StageClock() = default;

void StageClock::start(const char* name)
{
    name_ = name ? name : "";
    began_ = std::chrono::steady_clock::now();
    cpuBegan_ = std::clock();
    if (next_) next_->start(name);
}

void StageClock::end()
{
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - began_).count();
    const double cpuSeconds = static_cast<double>(std::clock() - cpuBegan_) / CLOCKS_PER_SEC;
    const auto known =
        std::find_if(stages_.begin(), stages_.end(), [&](const StageTime& stage) { return stage.name == name_; });
    if (known == stages_.end()) {
        stages_.push_back({name_, seconds, cpuSeconds});
    } else {
        known->seconds += seconds;
        known->cpuSeconds += cpuSeconds;
    }
    if (next_) next_->end();
}

bool StageClock::wasInterrupted(int percent)
{
    return next_ && next_->wasInterrupted(percent);
}

} // namespace vdbcage
