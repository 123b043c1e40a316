#include <tools/view/posing/follower.h>

#include <tools/view/state/cage_changes.h>

namespace vdbcage::view {

void Follower::follow(const State& state, const MeshPtr& cage, const std::vector<openvdb::Vec3d>& cagePoints,
                      const Conditions& conditions)
{
    if (!conditions.isPosing) {
        binder_.want(std::nullopt);
    } else if (conditions.isToStay) {
        binder_.want(bindOrder(state.document, cage));
    }
    const Elasticity& elasticity = state.document.elasticity;
    bound_ = withMaterial_.of(std::make_pair(binder_.bound(), elasticity),
                              [&] { return withMaterial(binder_.bound(), elasticity); });
    if (!conditions.isPosing || cagePoints == cage->points) {
        model_.update(nullptr, {});
    } else if (bound_ && bound_->order == bindOrder(state.document, cage)) {
        model_.update(bound_, cagePoints);
    }
    followCheck(state, cage, cagePoints, conditions.isPosing && conditions.standsStill);
    followValues(state, cage);
}

void Follower::followCheck(const State& state, const MeshPtr& cage, const std::vector<openvdb::Vec3d>& cagePoints,
                           bool standsStill)
{
    std::optional<PoseCheckOrder> order;
    if (standsStill && cagePoints != cage->points) {
        const BindOrder bound = bindOrder(state.document, cage);
        order = PoseCheckOrder{bound, cagePoints, nullptr};
        // Given weights are unknown at the points that counting needs.
        const bool areCounted =
            state.view.modelColours == ModelColours::inverted && state.document.coordinates != Coordinates::given;
        if (areCounted) order->binding = bindingIfReady(bound);
        // Triangles are counted once the model is bound.
        if (areCounted && !order->binding && !binder_.isHalted()) order.reset();
    }
    checker_.want(order);
}

void Follower::followValues(const State& state, const MeshPtr& cage)
{
    const bool isBound = bound_ && bound_->whole && bound_->order == bindOrder(state.document, cage);
    ModelColours colours = isBound && state.view.mode == Mode::pose ? state.view.modelColours : ModelColours::plain;
    if (colours == ModelColours::stretch && !model_.isWhole()) colours = ModelColours::plain; // it is at rest
    std::vector<openvdb::Index32> points;
    if (colours == ModelColours::influence) points = selectedPoints(*cage, state.view.selection);
    const std::uint64_t version = colours == ModelColours::stretch ? model_.version() : 0;
    const PoseCheckPtr check = colours == ModelColours::inverted ? checker_.result() : nullptr;
    // Until the next pose is checked the colours are those of the previous one.
    if (colours == ModelColours::inverted && valuesOf_ == colours && model_.bound() && !check) return;
    valuesOf_ = colours;
    values_ = valuesMemo_.of(std::tie(colours, bound_, points, version, check), [&]() -> ModelValues {
        const auto kept = [](std::vector<double> values) {
            return std::make_shared<const std::vector<double>>(std::move(values));
        };
        if (colours == ModelColours::influence) return kept(influence(*bound_->whole, points));
        if (colours == ModelColours::stretch) return kept(stretch(bound_->order.model->mesh, model_.points()));
        if (check && check->inverted) return kept(cornersOf(*check->inverted, bound_->order.model->mesh));
        return nullptr;
    });
}

void Follower::update()
{
    binder_.update();
    checker_.update();
}

void Follower::waitForNews(double seconds)
{
    if (!binder_.isSettled()) return binder_.waitForNews(seconds);
    checker_.waitForNews(seconds);
}

std::shared_ptr<const Binding> Follower::bindingIfReady(const BindOrder& order) const
{
    return bound_ && bound_->order == order ? bound_->whole : nullptr;
}

} // namespace vdbcage::view
