#pragma once

#include <vector>

#include <tools/view/state/bound_model.h>

namespace vdbcage::view {

/// A model where a posed cage takes it: its points once it is bound, until then those of its stand-in.
class PosedModel {
public:
    /// Brings it to a pose. `bound` null: at rest. Returns whether anything changed.
    /// \pre as many `cagePoints` as the bound cage has
    /// Cost: as Binding::pose, if there is anything to do.
    bool update(const BoundModelPtr& bound, const std::vector<openvdb::Vec3d>& cagePoints);

    /// What it is bound by; null: it is at rest.
    const BoundModelPtr& bound() const { return bound_; }
    bool isWhole() const { return bound_ && bound_->whole; }
    /// Of the model if isWhole(), else of the stand-in; empty at rest. As Binding::pose has them.
    const std::vector<openvdb::Vec3d>& points() const { return points_; }
    /// Goes up with each change.
    std::uint64_t version() const { return version_; }

private:
    BoundModelPtr bound_;
    std::vector<openvdb::Vec3d> cagePoints_, points_;
    std::uint64_t version_ = 0;
};

} // namespace vdbcage::view
