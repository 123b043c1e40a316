#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include <vdbcage/core/export.h>
#include <vdbcage/core/interrupter.h>
#include <vdbcage/deform/binding.h>

namespace vdbcage {

/// For each of `poses` (positions of the cage's points) the triangles that it turns inside out. They are sorted indices
/// into triangulate(model). `binding` binds the points of `model`.
///
/// A triangle is inside out if the point just below its middle (by 1e-4 of the model's longest side) is posed above it.
/// So turning, moving and stretching invert nothing, and mirroring everything, by the families that reproduce it (not
/// those that follow normals: Green, biharmonic, Somigliana). Rounding decides on triangles that are posed flat. Those
/// thinner at rest than 1e-6 of the cage are left out. The same for any number of threads.
/// \throw InputError the binding's weights are given ones, which are not known at the two points; it has another number
/// of points than the model; a pose another than the cage; a model that is not usable; one of the two points is where
/// the family is not defined
/// \throw Cancelled
/// Cost: binding two points a triangle, whatever the number of poses, and posing them.
VDBCAGE_API std::vector<std::vector<std::uint32_t>>
invertedTriangles(const Binding& binding, const Mesh& model, const std::vector<std::vector<openvdb::Vec3d>>& poses,
                  Interrupter* interrupter = nullptr);

/// invertedTriangles() for one pose after the other: two points a triangle are bound once and kept. It keeps what it
/// needs of its arguments, and copies share it. Several threads may ask one at the same time.
class VDBCAGE_API InversionTest {
public:
    /// \throw InputError as invertedTriangles
    /// \throw Cancelled
    /// Cost: binding two points a triangle. Their weights take the memory of a Binding of as many points.
    InversionTest(const Binding& binding, const Mesh& model, Interrupter* interrupter = nullptr);

    /// This test with another material: nothing is bound anew. Of Somigliana coordinates; others stay as they are.
    /// \throw InputError it is out of range
    /// Cost: a copy of cage and points.
    InversionTest with(const Elasticity& elasticity) const;

    /// The triangles that the pose `cagePoints` turns inside out, as invertedTriangles gives them.
    /// \throw InputError not as many points as the cage has, or one not finite
    /// Cost: posing the model's points and two a triangle.
    std::vector<std::uint32_t> inverted(const std::vector<openvdb::Vec3d>& cagePoints) const;

private:
    struct Bound;
    std::shared_ptr<const Bound> bound_; // never changed
};

} // namespace vdbcage
