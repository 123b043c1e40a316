#pragma once

#include <optional>
#include <vector>

#include <vdbcage/bounding/detail/guard/guard_model.h>
#include <vdbcage/bounding/detail/guard/limb.h>
#include <vdbcage/bounding/face_wishes.h>

namespace vdbcage::detail {

/// The wishes for the places of faces, in the units of a guard's model.
class Wishes {
public:
    /// Wishes nothing.
    Wishes() = default;
    /// \throw InputError as FaceWishes
    /// \throw Cancelled
    Wishes(const GuardModel& guard, const FaceWishOptions& options, Interrupter* interrupter);

    /// Returns whether distance counts more in some places than in others.
    bool hasDensity() const { return !density_.isNone() || !aroundJoints_.empty(); }
    /// Returns the weight of distance at a point of the model: the third power of the density.
    ///
    /// Faces of size h are about h^2 from the model. The integral of the distance is least where h^4 times the weight
    /// is the same everywhere: with the second power of the density. For the squared distance it is the third. But
    /// faces follow only in part, since other places have to give them up. With powers higher by one and two, a sphere
    /// with a quarter of the faces gets 1.8 times as many for a density of 2.
    double distanceWeight(const Vec3d& onModel) const;
    /// Returns the weight of squared distance: the fifth power.
    double quadricWeight(const Vec3d& onModel) const;

    /// Returns the limbs at the joints, beyond the plane of symmetry.
    const std::vector<Limb>& limbs() const { return limbs_; }

private:
    double density(const Vec3d& onModel) const;

    FactorField density_;                    // in the world's units
    std::vector<FactorRegion> aroundJoints_; // the same; where they overlap they count once
    std::vector<Limb> limbs_;
    double scale_ = 1;                      // from the world's units to the guard's
    std::optional<SymmetryPlane> symmetry_; // in the guard's
};

} // namespace vdbcage::detail
