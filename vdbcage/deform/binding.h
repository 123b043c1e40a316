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

/// Points bound to a cage: their coordinates in single precision, ready for posing. Posed points are the points at rest
/// plus what the handles moved by, so the rest pose is exact.
///
/// Of points that are close together only some have their weights held; the others' are combinations of these. For that
/// a posed point is off by at most 1e-6 of the cage's size, times the sum of its weights' absolute values. A normal's
/// weight counts times the square of its edges' mean length, one of the six of a triangle four times. This holds where
/// no point of the cage moves farther than its size and no edge gets more than twice as long. Rounding to floats adds
/// about 1e-7 of the motion. For Somigliana coordinates it holds for `Elasticity()`, and where no triangle gets more
/// than twice as wide; it grows as 1 / (1 - 2 nu), and with the bulging.
class VDBCAGE_API Binding {
public:
    /// Computes the coordinates, as the stage "bind".
    /// \throw InputError as computeCoordinates; an elasticity out of range
    /// \throw Cancelled
    Binding(const Mesh& cage, std::vector<openvdb::Vec3d> points, const CoordinateOptions& options,
            Interrupter* interrupter = nullptr);
    /// Takes coordinates computed before by computeWeights, or given ones. The same as computing them here.
    /// \throw InputError their number is not points times handles; a point not finite; of given weights one is not
    /// finite, or a row's sum is not 1 within 1e-3, so that moving the cage would not move the points along
    Binding(const Mesh& cage, std::vector<openvdb::Vec3d> points, const CoordinateOptions& options,
            const std::vector<float>& weights);

    /// The cage at rest, as it was given.
    const Mesh& cage() const { return cage_; }
    /// The points at rest, as they were given.
    const std::vector<openvdb::Vec3d>& points() const { return points_; }
    /// What the weights were computed with, and the material that pose() uses.
    const CoordinateOptions& options() const { return options_; }
    /// The family of `options()`; `given` for weights that were made elsewhere.
    Coordinates family() const { return options_.family; }
    /// The number of handles, which is the number of weights a point.
    std::size_t handles() const { return restHandles_.size(); }
    /// This binding with another material: no weights are computed. Of Somigliana coordinates; others stay as they are.
    /// \throw InputError it is out of range
    /// Cost: a copy of cage and points.
    Binding with(const Elasticity& elasticity) const;
    /// The memory that the weights take: 4 bytes a point and handle, or less where points are close together for their
    /// distance from faces. A third where there are hundreds of points a face.
    std::size_t weightBytes() const;

    /// Where the points are when the cage's points are at `cagePoints`. The same for any number of threads.
    /// \throw InputError not as many points as the cage has, or one not finite
    /// Cost: reading, once, the combinations and the held weights of the handles that moved.
    std::vector<openvdb::Vec3d> pose(const std::vector<openvdb::Vec3d>& cagePoints) const;

    /// Moves `posed`, which was posed by the cage `from`, to the pose of the cage `to`. Each update rounds to about
    /// 1e-7 of the motion.
    /// \throw InputError as pose(); `posed` has another number of points
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
