#include <tools/view/state/runner.h>

#include <chrono>
#include <exception>
#include <utility>

#include <vdbcage/core/error.h>

namespace vdbcage::view {

/// Passes progress to the owner's thread and its wish to stop to the job.
class Runner::Reporter : public Interrupter {
public:
    explicit Reporter(Runner& runner) : runner_(runner) {}

    void start(const char* name) override
    {
        {
            const std::lock_guard<std::mutex> lock(runner_.mutex_);
            runner_.progress_.stage = name ? name : "";
            runner_.progress_.percent = -1;
        }
        percent_ = -1;
        runner_.wake_();
    }
    void end() override {}
    bool wasInterrupted(int percent) override
    {
        // Called from many threads, some million times a second: only a new number takes the lock.
        if (percent >= 0 && percent_.exchange(percent, std::memory_order_relaxed) != percent) {
            {
                const std::lock_guard<std::mutex> lock(runner_.mutex_);
                runner_.progress_.percent = percent;
            }
            runner_.wake_();
        }
        return runner_.stop_.load(std::memory_order_relaxed);
    }

private:
    Runner& runner_;
    std::atomic<int> percent_{-1};
};

Runner::Runner(std::unique_ptr<CageMaker> maker, std::function<void()> wake)
    : maker_(std::move(maker)), wake_(std::move(wake)), thread_([this] { work(); })
{
}

Runner::~Runner()
{
    stop_ = true;
    {
        const std::lock_guard<std::mutex> lock(mutex_);
        quits_ = true;
    }
    changed_.notify_all();
    thread_.join();
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
    std::optional<Outcome> outcome;
    {
        const std::lock_guard<std::mutex> lock(mutex_);
        outcome.swap(outcome_);
    }
    if (outcome) {
        if (outcome->result) {
            planner_.finished(std::move(outcome->result));
        } else if (!outcome->error.empty()) {
            planner_.failed(outcome->error);
        } else {
            planner_.stopped();
        }
    }
    if (planner_.shouldStop()) stop_ = true;
    std::optional<Job> job = planner_.start();
    if (!job) return outcome.has_value();
    stop_ = false;
    {
        const std::lock_guard<std::mutex> lock(mutex_);
        progress_ = {job->kind, {}, -1};
        job_ = std::move(job);
    }
    changed_.notify_all();
    return true;
}

void Runner::waitForNews(double seconds)
{
    if (!planner_.running()) return;
    std::unique_lock<std::mutex> lock(mutex_);
    changed_.wait_for(lock, std::chrono::duration<double>(seconds), [&] { return outcome_.has_value(); });
}

std::optional<Progress> Runner::progress() const
{
    if (!planner_.running()) return std::nullopt;
    const std::lock_guard<std::mutex> lock(mutex_);
    return progress_;
}

void Runner::work()
{
    std::unique_lock<std::mutex> lock(mutex_);
    for (;;) {
        changed_.wait(lock, [&] { return quits_ || job_; });
        if (quits_) return;
        const Job job = *std::exchange(job_, std::nullopt);
        lock.unlock();
        Outcome outcome = make(job);
        lock.lock();
        outcome_ = std::move(outcome);
        changed_.notify_all();
        lock.unlock();
        wake_();
        lock.lock();
    }
}

Runner::Outcome Runner::make(const Job& job)
{
    Reporter reporter(*this);
    try {
        return {maker_->make(job, reporter), {}};
    } catch (const Cancelled&) {
        return {};
    } catch (const std::exception& error) { // of memory too: the window stays, with the cage that it has
        const std::string text = error.what();
        return {nullptr, text.empty() ? "the cage cannot be made" : text};
    }
}

} // namespace vdbcage::view
