#include <tools/view/jobs/opened_cages.h>

#include <utility>

#include <tools/report/fit_words.h>
#include <vdbcage/bounding/fit.h>
#include <vdbcage/core/error.h>
#include <vdbcage/mesh/parts.h>

namespace vdbcage::view {

CageResult OpenedCages::made(const Order& order, Interrupter& interrupter)
{
    take(order, interrupter);
    CageResult result;
    result.order = order;
    result.cage = order.cage->mesh;
    const bool fits = order.fit && hasToMove(order, interrupter) && fit(result, interrupter);
    if (!fits) result.report.check = checked(result.cage, interrupter);
    return result;
}

void OpenedCages::take(const Order& order, Interrupter& interrupter)
{
    if (checker_ && model_ == order.model && leastPart_ == order.options.leastPart) return;
    checker_.reset();
    guard_.reset();
    model_ = order.model;
    leastPart_ = order.options.leastPart;
    const Stage stage(&interrupter, StageName::guard);
    largeParts_ = leastPart_ > 0 ? largeParts(model_->mesh, leastPart_).mesh : Mesh();
    checker_.emplace(leastPart_ > 0 ? largeParts_ : model_->mesh, &interrupter);
}

const BoundingGuard& OpenedCages::guard(Precision precision, Interrupter& interrupter)
{
    if (!guard_ || precision_ != precision) {
        const Stage stage(&interrupter, StageName::guard);
        guard_.emplace(leastPart_ > 0 ? largeParts_ : model_->mesh, fitGuardOptions(precision), &interrupter);
        precision_ = precision;
    }
    return *guard_;
}

bool OpenedCages::hasToMove(const Order& order, Interrupter& interrupter)
{
    // A cage that bounds has nothing that has to move, whatever its shape is.
    const Mesh& cage = order.cage->mesh;
    return order.fit->tightness > 0 || !checked(cage, interrupter).bounding() ||
           !guard(order.options.precision, interrupter).facesTooNear(cage).empty();
}

bool OpenedCages::fit(CageResult& result, Interrupter& interrupter)
{
    const FitOrder& order = *result.order.fit;
    FitOptions options;
    options.tightness = order.tightness;
    options.keptPoints.assign(order.locked.begin(), order.locked.end());
    options.tightening = tightenOptions(Effort::fair);
    const BoundingGuard& model = guard(result.order.options.precision, interrupter);
    try {
        Fit fitted = fitCage(result.cage, model, options, &interrupter);
        CageCheck check = checked(fitted.cage, interrupter);
        if (fitted.obstacle == Fit::Obstacle::none && check.bounding()) {
            result.cage = std::move(fitted.cage);
            result.report.check = std::move(check);
            return true;
        }
        result.fitProblem = "no place was found where " + report::unfoundPlace(fitted);
    } catch (const InputError& error) {
        result.fitProblem = error.problem();
    }
    return false;
}

CageCheck OpenedCages::checked(const Mesh& cage, Interrupter& interrupter) const
{
    const Stage stage(&interrupter, StageName::certify);
    return checker_->check(cage, {}, &interrupter);
}

} // namespace vdbcage::view
