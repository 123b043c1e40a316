#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include <openvdb/Types.h>
#include <vdbcage/core/interrupter.h>
#include <vdbcage/deform/detail/coordinate_family.h>

namespace vdbcage::detail {

/// The factors of a triangle's data in a biharmonic function f at the origin. Data of normals are derivatives along the
/// normal times twice the triangle's area. Factors by corner are for data that are linear in between.
struct BiharmonicPart {
    std::array<double, 3> values{};     ///< of f: the integral of r.n / (4 pi |r|^3)
    double slope = 0;                   ///< of f's normal derivative: of 1 / (4 pi |r|), over twice the area
    std::array<double, 3> laplacians{}; ///< of f's Laplacian: of -r.n / (8 pi |r|)
    double laplacianSlope = 0;          ///< of its Laplacian's normal derivative: of |r| / (8 pi), over twice the area
};

/// Computes the factors of one triangle. `corners` are counter-clockwise from outside, in units of the cage's longest
/// side. `onFace`: the origin lies on the triangle, whose solid angle is then left out.
///
/// Errors are below 1e-11 for triangles about as large as their distance, and grow as rounding over their area. Those
/// narrower than `sliverWidth` are integrated to about 1e-9.
BiharmonicPart biharmonicPart(const std::array<openvdb::Vec3d, 3>& corners, bool onFace);

/// The biharmonic coordinates of a cage of triangles: Thiery, Michel, Chen 2024.
///
/// Four data on the cage determine a biharmonic function inside: its values, its normal derivatives, and both of its
/// Laplacian. Values are linear on triangles, derivatives constant. From given values and derivatives the two others
/// follow by least squares, solved once for each cage. Affine functions are reproduced exactly: their Laplacian is
/// zero.
class BiharmonicCage {
public:
    static constexpr std::size_t mostData = 6000; ///< points and faces together

    /// `cage` must outlive this. \pre all of its faces are triangles
    ///
    /// Memory: 8 n^2 bytes for n points and faces together, and four times as much during the construction.
    /// Cost: O(n^3), in parallel: 0.2 s of a processor core for n = 600, 80 s for n = 5700.
    /// \throw InputError n is more than `mostData`
    /// \throw Cancelled
    explicit BiharmonicCage(const UnitCage& cage, Interrupter* interrupter = nullptr);

    /// Returns the number of weights a point: one for each point of the cage, then one for each face. A face's weight
    /// multiplies its normal, whose length is twice the area times the stretch.
    std::size_t columns() const { return cage_.points().size() + cage_.faces().size(); }

    /// Computes the rows of `count` scaled points, at most `packetSize`. Number k of the row of point i is rows[k][i].
    ///
    /// Returns a bit for each point that has no row because it is outside of the cage. A row depends on its own point
    /// only. Any number of threads may call this at the same time.
    /// Cost: O(n^2), nearly the same for one point as for `packetSize`.
    unsigned rows(const openvdb::Vec3d* points, std::size_t count, Packet* rows) const;

private:
    const UnitCage& cage_;
    std::vector<openvdb::Vec3d> normals_; ///< twice as long as the faces' areas
    /// The matrix from values and derivatives to the Laplacian's: pairs of columns, each row after row.
    std::vector<double> solution_;
};

} // namespace vdbcage::detail
