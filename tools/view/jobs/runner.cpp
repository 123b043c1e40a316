#include <tools/view/jobs/runner.h>

#include <utility>

namespace vdbcage::view {

Runner::Runner(std::unique_ptr<CageMaker> maker, std::function<void()> wake)
    : maker_(std::move(maker)),
      worker_([this](const Job& job, Interrupter& interrupter, const auto&) { return maker_->make(job, interrupter); },
              std::move(wake))
{
}

void Runner::want(const std::optional<Order>& order, bool isDragging, bool intermediates)
{
    planner_.want(order, isDragging, intermediates);
    update();
}

void Runner::cancel()
{
    planner_.cancel();
    update();
}

void Runner::again()
{
    planner_.again();
    update();
}

bool Runner::update()
{
    auto outcome = worker_.take();
    if (outcome) {
        if (outcome->result) {
            planner_.finished(*std::move(outcome->result));
        } else if (!outcome->error.empty()) {
            planner_.failed(outcome->error);
        } else {
            planner_.stopped();
        }
    }
    if (planner_.shouldStop()) worker_.stop();
    std::optional<Job> job = planner_.start();
    if (!job) return outcome.has_value();
    worker_.start(*std::move(job));
    return true;
}

void Runner::waitForNews(double seconds)
{
    if (planner_.running()) worker_.waitForNews(seconds);
}

std::optional<Progress> Runner::progress() const
{
    const std::optional<Job>& job = planner_.running();
    if (!job) return std::nullopt;
    return Progress{worker_.progress(), job->kind};
}

} // namespace vdbcage::view
