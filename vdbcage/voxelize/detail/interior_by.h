#pragma once

#include <vdbcage/voxelize/interior.h>

namespace vdbcage::detail {

/// Returns the interior that Interior::automatic takes for a model of this rayAgreement().
inline Interior interiorBy(double agreement)
{
    return agreement < leastAgreement ? Interior::shell : Interior::solid;
}

} // namespace vdbcage::detail
