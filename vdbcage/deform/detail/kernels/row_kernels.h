#pragma once

#include <cstddef>

#include <vdbcage/deform/detail/kernels/kernel_cage.h>

namespace vdbcage::detail {

enum class Simd; // core/detail/simd.h

/// Points whose rows are computed together.
constexpr int packetSize = 8;
constexpr std::size_t floatLanes = 16;
/// Points at less than this from the cage, about, are for the scalar formulas.
constexpr double tooNear = 1e-7;
/// And those that are farther than this from the origin, whose squares might overflow.
constexpr double tooFar = 1e3;

/// What is computed in vectors of an instruction set.
struct RowKernels {
    const char* instructions; ///< "AVX-512", "AVX2" or "baseline"

    /// Computes the rows of `packetSize` points, by `x[axis]`. Number k of the row of point i is rows[k][i].
    ///
    /// Returns a bit for each point whose row is left out: it is too near the cage for this, or outside of it. A row
    /// depends on its own point only.
    /// \pre `scratch` has scratchSize(cage); no point is farther than `tooFar` from the origin
    using Rows = unsigned(const KernelCage& cage, const double (*x)[packetSize], void* scratch,
                          double (*rows)[packetSize]);
    Rows* meanValue;
    Rows* green;
    Rows* likelihood;
    Rows* somigliana; ///< of a cage that has triangles only

    /// Takes the projections on `pivot` off rows of `columns` numbers each, a multiple of `floatLanes`.
    ///
    /// A row's factor is its product with the pivot, times `inverseSquare`. Its size is the sum of the absolute values
    /// that are left. Sums are made in `floatLanes` parts, which are added up in order.
    using Project = void(float* const* rows, std::size_t count, const float* pivot, float inverseSquare,
                         std::size_t columns, float* factors, float* sizes);
    Project* project;
};

/// In bytes, for any table; aligned to 64.
std::size_t scratchSize(const KernelCage& cage);

/// Those for the best instruction set that this processor has.
const RowKernels& rowKernels();

/// Those for an instruction set that this processor has. All have the same bits.
const RowKernels& rowKernels(Simd set);

/// What the kernels leave to the scalar formulas: the weights of the corners of face `face`. Returns false if `x` is
/// too near for them.
bool exactMeanValue(const UnitCage& cage, std::size_t face, const double (&x)[3], double (&weights)[4]);
/// Of a triangle.
bool exactGreen(const UnitCage& cage, std::size_t face, const double (&x)[3], double (&positions)[3], double& normal);
/// Of a triangle.
bool exactSomigliana(const UnitCage& cage, std::size_t face, const double (&x)[3], double (&positions)[3],
                     double (&matrix)[6]);

} // namespace vdbcage::detail
