#pragma once

#include <vector>

#include <tools/view/posing/bound_model.h>

namespace vdbcage::view {

/// A model posed by a cage: its points once it is bound, until then those of its stand-in.
class PosedModel {
public:
    /// Poses it. `bound` null: at rest. Returns whether anything changed.
    /// \pre as many `cagePoints` as the bound cage has
    /// Cost: as Binding::pose, if there is anything to do.
    bool update(const BoundModelPtr& bound, const std::vector<openvdb::Vec3d>& cagePoints);

    /// Returns its binding; null: it is at rest.
    const BoundModelPtr& bound() const { return bound_; }
    bool isWhole() const { return bound_ && bound_->whole; }
    /// Returns the points of the model if isWhole(), else of the stand-in, in the order of Binding::pose; empty at
    /// rest.
    const std::vector<openvdb::Vec3d>& points() const { return points_; }
    /// Returns a number that grows with each change.
    std::uint64_t version() const { return version_; }

private:
    BoundModelPtr bound_;
    std::vector<openvdb::Vec3d> cagePoints_, points_;
    std::uint64_t version_ = 0;
};

} // namespace vdbcage::view
