#pragma once

#include <map>
#include <memory>
#include <set>
#include <utility>
#include <vector>

#include <tools/view/state/opened_mesh.h>
#include <vdbcage/core/interrupter.h>

namespace vdbcage::view {

/// A posed cage. It never changes. It keeps the cage at rest that it was made for, so that it can be carried over to
/// any other (see edit::carriedPoses).
struct Pose {
    MeshPtr rest;                       ///< not null
    std::vector<openvdb::Vec3d> points; ///< one for each point of `rest`
};
using PosePtr = std::shared_ptr<const Pose>;

bool areEqual(const PosePtr& a, const PosePtr& b);

/// Returns the pose with the cage's points at `points`; null if that is at rest. \pre as many as the cage has
PosePtr poseOf(const MeshPtr& cage, std::vector<openvdb::Vec3d> points);

/// A cage that can be posed: its points at rest and in each pose. Poses that were made for another cage are carried
/// over once, and kept. Use it from one thread at a time.
class PosableCage {
public:
    explicit PosableCage(MeshPtr rest) : rest_(std::move(rest)) {}

    /// Returns the cage at rest.
    const MeshPtr& rest() const { return rest_; }

    /// Returns whether points() of the pose has nothing to compute. Null is at rest.
    bool has(const PosePtr& pose) const;

    /// Carries over the poses that are not yet here.
    /// \throw InputError as edit::carriedPoses; Cancelled
    void carry(const std::vector<PosePtr>& poses, Interrupter* interrupter);

    /// Puts poses that cannot be carried over at rest.
    void giveUp(const std::vector<PosePtr>& poses);
    bool isGivenUp(const PosePtr& pose) const { return givenUp_.count(pose) > 0; }

    /// Returns the cage's points; null: at rest. They stay valid as long as this object and the pose.
    /// \throw InputError as carry()
    const std::vector<openvdb::Vec3d>& points(const PosePtr& pose);

private:
    MeshPtr rest_; ///< not null
    std::map<PosePtr, std::vector<openvdb::Vec3d>> carried_;
    std::set<PosePtr> givenUp_;
};

/// Null: there is no cage.
using PosableCagePtr = std::shared_ptr<PosableCage>;

} // namespace vdbcage::view
