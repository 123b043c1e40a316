#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include <vdbcage/core/export.h>
#include <vdbcage/core/interrupter.h>
#include <vdbcage/deform/binding.h>

namespace vdbcage {

/// Finds the triangles that each pose turns inside out; \ref deform tells which these are.
/// \param binding of the points of `model`; not of given weights, which are not known at other points
/// \param model at rest, as for requireUsable()
/// \param poses positions of the cage's points, each as the argument of Binding::pose()
/// \param interrupter told of the stage "bind", more than once for large models; may be null
/// \return for each pose the sorted indices of the triangles in triangulate(model); equal for any number of threads
/// \throw InputError when the weights are given ones; when the binding has another number of points than the model, or
/// a pose another than the cage; when the model is not usable; when the family is not defined at a triangle's middle or
/// at the point below
/// \throw Cancelled when asked to stop
/// Cost: binding two points a triangle, whatever the number of poses, and posing them.
VDBCAGE_API std::vector<std::vector<std::uint32_t>>
invertedTriangles(const Binding& binding, const Mesh& model, const std::vector<std::vector<openvdb::Vec3d>>& poses,
                  Interrupter* interrupter = nullptr);

/// A test like invertedTriangles() for one pose after the other: two points a triangle are bound once and kept. It
/// keeps all that it needs of its arguments, and copies share it. Several threads may ask one at the same time.
class VDBCAGE_API InversionTest {
public:
    /// Binds two points a triangle.
    /// \param binding as for invertedTriangles()
    /// \param model as for invertedTriangles()
    /// \param interrupter as for invertedTriangles()
    /// \throw InputError as invertedTriangles()
    /// \throw Cancelled when asked to stop
    /// Cost: binding two points a triangle. Their weights take the memory of a Binding of as many points.
    InversionTest(const Binding& binding, const Mesh& model, Interrupter* interrupter = nullptr);

    /// Returns this test with another material; nothing is bound again. A test of other than Somigliana coordinates
    /// stays as it is.
    /// \param elasticity in the ranges of its members
    /// \throw InputError when it is out of range
    /// Cost: a copy of cage and points.
    InversionTest with(const Elasticity& elasticity) const;

    /// Finds the triangles that a pose turns inside out.
    /// \param cagePoints as the argument of Binding::pose()
    /// \return their sorted indices in triangulate(model), as invertedTriangles() returns them
    /// \throw InputError when there are not as many points as the cage has, or one is not finite
    /// Cost: posing the model's points and two a triangle.
    std::vector<std::uint32_t> inverted(const std::vector<openvdb::Vec3d>& cagePoints) const;

private:
    struct Bound;
    std::shared_ptr<const Bound> bound_; // never changed
};

} // namespace vdbcage
