#pragma once

#include <cstddef>
#include <string>

#include <vdbcage/bounding/detail/guarded_mesh.h>
#include <vdbcage/bounding/tighten.h>

/// What several operators under the guard have in common.
namespace vdbcage::detail {

/// \throw InputError unless `value` is `least` to 100
void requireCount(const std::string& name, int value, int least = 0);
/// \throw InputError fewer than 4
void requireFaces(std::size_t faces);
/// \throw InputError
void requireValid(const TightenOptions& options);

/// What tighten() does. \throw Cancelled
void tightenAndPerturb(GuardedMesh& surface, const TightenOptions& options, Interrupter* interrupter);

} // namespace vdbcage::detail
