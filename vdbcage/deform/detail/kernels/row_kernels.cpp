#include <vdbcage/deform/detail/kernels/row_kernels.h>

#include <vdbcage/core/detail/simd.h>

namespace vdbcage::detail {

extern const RowKernels baselineKernels;
#if VDBCAGE_WITH_AVX
extern const RowKernels avx2Kernels, avx512Kernels;
#endif

std::size_t scratchSize(const KernelCage& cage)
{
    const std::size_t vectors = 4 * cage.pointCount + 5 * cage.edgeCount + 7 * (cage.triangleCount + cage.quadCount);
    return vectors * packetSize * sizeof(double);
}

const RowKernels& rowKernels(Simd set)
{
#if VDBCAGE_WITH_AVX
    if (set == Simd::avx512) return avx512Kernels;
    if (set == Simd::avx2) return avx2Kernels;
#endif
    (void)set; // other processors have one
    return baselineKernels;
}

const RowKernels& rowKernels()
{
    return rowKernels(bestSimd());
}

} // namespace vdbcage::detail
