#define VDBCAGE_KERNELS avx512Kernels
#define VDBCAGE_INSTRUCTIONS "AVX-512"
#include <vdbcage/deform/detail/kernels/row_kernels_of_set.h>
