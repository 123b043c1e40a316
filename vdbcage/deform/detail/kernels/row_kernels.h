#pragma once

#include <cstddef>

#include <vdbcage/deform/detail/kernels/kernel_cage.h>

namespace vdbcage::detail {

enum class Simd; // core/detail/simd.h

/// The number of points whose rows are computed together.
constexpr int packetSize = 8;
constexpr std::size_t floatLanes = 16;
/// The scalar formulas compute points at less than about this distance from the cage.
constexpr double tooNear = 1e-7;
/// They also compute points farther than this from the origin, whose squares might overflow.
constexpr double tooFar = 1e3;

/// The computations in vectors of one instruction set.
struct RowKernels {
    const char* instructions; ///< "AVX-512", "AVX2" or "baseline"

    /// Computes the rows of the `packetSize` points x[axis][i]. Number k of the row of point i is rows[k][i].
    ///
    /// Returns a bit for each point whose row is left out because it is too near the cage, or outside of it. A row
    /// depends on its own point only.
    /// \pre `scratch` has scratchSize(cage); no point is farther than `tooFar` from the origin
    using Rows = unsigned(const KernelCage& cage, const double (*x)[packetSize], void* scratch,
                          double (*rows)[packetSize]);
    Rows* meanValue;
    Rows* green;
    Rows* likelihood;
    Rows* somigliana; ///< of a cage that has triangles only

    /// Subtracts the projections on `pivot` from rows of `columns` numbers each, a multiple of `floatLanes`.
    ///
    /// A row's factor is its dot product with the pivot, times `inverseSquare`. Its size is the sum of the remaining
    /// absolute values. Sums have `floatLanes` parts, added up in order.
    using Project = void(float* const* rows, std::size_t count, const float* pivot, float inverseSquare,
                         std::size_t columns, float* factors, float* sizes);
    Project* project;
};

/// Returns the size in bytes of the scratch memory of any kernel; its alignment is 64.
std::size_t scratchSize(const KernelCage& cage);

/// Returns the kernels for the best instruction set that this processor has.
const RowKernels& rowKernels();

/// Returns the kernels for an instruction set that this processor has. The results of all sets are equal to the bit.
const RowKernels& rowKernels(Simd set);

/// Computes the weights of the corners of face `face` by the scalar formulas, for points that the kernels leave to
/// them. Returns false if `x` is too near.
bool exactMeanValue(const UnitCage& cage, std::size_t face, const double (&x)[3], double (&weights)[4]);
/// Does the same for a triangle.
bool exactGreen(const UnitCage& cage, std::size_t face, const double (&x)[3], double (&positions)[3], double& normal);
/// Does the same for a triangle.
bool exactSomigliana(const UnitCage& cage, std::size_t face, const double (&x)[3], double (&positions)[3],
                     double (&matrix)[6]);

} // namespace vdbcage::detail
