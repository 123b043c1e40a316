#include <vdbcage/deform/detail/kernels/row_kernels.h>

#include <array>

namespace vdbcage::detail {

extern const RowKernels baselineKernels;
#if defined(__x86_64__)
extern const RowKernels avx2Kernels, avx512Kernels;
#endif

std::size_t scratchSize(const KernelCage& cage)
{
    const std::size_t vectors = 4 * cage.pointCount + 5 * cage.edgeCount + 7 * (cage.triangleCount + cage.quadCount);
    return vectors * packetSize * sizeof(double);
}

const RowKernels* const* allRowKernels()
{
    static const std::array<const RowKernels*, 4> all = [] {
        std::array<const RowKernels*, 4> list{};
        std::size_t count = 0;
#if defined(__x86_64__)
        if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") &&
            __builtin_cpu_supports("avx512vl")) {
            list[count++] = &avx512Kernels;
        }
        if (__builtin_cpu_supports("avx2")) list[count++] = &avx2Kernels;
#endif
        list[count] = &baselineKernels;
        return list;
    }();
    return all.data();
}

const RowKernels& rowKernels()
{
    return **allRowKernels();
}

} // namespace vdbcage::detail
