#define VDBCAGE_KERNELS baselineKernels
#define VDBCAGE_INSTRUCTIONS "baseline"
#include <vdbcage/deform/detail/kernels/row_kernels_of_set.h>
