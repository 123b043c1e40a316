#include <tools/view/jobs/pose_checker.h>

#include <utility>

#include <vdbcage/check/check.h>
#include <vdbcage/deform/inversions.h>

namespace vdbcage::view {

namespace {

/// Keeps what is the same for all poses of a binding, by any material.
class Checks {
public:
    PoseCheckPtr operator()(const PoseCheckOrder& order, Interrupter& interrupter)
    {
        const Stage stage(&interrupter, StageName::checkThePose);
        const Mesh& model = order.bind.model->mesh;
        if (model_ != order.bind.model) {
            checker_ = std::make_unique<CageChecker>(model, &interrupter);
            model_ = order.bind.model;
        }
        Mesh posed = *order.bind.cage;
        posed.points = order.cagePoints;
        CheckOptions options;
        options.measure = false;
        const CageCheck check = checker_->check(posed, options, &interrupter);
        PoseCheck result;
        result.isValid = check.valid();
        result.selfIntersections = check.selfIntersections;
        if (order.binding) {
            if (!inversions_ || bind_ != order.bind) {
                inversions_.reset(); // it may be interrupted
                inversions_.emplace(*order.binding, model, &interrupter);
                bind_ = order.bind;
            }
            inversions_ = inversions_->with(order.binding->options().elasticity);
            result.inverted = inversions_->inverted(order.cagePoints);
        }
        return std::make_shared<const PoseCheck>(std::move(result));
    }

private:
    OpenedMeshPtr model_; // of the checker
    std::unique_ptr<CageChecker> checker_;
    BindOrder bind_; // of the test
    std::optional<InversionTest> inversions_;
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
