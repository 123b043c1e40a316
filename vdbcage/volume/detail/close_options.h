#pragma once

#include <vdbcage/volume/morphology.h>

namespace vdbcage::detail {

/// \throw InputError a radius out of range; the erode radius above the close radius
void requireValid(const CloseOptions& options);

} // namespace vdbcage::detail
