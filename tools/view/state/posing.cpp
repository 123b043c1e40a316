#include <tools/view/state/posing.h>

#include <utility>

#include <tools/view/state/model_values.h>
#include <tools/view/state/move.h>
#include <vdbcage/core/error.h>

namespace vdbcage::view {

namespace {

BindOrder orderOf(const State& state)
{
    return {state.document.model, state.cage, state.document.coordinates};
}

} // namespace

CageResultPtr Posing::cageOf(const Document& document, const Planner& planner)
{
    const CageResultPtr& made = planner.shown();
    if (!document.cage || (made && made->order.cage == document.cage)) return made;
    if (!unchecked_ || unchecked_->order.cage != document.cage) {
        CageResult result;
        result.order = {document.model, document.options, document.cage};
        result.cage = document.cage->mesh;
        unchecked_ = std::make_shared<const CageResult>(std::move(result));
    }
    return unchecked_;
}

void Posing::follow(const State& state, const Planner& planner)
{
    const Document& document = state.document;
    const bool isPosing = state.view.mode == Mode::pose && document.model && state.cage;
    // A preview's cage is gone in a moment: it is not worth the binding.
    const bool isToStay = planner.standing() == Planner::Standing::current || planner.isHalted();
    if (!isPosing) {
        binder_.want(std::nullopt);
    } else if (isToStay) {
        binder_.want(orderOf(state));
    }
    if (document.pose != pose_ || state.cage != cage_ || state.view.mode != mode_) {
        pose_ = document.pose;
        cage_ = state.cage;
        mode_ = state.view.mode;
        cagePoints_ = view::cagePoints(state);
    }
    const BoundModelPtr& bound = binder_.bound();
    if (!isPosing || !document.pose) {
        model_.update(nullptr, {});
    } else if (bound && bound->order == orderOf(state)) {
        model_.update(bound, cagePoints_);
    }
    followValues(state);
}

void Posing::followValues(const State& state)
{
    const BoundModelPtr& bound = binder_.bound();
    const bool isBound = bound && bound->whole && bound->order == orderOf(state);
    ModelColours colours = isBound && state.view.mode == Mode::pose ? state.view.modelColours : ModelColours::plain;
    if (colours == ModelColours::stretch && !model_.isWhole()) colours = ModelColours::plain; // it is at rest
    std::vector<openvdb::Index32> points;
    if (colours == ModelColours::influence) points = selectedPoints(state);
    const std::uint64_t version = colours == ModelColours::stretch ? model_.version() : 0;
    if (colours == valuesOf_ && bound == valuesBound_ && points == valuesPoints_ && version == valuesVersion_) return;
    valuesOf_ = colours;
    valuesBound_ = bound;
    valuesPoints_ = points;
    valuesVersion_ = version;
    values_.reset();
    if (colours == ModelColours::influence) {
        values_ = std::make_shared<const std::vector<double>>(influence(*bound->whole, points));
    } else if (colours == ModelColours::stretch) {
        values_ = std::make_shared<const std::vector<double>>(stretch(bound->order.model->mesh, model_.points()));
    }
}

std::shared_ptr<const Binding> Posing::bindingOf(const State& state)
{
    binder_.again();
    for (binder_.want(orderOf(state)); !binder_.isSettled(); binder_.update()) binder_.waitForNews(1);
    const BoundModelPtr& bound = binder_.bound();
    if (!bound || !bound->whole) throw InputError(binder_.error());
    return bound->whole;
}

} // namespace vdbcage::view
