#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include <openvdb/Types.h>

namespace vdbcage::detail {

/// Returns a text such as "(1, 2, 3)".
std::string toText(const openvdb::Vec3d& point);

/// \throw InputError naming the first of `points` that is not finite, after `what`
void requireFinite(const std::vector<openvdb::Vec3d>& points, const char* what);

/// \throw InputError `what` has `count` points, and `of` has `needed`
void requireCount(const char* what, std::size_t count, std::size_t needed, const char* of);

} // namespace vdbcage::detail
