#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include <openvdb/Types.h>
#include <vdbcage/core/interrupter.h>
#include <vdbcage/deform/detail/unit_cage.h>

namespace vdbcage::detail {

/// The harmonic coordinates of a cage. The coordinate of a cage point is the solution of Laplace's equation inside the
/// cage whose boundary values are the point's hat function: barycentric on triangles, bilinear on quads.
///
/// They are solved for on a grid. Where an edge of the grid leaves the cage, the boundary value is that at the
/// crossing. Parts of the cage that are thinner than a voxel thus have coordinates too, although coarse ones.
///
/// Between nodes a value is interpolated linearly along each axis: from voxel side to voxel side, or to the cage where
/// that is nearer. The mean of the axes weights each by one over the product of its two distances. On voxel sides and
/// edges their own axes are averaged in the same way. In voxels that the cage does not meet this is trilinear
/// interpolation.
///
/// Errors, of a grid whose voxels are `h` wide: rows are not negative and sum up to 1, and reproduce points to 1e-10
/// of the cage's longest side (1e-8 next to faces without area; mostly 1e-14). Coordinates are off by O(h^2), but by
/// O(h) within a voxel of the cage's edges, where the boundary values have kinks. They are continuous up to the cage,
/// except for jumps of that size where a line along an axis grazes the cage.
class HarmonicGrid {
public:
    /// `resolution` is in voxels along the cage's longest side. `cage` must outlive the grid.
    ///
    /// Memory: 8 bytes for each node inside and each point of the cage, and 4 for each node of the cage's box.
    /// Cost: O(resolution) or less for each node inside and each point of the cage, in parallel.
    /// \throw InputError resolution not in CoordinateOptions::resolutions
    /// \throw Cancelled
    HarmonicGrid(const UnitCage& cage, int resolution, Interrupter* interrupter = nullptr);

    /// Writes the coordinates of the scaled point `x` to `row`, one for each point of the cage. Returns false if `x` is
    /// outside of the cage. Any number of threads may call this at the same time.
    /// Cost: O(points of the cage); near the cage also O(faces).
    bool row(const openvdb::Vec3d& x, double* row) const;

private:
    struct Face {
        PatchCorners corners; ///< in voxels
        bool quad;
    };
    struct CellFace {
        std::uint32_t cell, face;
        bool operator<(const CellFace& other) const
        {
            return cell != other.cell ? cell < other.cell : face < other.face;
        }
    };
    struct CellFaces {
        const CellFace *first, *last;
        const CellFace* begin() const { return first; }
        const CellFace* end() const { return last; }
        bool empty() const { return first == last; }
    };
    /// The place where a line along an axis meets the cage.
    struct Crossing {
        double distance; ///< in voxels
        std::uint32_t face;
        std::array<double, 4> weights; ///< of the face's corners
    };
    /// The terms of the mean that a row is.
    struct Mean {
        std::array<double, 8> nodes{}; ///< weights of a cell's corners: bits 0 to 2 are x to z
        double* row;                   ///< of the cage's points
    };
    static constexpr std::uint32_t none = ~std::uint32_t(0);

    openvdb::Vec3d inVoxels(const openvdb::Vec3d& x) const { return x * scale_ + shift_; }
    /// Returns the number of a node, and of the cell whose lowest corner it is.
    std::uint32_t numberOf(const openvdb::Coord& node) const;
    CellFaces facesOf(const openvdb::Coord& cell) const;
    void sortFacesIntoCells();
    bool isInside(const openvdb::Vec3d& at) const;
    /// Numbers the nodes inside. Returns the nodes.
    std::vector<openvdb::Coord> findNodesInside(Interrupter* interrupter);
    void solve(const std::vector<openvdb::Coord>& nodes, Interrupter* interrupter);

    /// Returns the first crossing with `faces` from `at` along the axis, at most `reach` away. If there is none, its
    /// distance is `reach` and its face `none`.
    Crossing firstCrossing(const CellFaces& faces, const openvdb::Vec3d& at, int axis, bool upward, double reach) const;
    /// Returns the place for a node outside that is reached without a crossing: except for rounding it is on the cage.
    UnitCage::Place nearestTo(const openvdb::Coord& node) const;
    void addPlace(std::size_t face, const std::array<double, 4>& weights, double share, double* row) const;
    /// Adds `share` times the value at `at` to `mean`. `at` is in the cell's side, edge or corner whose axes of the
    /// mask `fixed` are low or high, by the bits of `high`.
    void addMean(const openvdb::Coord& cell, const CellFaces& faces, const openvdb::Vec3d& at, unsigned fixed,
                 unsigned high, double share, Mean& mean) const;

    const UnitCage& cage_;
    double scale_;         ///< voxels per unit
    openvdb::Vec3d shift_; ///< of the origin, in voxels
    openvdb::Coord size_;  ///< nodes along each axis
    std::vector<Face> faces_;
    std::vector<CellFace> cellFaces_;    ///< sorted
    std::vector<std::uint32_t> numbers_; ///< by node: its number among those inside, or `none`
    std::vector<double> values_;         ///< by node inside: a row
};

} // namespace vdbcage::detail
