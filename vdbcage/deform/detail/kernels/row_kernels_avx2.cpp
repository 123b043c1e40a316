#define VDBCAGE_KERNELS avx2Kernels
#define VDBCAGE_INSTRUCTIONS "AVX2"
#include <vdbcage/deform/detail/kernels/row_kernels_of_set.h>
