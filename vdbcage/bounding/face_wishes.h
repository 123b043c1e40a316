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

/// The places where the faces of a cage should go.
struct FaceWishOptions {
    static constexpr Range jointDensities{1, 8}; ///< of `jointDensity`

    /// Relative face density, cut to 1/8 to 8. With 2 a part of the model gets about twice as many faces, at the cost
    /// of the others. It counts at the nearest point of the model. With a plane of symmetry that side counts whose
    /// density is farther from 1.
    FactorField density = {};
    /// Places where the model is to bend: quadLoops() makes three rings across the limb there, as far as the guard
    /// allows.
    std::vector<Joint> joints = {};
    /// The density within 1.5 times the distance of a joint from the model's surface, in `jointDensities`. 1 is enough
    /// for quadLoops(): more would only add quads around the limb.
    double jointDensity = 2;
};

/// Wishes for where faces should go, for the operators under a guard. They weigh distance by them; the guard's
/// constraints come first.
///
/// Immutable; copies share their contents, and any number of threads may use one at the same time.
class VDBCAGE_API FaceWishes {
public:
    /// Makes no wish: all parts of the model count alike.
    FaceWishes();
    /// Measures the limbs at the joints.
    /// \param guard the one that the operators work under; it may go before the wishes
    /// \param options in the ranges of their members; joints within the model's bounding box
    /// \param interrupter asked whether to stop; may be null
    /// \throw InputError when options are out of range; when a joint is outside of the model's bounding box, or its
    /// axis has no length; when a density is not finite, or its transform is not linear
    /// \throw Cancelled when asked to stop
    /// Cost: O(values of the density + joints log n) for n faces of the model.
    explicit FaceWishes(const BoundingGuard& guard, const FaceWishOptions& options = {},
                        Interrupter* interrupter = nullptr);

private:
    friend const detail::Wishes& detail::wishesOf(const FaceWishes& wishes);

    std::shared_ptr<const detail::Wishes> wishes_; // never null
};

} // namespace vdbcage
