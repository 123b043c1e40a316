#pragma once

#include <memory>
#include <vector>

#include <vdbcage/bounding/bounding_guard.h>
#include <vdbcage/bounding/joints.h>
#include <vdbcage/core/export.h>
#include <vdbcage/core/interrupter.h>
#include <vdbcage/core/range.h>
#include <vdbcage/volume/factor_field.h>

namespace vdbcage {

class FaceWishes;

namespace detail {
class Wishes;
const Wishes& wishesOf(const FaceWishes& wishes);
} // namespace detail

/// Says where the faces of a cage should go.
struct FaceWishOptions {
    static constexpr Range jointDensities{1, 8}; ///< of `jointDensity`

    /// Relative face density: 2 means about twice as many faces at this part of the model, at the cost of the others.
    /// It counts at the nearest point of the model, at least 1/8. With a plane of symmetry that side counts which is
    /// farther from 1.
    FactorField density = {};
    /// Where the model is to bend: quadLoops() makes three rings across the limb there, as far as the guard allows.
    std::vector<Joint> joints = {};
    /// The density within 1.5 times the distance of a joint from the model's surface. quadLoops() needs none: all it
    /// would add are quads around the limb.
    double jointDensity = 2;
};

/// Tells the operators under a guard where faces should go. They weigh distance by it; the guard's constraints come
/// first.
///
/// Immutable; copies share their contents, and any number of threads may use one at the same time.
class VDBCAGE_API FaceWishes {
public:
    /// Wishes for nothing: all parts of the model count alike.
    FaceWishes();
    /// Measures the limbs at the joints. For operators under this guard, which may go before.
    /// \throw InputError options out of range; a joint outside of the model's bounding box, or with an axis without
    /// length; a density that is not finite or whose transform is not linear
    /// \throw Cancelled
    /// Cost: O(values of the density + joints log n) for n faces of the model.
    explicit FaceWishes(const BoundingGuard& guard, const FaceWishOptions& options = {},
                        Interrupter* interrupter = nullptr);

private:
    friend const detail::Wishes& detail::wishesOf(const FaceWishes& wishes);

    std::shared_ptr<const detail::Wishes> wishes_; // never null
};

} // namespace vdbcage
