#include <vdbcage/bounding/detail/guard/wishes.h>

#include <algorithm>
#include <cmath>
#include <sstream>

#include <vdbcage/core/error.h>
#include <vdbcage/volume/detail/factor_at.h>

namespace vdbcage::detail {

namespace {

/// \throw InputError
void requireValid(const Joint& joint, const openvdb::BBoxd& box)
{
    const auto refuse = [&](const char* why) {
        std::ostringstream text;
        text.precision(15); // as the user wrote it
        text << "the one at " << joint.place << ' ' << why;
        throw InputError("joints", text.str());
    };
    if (!joint.place.isFinite()) refuse("is not at a finite place");
    if (!box.isInside(joint.place)) refuse("is outside of the model's bounding box; it must be inside of a limb");
    if (joint.axis && !(joint.axis->isFinite() && joint.axis->lengthSqr() > 0)) refuse("has an axis without length");
}

} // namespace

Wishes::Wishes(const GuardModel& guard, const FaceWishOptions& options, Interrupter* interrupter)
    : density_(options.density), scale_(guard.scale()), symmetry_(guard.symmetry())
{
    constexpr double spread = 1.5;
    requireValidDensity(density_, interrupter);
    requireWithin(FaceWishOptions::jointDensities, options.jointDensity, "joint density");
    for (Joint joint : options.joints) {
        requireValid(joint, guard.box());
        throwIfInterrupted(interrupter);
        joint.place = guard.scaled(joint.place);
        if (joint.axis) joint.axis->normalize(0);
        if (symmetry_ && joint.place[symmetry_->axis] < symmetry_->offset) {
            joint.place = guard.mirrored(joint.place);
            if (joint.axis) (*joint.axis)[symmetry_->axis] *= -1;
        }
        limbs_.push_back(limbAt(guard.tree(), joint));
        if (options.jointDensity == 1) continue;
        const double inside = std::sqrt(guard.tree().closest(joint.place).squaredDistance) / scale_;
        aroundJoints_.push_back({FactorRegion::Shape::sphere, guard.unscaled(joint.place), Vec3d(0), spread * inside,
                                 options.jointDensity});
    }
}

double Wishes::density(const Vec3d& onModel) const
{
    constexpr double least = 1.0 / 8;
    const openvdb::FloatTree* const tree = density_.grid ? &density_.grid->constTree() : nullptr;
    const auto at = [&](const Vec3d& p) {
        const Vec3d world = p / scale_;
        const auto joint = std::find_if(aroundJoints_.begin(), aroundJoints_.end(),
                                        [&](const FactorRegion& region) { return contains(region, world); });
        return std::clamp((joint == aroundJoints_.end() ? 1 : joint->factor) * factorAt(density_, tree, world), least,
                          largestFactor);
    };
    const double here = at(onModel);
    if (!symmetry_) return here;
    const double there = at(mirrored(*symmetry_, onModel));
    return std::abs(std::log(there)) > std::abs(std::log(here)) ? there : here;
}

double Wishes::distanceWeight(const Vec3d& onModel) const
{
    if (!hasDensity()) return 1;
    const double d = density(onModel);
    return d * d * d;
}

double Wishes::quadricWeight(const Vec3d& onModel) const
{
    if (!hasDensity()) return 1;
    return std::pow(density(onModel), 5);
}

} // namespace vdbcage::detail
