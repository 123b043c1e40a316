#pragma once

#include <string>

#include <vdbcage/core/export.h>

namespace vdbcage {

/// The numbers that an option may be, ends included.
struct Range {
    double least = 0, most = 0;

    /// Not for NaN.
    bool contains(double value) const { return value >= least && value <= most; }
};

/// "12 to 1000000"
VDBCAGE_API std::string toText(const Range& range);

/// \throw InputError "NAME: VALUE is not allowed; it must be LEAST to MOST", unless the range contains `value`
VDBCAGE_API void requireWithin(const Range& range, double value, const std::string& name);

} // namespace vdbcage
