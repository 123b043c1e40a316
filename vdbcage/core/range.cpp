#include <vdbcage/core/range.h>

#include <cmath>

#include <vdbcage/core/detail/number_text.h>
#include <vdbcage/core/error.h>

namespace vdbcage {

namespace {

/// Returns a number as text, whole ones in full: 1000000, not 1e+06.
std::string textOf(double value)
{
    constexpr double largest = 1e15; // all whole numbers up to here are doubles
    return value == std::floor(value) && std::abs(value) < largest ? std::to_string(static_cast<long long>(value))
                                                                   : detail::numberText(value);
}

} // namespace

std::string toText(const Range& range)
{
    return textOf(range.least) + " to " + textOf(range.most);
}

void requireWithin(const Range& range, double value, const std::string& name)
{
    if (range.contains(value)) return;
    throw InputError(name, textOf(value) + " is not allowed; it must be " + toText(range));
}

} // namespace vdbcage
