#pragma once

#include <cstddef>
#include <memory>
#include <vector>

#include <vdbcage/core/export.h>
#include <vdbcage/core/interrupter.h>
#include <vdbcage/deform/coordinates.h>
#include <vdbcage/mesh/mesh.h>

namespace vdbcage {

namespace detail {
class WeightBlocks;
}

/// Points bound to a cage: their coordinates in single precision, ready for posing.
///
/// Posed points are the points at rest plus the weighted motion of the handles, so the rest pose is exact. The weights
/// are held compressed; \ref deform tells how accurate that is.
class VDBCAGE_API Binding {
public:
    /// Computes the coordinates, as the stage "bind".
    /// \param cage closed and facing outward, as for computeCoordinates()
    /// \param points at rest, world units, finite; where the family is defined, or loose
    /// \param options the family with its settings
    /// \param interrupter told of the stage; may be null
    /// \throw InputError as computeCoordinates(); when the elasticity is out of range
    /// \throw Cancelled when asked to stop
    Binding(const Mesh& cage, std::vector<openvdb::Vec3d> points, const CoordinateOptions& options,
            Interrupter* interrupter = nullptr);
    /// Takes weights of computeWeights(), or given ones. The binding is the same as if they were computed here.
    /// \param cage the one that the weights were made for; of given weights it may be open
    /// \param points at rest, those that the weights were made for, world units, finite
    /// \param options the family with its settings; `given` for weights that were made elsewhere
    /// \param weights points x handles, row after row; of given weights each row has the sum 1 within 1e-3
    /// \throw InputError when their number is not points times handles; when the cage is not usable; when a point is
    /// not finite; when the elasticity is out of range; when a given weight is not finite, or a row's sum is another,
    /// so that moving the cage would not move the points along
    Binding(const Mesh& cage, std::vector<openvdb::Vec3d> points, const CoordinateOptions& options,
            const std::vector<float>& weights);

    /// Returns the cage at rest, as it was given.
    const Mesh& cage() const { return cage_; }
    /// Returns the points at rest, as they were given.
    const std::vector<openvdb::Vec3d>& points() const { return points_; }
    /// Returns the settings that the weights were computed with, and the material that pose() uses.
    const CoordinateOptions& options() const { return options_; }
    /// Returns the family of `options()`; `given` for weights that were made elsewhere.
    Coordinates family() const { return options_.family; }
    /// Returns the number of handles, which is the number of weights a point.
    std::size_t handles() const { return restHandles_.size(); }
    /// Returns this binding with another material; no weights are computed. A binding of other than Somigliana
    /// coordinates stays as it is.
    /// \param elasticity in the ranges of its members
    /// \throw InputError when it is out of range
    /// Cost: a copy of cage and points.
    Binding with(const Elasticity& elasticity) const;
    /// Returns the bytes that the weights take: 4 a point and handle, or less where points are close together for their
    /// distance from faces. It is a third of that where there are hundreds of points a face.
    std::size_t weightBytes() const;

    /// Returns the points posed by the cage. They are the same for any number of threads.
    /// \param cagePoints where the cage's points are in the pose: as many, in the same order, finite
    /// \throw InputError when there are not as many as the cage has, or one is not finite
    /// Cost: reading, once, the combinations and the held weights of the handles that moved.
    std::vector<openvdb::Vec3d> pose(const std::vector<openvdb::Vec3d>& cagePoints) const;

    /// Moves posed points to another pose of the cage. Each update rounds to about 1e-7 of the motion.
    /// \param posed the points as the cage `from` posed them; becomes the points as the cage `to` poses them
    /// \param from as the argument of pose()
    /// \param to as the argument of pose()
    /// \throw InputError as pose(); when `posed` has another number of points
    /// Cost: as pose(), for the handles that moved between the two.
    void update(std::vector<openvdb::Vec3d>& posed, const std::vector<openvdb::Vec3d>& from,
                const std::vector<openvdb::Vec3d>& to) const;

private:
    void add(const std::vector<openvdb::Vec3d>& fromHandles, const std::vector<openvdb::Vec3d>& toHandles,
             std::vector<openvdb::Vec3d>& posed) const;

    Mesh cage_;
    std::vector<openvdb::Vec3d> points_;
    CoordinateOptions options_;
    std::vector<openvdb::Vec3d> restHandles_;
    std::shared_ptr<const detail::WeightBlocks> weights_; // never changed, so copies share it
};

} // namespace vdbcage
