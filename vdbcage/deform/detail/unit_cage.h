#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <vector>

#include <vdbcage/mesh/mesh.h>

namespace vdbcage::detail {

/// Corners of a face seen from a point, counter-clockwise from outside.
///
/// A triangle repeats its last corner, which makes a bilinear patch with the same surface. Its barycentric coordinates
/// are the patch's with the last two added.
using PatchCorners = std::array<openvdb::Vec3d, 4>;

struct KernelCage;

/// A cage as the scalar formulas read it, moved and scaled into the unit cube around the origin.
class UnitCage {
public:
    static constexpr double touching = 1e-12; ///< points closer to the cage count as on it

    struct Face {
        std::array<openvdb::Index32, 4> at; ///< a triangle repeats its last corner
        bool quad;
    };
    /// A point of the cage as a mean of a face's corners.
    struct Place {
        std::size_t face = 0;
        std::array<double, 4> weights{};
        double distance = 0; ///< to the point for which it was sought
    };

    /// \throw InputError the cage is not closed; it faces inward; it is flat
    explicit UnitCage(const Mesh& cage);

    const std::vector<openvdb::Vec3d>& points() const { return points_; }
    const std::vector<Face>& faces() const { return faces_; } ///< triangles first

    openvdb::Vec3d scaled(const openvdb::Vec3d& point) const { return (point - centre_) / size_; }

    PatchCorners cornersFrom(const Face& face, const openvdb::Vec3d& x) const;

    /// Returns the place nearest to `x`.
    /// Cost: O(faces).
    Place nearest(const openvdb::Vec3d& x) const;
    /// Returns the place of face `face` nearest to `x`.
    Place nearestOf(std::size_t face, const openvdb::Vec3d& x) const;

    /// Completes weights of `x` that are solid angles over 4 pi: around a point inside they sum up to 1.
    ///
    /// The difference goes to `nearest`, the place nearest to `x`. Then the weights are restored; `missing` is `x`
    /// minus the part of other handles than the points. Returns false, and changes nothing, if `x` is outside.
    bool completeSolidAngles(const Place& nearest, openvdb::Vec3d missing, double* weights) const;

    /// Changes the points' weights so that the sum of the points times their weights grows by `missing`.
    ///
    /// The sum of the weights stays. The change has the least sum of squares. Afterwards weights that were rounded or
    /// integrated reproduce affine maps.
    void restore(const openvdb::Vec3d& missing, double* weights) const;
    /// Returns by point the change of its weight for each missing unit.
    const std::vector<openvdb::Vec3d>& restoring() const { return restoring_; }

private:
    openvdb::Vec3d centre_{0};
    double size_ = 1;
    std::vector<openvdb::Vec3d> points_;
    std::vector<Face> faces_;
    std::vector<openvdb::Vec3d> restoring_;
};

/// Returns `cage` as plain data for the kernels. It must outlive the result.
std::shared_ptr<const KernelCage> kernelCage(const UnitCage& cage);

} // namespace vdbcage::detail
