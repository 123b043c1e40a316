#include <tools/view/posing/posing.h>

#include <algorithm>
#include <utility>

#include <tools/view/state/cage_changes.h>

namespace vdbcage::view {

CageResultPtr Posing::cageOf(const State& state, const Planner& planner)
{
    const TimeLine& poses = state.document.poses;
    const CageResultPtr wanted = wantedCage(state.document, planner);
    if (!wanted) {
        posable_.reset();
    } else if (state.view.mode == Mode::pose) {
        if (wanted == shown_ && areCarried(poses, *posable_)) return shown_;
        PosableCagePtr carried = carrier_.carried(MeshPtr(wanted, &wanted->cage), poses);
        if (!carried) return shown_;
        posable_ = std::move(carried);
    } else if (wanted != shown_) {
        posable_ = std::make_shared<PosableCage>(MeshPtr(wanted, &wanted->cage));
    }
    shown_ = wanted;
    return shown_;
}

CageResultPtr Posing::wantedCage(const Document& document, const Planner& planner)
{
    const CageResultPtr& made = planner.made();
    const bool isOfCage = made && made->order.cage == document.cage && (document.isFitted || !made->order.fit);
    if (!document.cage || isOfCage) return made;
    return unchecked_.of(document.cage, [&] {
        CageResult result;
        result.order = {document.model, document.options, document.cage};
        result.cage = document.cage->mesh;
        return std::make_shared<const CageResult>(std::move(result));
    });
}

void Posing::follow(const State& state, const Planner& planner, bool standsStill)
{
    const Document& document = state.document;
    Follower::Conditions conditions;
    conditions.isPosing = state.view.mode == Mode::pose && document.model && posable_;
    if (conditions.isPosing && !areCarried(document.poses, *posable_)) return;
    // A preview's cage is replaced in a moment.
    conditions.isToStay = planner.standing() == Planner::Standing::current || planner.isHalted();
    conditions.standsStill = standsStill;
    poses_ = document.poses;
    cagePoints_ = pointsMemo_.of(std::tie(poses_, posable_, state.view.mode, state.view.frame), [&] {
        return std::make_shared<const std::vector<openvdb::Vec3d>>(view::cagePoints(state, posable_));
    });
    const MeshPtr rest = posable_ ? posable_->rest() : nullptr;
    follower_.follow(state, rest, *cagePoints_, conditions);
    if (!conditions.isPosing || !state.view.compared) {
        compared_.reset();
        return;
    }
    if (!compared_) compared_ = std::make_unique<Follower>(work_, wake_);
    State other = state;
    other.document.coordinates = *state.view.compared;
    other.document.weights.reset();
    compared_->follow(other, rest, *cagePoints_, conditions);
}

bool Posing::isPosed(const State& state) const
{
    return !cagePoints_->empty() && state.view.mode == Mode::pose && posable_ &&
           *cagePoints_ != posable_->rest()->points;
}

bool Posing::hasMaterial(const State& state) const
{
    if (state.view.mode != Mode::pose) return false;
    const BoundModelPtr& bound = follower_.bound(); // weights from a file may belong to the family
    const auto isElastic = [](Coordinates family) { return familyInfo(family).hasElasticity; };
    return isElastic(state.document.coordinates) || (state.view.compared && isElastic(*state.view.compared)) ||
           (bound && bound->whole && isElastic(bound->whole->family()));
}

void Posing::update()
{
    carrier_.update();
    follower_.update();
    if (compared_) compared_->update();
}

bool Posing::isSettled() const
{
    return !carrier_.isBusy() && follower_.isSettled() && (!compared_ || compared_->isSettled());
}

void Posing::waitForNews(double seconds)
{
    if (carrier_.isBusy()) {
        carrier_.waitForNews(seconds);
    } else if (!follower_.isSettled()) {
        follower_.waitForNews(seconds);
    } else if (compared_) {
        compared_->waitForNews(seconds);
    }
}

void Posing::again()
{
    follower_.binder().again();
    if (compared_) compared_->binder().again();
}

void Posing::cancel()
{
    follower_.binder().cancel();
    if (compared_) compared_->binder().cancel();
}

const std::string& Posing::error() const
{
    const auto isGivenUp = [&](const PoseKey& key) { return posable_ && posable_->isGivenUp(key.pose); };
    if (std::any_of(poses_.keys().begin(), poses_.keys().end(), isGivenUp)) return carrier_.error();
    return compared_ && follower_.error().empty() ? compared_->error() : follower_.error();
}

} // namespace vdbcage::view
