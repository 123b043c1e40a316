#include <tools/view/posing/binder.h>

#include <utility>

namespace vdbcage::view {

Binder::Binder(Work work, std::function<void()> wake, std::size_t mostBytes)
    : worker_(std::move(work), std::move(wake)), mostBytes_(mostBytes)
{
}

void Binder::want(const std::optional<BindOrder>& order)
{
    const bool isOther = order.has_value() != wanted_.has_value() || (order && *order != *wanted_);
    if (isOther) {
        wanted_ = order;
        isHalted_ = false;
        error_.clear();
        bound_.reset();
        for (const BoundModelPtr& kept : kept_) {
            if (wanted_ && kept->order == *wanted_) bound_ = kept;
        }
    }
    reconsider();
    update();
}

void Binder::cancel()
{
    isHalted_ = isHalted_ || !isSettled();
    reconsider();
}

void Binder::again()
{
    isHalted_ = false;
    error_.clear();
    update();
}

void Binder::reconsider()
{
    if (running_ && (isHalted_ || !wanted_ || *wanted_ != *running_)) worker_.stop();
}

bool Binder::update()
{
    auto outcome = worker_.take();
    if (outcome) {
        const bool isWanted = wanted_ && running_ && *wanted_ == *running_;
        if (outcome->result) {
            if (isWanted) bound_ = *outcome->result;
            if ((*outcome->result)->whole) keep(*outcome->result);
        } else if (isWanted && !outcome->error.empty()) {
            isHalted_ = true;
            error_ = outcome->error;
        }
        if (outcome->isLast) running_.reset();
    }
    if (running_ || isSettled()) return outcome.has_value();
    running_ = wanted_;
    worker_.start(*running_);
    return true;
}

void Binder::waitForNews(double seconds)
{
    if (running_) worker_.waitForNews(seconds);
}

bool Binder::isSettled() const
{
    return !wanted_ || isHalted_ || (bound_ && bound_->whole);
}

std::optional<WorkProgress> Binder::progress() const
{
    if (!running_) return std::nullopt;
    return worker_.progress();
}

void Binder::keep(const BoundModelPtr& bound)
{
    kept_.remove_if([&](const BoundModelPtr& other) { return other->order == bound->order; });
    kept_.push_front(bound);
    std::size_t bytes = 0;
    for (auto i = kept_.begin(); i != kept_.end();) {
        bytes += (*i)->whole->weightBytes();
        i = i != kept_.begin() && bytes > mostBytes_ ? kept_.erase(i) : std::next(i);
    }
}

Binder::Work bindingWork()
{
    return [](const BindOrder& order, Interrupter& interrupter, const auto& publish) {
        const BoundModelPtr coarse = boundCoarsely(order, &interrupter);
        if (coarse->coarse) publish(coarse);
        return boundWhole(*coarse, &interrupter);
    };
}

} // namespace vdbcage::view
