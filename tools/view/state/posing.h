#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include <tools/view/state/binder.h>
#include <tools/view/state/planner.h>
#include <tools/view/state/posed_model.h>
#include <tools/view/state/state.h>

namespace vdbcage::view {

/// What is to be seen of a state: the cage, where its points are, and where these take the model.
class Posing {
public:
    /// See Binder.
    Posing(Binder::Work work, std::function<void()> wake) : binder_(std::move(work), std::move(wake)) {}

    /// The cage to show; null: none. One that was opened or moved by hand is there at once, without a verdict until it
    /// is checked.
    CageResultPtr cageOf(const Document& document, const Planner& planner);

    /// Follows a state, whose cage is that of cageOf(): binds what is to be posed, and poses it. Until something new is
    /// bound the model stays as it was posed before.
    /// Cost: as Binding::pose, if the pose is another.
    void follow(const State& state, const Planner& planner);

    /// As of the last follow(): where the cage's points are, and the model.
    const std::vector<openvdb::Vec3d>& cagePoints() const { return cagePoints_; }
    const PosedModel& model() const { return model_; }
    /// What the model's colours tell, a value for each of its points; null: nothing. Another one is another object.
    const std::shared_ptr<const std::vector<double>>& modelValues() const { return values_; }

    /// The whole binding of a state's model to its cage: waits until it is there.
    /// \pre the state has both \throw InputError it cannot be bound
    std::shared_ptr<const Binding> bindingOf(const State& state);

    Binder& binder() { return binder_; }
    const Binder& binder() const { return binder_; }

private:
    void followValues(const State& state);

    Binder binder_;
    CageResultPtr unchecked_;
    std::vector<openvdb::Vec3d> cagePoints_;
    // What cagePoints_ were made of.
    PosePtr pose_;
    MeshPtr cage_;
    Mode mode_ = Mode::shape;
    PosedModel model_;
    std::shared_ptr<const std::vector<double>> values_;
    // What they were made of.
    ModelColours valuesOf_ = ModelColours::plain;
    BoundModelPtr valuesBound_;
    std::vector<openvdb::Index32> valuesPoints_;
    std::uint64_t valuesVersion_ = 0;
};

} // namespace vdbcage::view
