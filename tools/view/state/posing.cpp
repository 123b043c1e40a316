#include <tools/view/state/posing.h>

#include <algorithm>
#include <utility>

#include <tools/view/state/model_values.h>
#include <tools/view/state/move.h>

namespace vdbcage::view {

CageResultPtr Posing::cageOf(const State& state, const Planner& planner)
{
    const TimeLine& poses = state.document.poses;
    const CageResultPtr wanted = wantedCage(state.document, planner);
    if (!wanted) {
        carried_.reset();
    } else if (state.view.mode == Mode::pose) {
        if (wanted == shown_ && isCarried(poses)) return shown_;
        auto carried = carrier_.carried(MeshPtr(wanted, &wanted->cage), poses);
        if (!carried) return shown_;
        carried_ = std::move(carried);
    } else if (wanted != shown_) {
        carried_ = std::make_shared<CarriedPoses>(MeshPtr(wanted, &wanted->cage));
    }
    shown_ = wanted;
    return shown_;
}

bool Posing::isCarried(const TimeLine& poses) const
{
    return std::all_of(poses.keys().begin(), poses.keys().end(),
                       [&](const PoseKey& key) { return carried_->has(key.pose); });
}

CageResultPtr Posing::wantedCage(const Document& document, const Planner& planner)
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

void Posing::follow(const State& state, const Planner& planner, bool standsStill)
{
    const Document& document = state.document;
    const bool isPosing = state.view.mode == Mode::pose && document.model && state.cage;
    if (isPosing && !isCarried(document.poses)) return;
    // A preview's cage is gone in a moment: it is not worth the binding.
    const bool isToStay = planner.standing() == Planner::Standing::current || planner.isHalted();
    if (!isPosing) {
        binder_.want(std::nullopt);
    } else if (isToStay) {
        binder_.want(bindOrder(state));
    }
    if (document.poses != poses_ || state.cage != cage_ || state.view.mode != mode_ || state.view.frame != frame_) {
        poses_ = document.poses;
        cage_ = state.cage;
        mode_ = state.view.mode;
        frame_ = state.view.frame;
        cagePoints_ = view::cagePoints(state);
    }
    const BoundModelPtr& bound = binder_.bound();
    if (!isPosing || cagePoints_ == state.cage->points) {
        model_.update(nullptr, {});
    } else if (bound && bound->order == bindOrder(state)) {
        model_.update(bound, cagePoints_);
    }
    followCheck(state, standsStill && isPosing);
    followValues(state);
}

void Posing::followCheck(const State& state, bool standsStill)
{
    std::optional<PoseCheckOrder> order;
    if (standsStill && cagePoints_ != state.cage->points) {
        order = PoseCheckOrder{bindOrder(state), cagePoints_, nullptr};
        const bool areCounted = state.view.modelColours == ModelColours::inverted;
        if (areCounted) order->binding = bindingOf(state);
        // It is counted once it is bound.
        if (areCounted && !order->binding && !binder_.isHalted()) order.reset();
    }
    checker_.want(order);
}

void Posing::update()
{
    binder_.update();
    checker_.update();
}

void Posing::waitForNews(double seconds)
{
    if (carrier_.isBusy()) {
        carrier_.waitForNews(seconds);
    } else if (!binder_.isSettled()) {
        binder_.waitForNews(seconds);
    } else {
        checker_.waitForNews(seconds);
    }
}

std::string Posing::error() const
{
    if (!carrier_.error().empty()) return carrier_.error();
    return binder_.error().empty() ? checker_.error() : binder_.error();
}

void Posing::followValues(const State& state)
{
    const BoundModelPtr& bound = binder_.bound();
    const bool isBound = bound && bound->whole && bound->order == bindOrder(state);
    ModelColours colours = isBound && state.view.mode == Mode::pose ? state.view.modelColours : ModelColours::plain;
    if (colours == ModelColours::stretch && !model_.isWhole()) colours = ModelColours::plain; // it is at rest
    std::vector<openvdb::Index32> points;
    if (colours == ModelColours::influence) points = selectedPoints(state);
    const std::uint64_t version = colours == ModelColours::stretch ? model_.version() : 0;
    const PoseCheckPtr check = colours == ModelColours::inverted ? checker_.result() : nullptr;
    // Until the next pose is checked the colours are those of the last one.
    if (colours == ModelColours::inverted && valuesOf_ == colours && model_.bound() && !check) return;
    if (colours == valuesOf_ && bound == valuesBound_ && points == valuesPoints_ && version == valuesVersion_ &&
        check == valuesCheck_) {
        return;
    }
    valuesOf_ = colours;
    valuesBound_ = bound;
    valuesPoints_ = points;
    valuesVersion_ = version;
    valuesCheck_ = check;
    values_.reset();
    if (colours == ModelColours::influence) {
        values_ = std::make_shared<const std::vector<double>>(influence(*bound->whole, points));
    } else if (colours == ModelColours::stretch) {
        values_ = std::make_shared<const std::vector<double>>(stretch(bound->order.model->mesh, model_.points()));
    } else if (check && check->inverted) {
        values_ = std::make_shared<const std::vector<double>>(cornersOf(*check->inverted, bound->order.model->mesh));
    }
}

std::shared_ptr<const Binding> Posing::bindingOf(const State& state) const
{
    const BoundModelPtr& bound = binder_.bound();
    return bound && bound->order == bindOrder(state) ? bound->whole : nullptr;
}

} // namespace vdbcage::view
