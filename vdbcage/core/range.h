#pragma once

#include <string>

#include <vdbcage/core/export.h>

namespace vdbcage {

/// The numbers that an option may be, ends included.
struct Range {
    double least = 0; ///< the smallest that is allowed
    double most = 0;  ///< the largest that is allowed

    /// Whether `value` is allowed; false for NaN.
    bool contains(double value) const { return value >= least && value <= most; }
};

/// A range in words, such as "12 to 1000000".
VDBCAGE_API std::string toText(const Range& range);

/// Checks that the range contains `value`; NaN never is.
/// \throw InputError "NAME: VALUE is not allowed; it must be LEAST to MOST", where NAME is `name`
VDBCAGE_API void requireWithin(const Range& range, double value, const std::string& name);

} // namespace vdbcage
