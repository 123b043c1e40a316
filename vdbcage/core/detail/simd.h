#pragma once

#include <vector>

/// The instruction sets that kernels are compiled for; one of them is chosen at run time.
///
/// Kernels use GNU vector types, which work on any machine. Those of volume are inline templates over the width of the
/// vectors, instantiated by a few functions with the attributes below. Those of deform are one source, compiled once
/// for each set.
namespace vdbcage::detail {

enum class Simd {
    plain, ///< the set of every machine of the architecture
    avx2,
    avx512 ///< F, BW, DQ and VL, as x86-64-v4
};

/// Returns the sets that this build and machine have, plain first, best last.
const std::vector<Simd>& supportedSimd();
inline Simd bestSimd()
{
    return supportedSimd().back();
}

#if defined(__x86_64__)
#define VDBCAGE_WITH_AVX 1
#define VDBCAGE_TARGET_AVX2 __attribute__((target("avx2,bmi,bmi2")))
#define VDBCAGE_TARGET_AVX512 __attribute__((target("avx512f,avx512bw,avx512dq,avx512vl,avx2,bmi,bmi2")))
#else
#define VDBCAGE_WITH_AVX 0
#endif
/// Forces a function to be inlined, so that it has the target of the kernel that calls it.
#define VDBCAGE_INLINE inline __attribute__((always_inline))

} // namespace vdbcage::detail
