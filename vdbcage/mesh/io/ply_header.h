#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include <vdbcage/mesh/io/warnings.h>

namespace vdbcage::detail {

enum class PlyFormat { ascii, binaryLittleEndian, binaryBigEndian };

enum class PlyType { int8, uint8, int16, uint16, int32, uint32, int64, uint64, float32, float64 };

/// Returns the size of a value in a binary file, in bytes.
std::size_t sizeOf(PlyType type);

struct PlyProperty {
    std::string name;
    PlyType type = PlyType::int8; ///< of the value, or of each value of the list
    bool isList = false;
    PlyType countType = PlyType::uint8; ///< of the number of values, before a list
};

struct PlyElement {
    std::string name;
    std::uint64_t count = 0;
    std::vector<PlyProperty> properties;
    std::size_t line = 0; ///< of the header, from 1
};

struct PlyHeader {
    PlyFormat format = PlyFormat::ascii;
    std::vector<PlyElement> elements;
    std::size_t size = 0;    ///< in bytes; the body begins there
    std::size_t endLine = 0; ///< the number of its last line, from 1
};

/// Parses the header of a PLY file.
/// \throw IoError naming `name`, the line and the value
PlyHeader parsePlyHeader(std::string_view bytes, const std::string& name, Warnings& warnings);

} // namespace vdbcage::detail
