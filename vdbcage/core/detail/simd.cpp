#include <vdbcage/core/detail/simd.h>

namespace vdbcage::detail {

const std::vector<Simd>& supportedSimd()
{
    static const std::vector<Simd> supported = [] {
        std::vector<Simd> list{Simd::plain};
#if VDBCAGE_WITH_AVX
        const bool hasBits = __builtin_cpu_supports("bmi") && __builtin_cpu_supports("bmi2");
        if (hasBits && __builtin_cpu_supports("avx2")) {
            list.push_back(Simd::avx2);
            if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512bw") &&
                __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512vl")) {
                list.push_back(Simd::avx512);
            }
        }
#endif
        return list;
    }();
    return supported;
}

} // namespace vdbcage::detail
