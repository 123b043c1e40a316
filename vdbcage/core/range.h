#pragma once

#include <string>

#include <vdbcage/core/export.h>

namespace vdbcage {

/// The numbers that an option may be, ends included.
struct Range {
    double least = 0; ///< the smallest that is allowed
    double most = 0;  ///< the largest that is allowed

    /// Returns whether `value` is allowed.
    /// \param value NaN is never allowed
    bool contains(double value) const { return value >= least && value <= most; }
};

/// Returns a range in words, such as "12 to 1000000".
/// \param range whole numbers are written in full
VDBCAGE_API std::string toText(const Range& range);

/// Checks that `range` contains `value`.
/// \param range the allowed numbers
/// \param value NaN is in no range
/// \param name the option or argument, for the message
/// \throw InputError "NAME: VALUE is not allowed; it must be LEAST to MOST", with `name` as subject, when it does not
VDBCAGE_API void requireWithin(const Range& range, double value, const std::string& name);

} // namespace vdbcage
