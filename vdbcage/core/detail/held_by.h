#pragma once

#include <variant>

#include <boost/variant/get.hpp>
#include <boost/variant/variant.hpp>

namespace vdbcage::detail {

/// What a variant holds if it is a T, or null: Boost's, of which CGAL 5 makes intersections, or the standard one, which
/// CGAL 6 takes.
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
