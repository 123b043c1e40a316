#include <tools/view/posing/pose_checker.h>

#include <utility>

#include <vdbcage/check/check.h>
#include <vdbcage/core/detail/memo.h>
#include <vdbcage/deform/inversions.h>

namespace vdbcage::view {

namespace {

/// The data that all poses of a binding share, for any material.
class Checks {
public:
    PoseCheckPtr operator()(const PoseCheckOrder& order, Interrupter& interrupter)
    {
        const Stage stage(&interrupter, StageName::checkThePose);
        const Mesh& model = order.bind.model->mesh;
        const auto& checker =
            checker_.of(order.bind.model, [&] { return std::make_unique<CageChecker>(model, &interrupter); });
        Mesh posed = *order.bind.cage;
        posed.points = order.cagePoints;
        CheckOptions options;
        options.measure = false;
        const CageCheck check = checker->check(posed, options, &interrupter);
        PoseCheck result;
        result.isValid = check.valid();
        result.selfIntersections = check.selfIntersections;
        if (order.binding) {
            InversionTest& inversions =
                inversions_.of(order.bind, [&] { return InversionTest(*order.binding, model, &interrupter); });
            inversions = inversions.with(order.binding->options().elasticity);
            result.inverted = inversions.inverted(order.cagePoints);
        }
        return std::make_shared<const PoseCheck>(std::move(result));
    }

private:
    vdbcage::detail::Memo<OpenedMeshPtr, std::unique_ptr<CageChecker>> checker_;
    vdbcage::detail::Memo<BindOrder, InversionTest> inversions_;
};

} // namespace

bool operator==(const PoseCheckOrder& a, const PoseCheckOrder& b)
{
    return a.bind == b.bind && a.cagePoints == b.cagePoints && a.binding == b.binding;
}

PoseChecker::PoseChecker(std::function<void()> wake)
    : worker_([checks = std::make_shared<Checks>()](const PoseCheckOrder& order, Interrupter& interrupter,
                                                    const auto&) { return (*checks)(order, interrupter); },
              std::move(wake))
{
}

void PoseChecker::want(const std::optional<PoseCheckOrder>& order)
{
    if (order.has_value() != wanted_.has_value() || (order && !(*order == *wanted_))) {
        wanted_ = order;
        result_.reset();
        error_.clear();
    }
    if (running_ && !(wanted_ && *wanted_ == *running_)) worker_.stop();
    update();
}

void PoseChecker::update()
{
    if (const auto outcome = worker_.take()) {
        if (wanted_ && *wanted_ == *running_) {
            result_ = outcome->result.value_or(nullptr);
            error_ = outcome->error;
        }
        running_.reset();
    }
    if (running_ || isSettled()) return;
    running_ = wanted_;
    worker_.start(*running_);
}

void PoseChecker::waitForNews(double seconds)
{
    if (running_) worker_.waitForNews(seconds);
}

} // namespace vdbcage::view
