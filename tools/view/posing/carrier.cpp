#include <tools/view/posing/carrier.h>

#include <algorithm>
#include <utility>

namespace vdbcage::view {

Carrier::Carrier(std::function<void()> wake)
    : worker_(
          [](const Job& job, Interrupter& interrupter, const auto&) {
              const Stage stage(&interrupter, StageName::carryThePose);
              auto carried = std::make_shared<PosableCage>(job.cage);
              carried->carry(job.poses, &interrupter);
              return carried;
          },
          std::move(wake))
{
}

PosableCagePtr Carrier::carried(const MeshPtr& cage, const TimeLine& poses)
{
    Job wanted{cage, {}};
    for (const PoseKey& key : poses.keys()) {
        if (key.pose && key.pose->rest != cage) wanted.poses.push_back(key.pose);
    }
    const bool isRunningWanted = isRunning_ && running_.cage == wanted.cage && running_.poses == wanted.poses;
    if (isRunning_ && !isRunningWanted) worker_.stop();
    update();
    if (wanted.poses.empty()) {
        error_.clear();
        return std::make_shared<PosableCage>(cage);
    }
    const bool isReady =
        ready_ && ready_->rest() == cage &&
        std::all_of(wanted.poses.begin(), wanted.poses.end(), [&](const PosePtr& pose) { return ready_->has(pose); });
    if (isReady) return std::exchange(ready_, nullptr);
    if (!isRunning_) {
        running_ = wanted;
        isRunning_ = true;
        worker_.start(std::move(wanted));
    }
    return nullptr;
}

void Carrier::update()
{
    const auto outcome = worker_.take();
    if (!outcome) return;
    isRunning_ = false;
    error_ = outcome->error;
    ready_ = outcome->result.value_or(nullptr);
    if (error_.empty()) return;
    ready_ = std::make_shared<PosableCage>(running_.cage);
    ready_->giveUp(running_.poses);
}

void Carrier::waitForNews(double seconds)
{
    if (isRunning_) worker_.waitForNews(seconds);
}

} // namespace vdbcage::view
