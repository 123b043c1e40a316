#pragma once

#include <string>
#include <string_view>
#include <vector>

#include <vdbcage/core/detail/grids.h>
#include <vdbcage/volume/detail/vdb/byte_cursor.h>

namespace vdbcage::detail {

/// The types of grids that a caller wants.
enum class VdbValues { scalars /* float, double, bool and mask */, floats };

/// Reads one grid of a .vdb file: the first named `wanted`, or else the only one.
///
/// OpenVDB's own reader trusts the lengths and counts in a file. Here each is compared with the bytes that are left
/// before memory is taken for it, so for any bytes nothing is read or written outside of buffers.
///
/// Grids of other types are skipped by the file's offsets. A streamed file has none, so in it they cannot be skipped.
/// \param name  of the file, for messages
/// \param fields  if not null, gets the places of all values, for the fuzzer
/// \pre OpenVDB is initialized
/// \throw IoError naming the file: not a .vdb; truncated; damaged; a version before 222 (2013) or after 225; no such
/// grid; a grid of another type
/// Cost: memory of at most 40 times `bytes`, plus 1 MiB. The worst are nodes of which the file has little more than
/// masks. An upper internal node has 264 KiB in memory for 8 KiB in the file, a lower one 33 KiB for 1 KiB. A leaf node
/// of doubles has 4 KiB for 129 bytes. Each is about 33 times as much, and the allocator adds to it.
openvdb::GridBase::Ptr parseVdb(std::string_view bytes, const std::string& name, const std::string& wanted,
                                VdbValues values, std::vector<ByteField>* fields = nullptr);

/// Returns a grid's name as a part of a line: at most 80 characters.
std::string shortened(std::string_view name);

} // namespace vdbcage::detail
