#pragma once

#include <variant>

#include <boost/variant/get.hpp>
#include <boost/variant/variant.hpp>

namespace vdbcage::detail {

/// Returns the T that a variant holds, or null. The variant is Boost's, as CGAL 5 returns intersections, or the
/// standard one, as CGAL 6 does.
template <typename T, typename... Types>
const T* heldBy(const boost::variant<Types...>& variant)
{
    return boost::get<T>(&variant);
}
template <typename T, typename... Types>
const T* heldBy(const std::variant<Types...>& variant)
{
    return std::get_if<T>(&variant);
}

} // namespace vdbcage::detail
