#pragma once

#include <cstdint>
#include <cstring>
#include <random>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

#include <openvdb/io/Archive.h>
#include <openvdb/openvdb.h>
#include <openvdb/tools/LevelSetSphere.h>
#include <vdbcage/volume/detail/vdb/vdb_file.h>

/// .vdb files in memory, as OpenVDB writes them, and what can be changed about them.
namespace vdbcage::test {

/// Writes to any stream, with the offsets that io::File writes or without as io::Stream does.
class MemoryArchive : public openvdb::io::Archive {
public:
    std::string bytes(const openvdb::GridCPtrVec& grids, bool hasOffsets = true) const
    {
        std::ostringstream stream;
        Archive::write(stream, grids, hasOffsets);
        return stream.str();
    }
};

inline std::string vdbBytes(const openvdb::GridCPtrVec& grids, std::uint32_t compression, bool hasOffsets = true)
{
    MemoryArchive archive;
    archive.setCompression(compression);
    return archive.bytes(grids, hasOffsets);
}

/// Leaf nodes, one for each way in which OpenVDB leaves out inactive values.
template <class Grid>
typename Grid::Ptr gridOfAllCodes()
{
    using Value = typename Grid::ValueType;
    const auto value = [](double number) { return static_cast<Value>(number); };
    auto grid = Grid::create(value(3));
    // The inactive values of each leaf node, of which the background is 3.
    const std::vector<std::vector<double>> inactive{{3},     {-3},   {7},    {3, -3},  {3, 8},
                                                    {-3, 3}, {8, 3}, {5, 6}, {1, 2, 4}};
    std::mt19937 random(7);
    for (std::size_t i = 0; i < inactive.size(); ++i) {
        auto* const leaf = grid->tree().touchLeaf(openvdb::Coord(static_cast<int>(8 * i), 0, -8));
        for (openvdb::Index n = 0; n < leaf->SIZE; ++n) {
            if (random() % 3 == 0) {
                leaf->setValueOn(n, value(static_cast<double>(random() % 1000) / 16));
            } else {
                leaf->setValueOff(n, value(inactive[i][n % inactive[i].size()]));
            }
        }
    }
    return grid;
}

/// Active and inactive tiles of all levels, and voxels that are far from each other.
template <class Grid>
typename Grid::Ptr gridOfTiles()
{
    using Value = typename Grid::ValueType;
    auto grid = Grid::create(static_cast<Value>(0));
    auto& tree = grid->tree();
    for (int i = 0; i < 4; ++i) {
        const bool isActive = i % 2 == 0;
        const auto value = static_cast<Value>(i + 1);
        tree.addTile(1, openvdb::Coord(8 * i, 64, 0), value, isActive);
        tree.addTile(2, openvdb::Coord(128 * i, 512, 0), value, isActive);
        tree.addTile(3, openvdb::Coord(4096 * (i - 2), 8192, 0), value, isActive);
        tree.setValue(openvdb::Coord(10000 * i, -1, -77777 * i), value);
    }
    tree.setValue(openvdb::Coord::min(), static_cast<Value>(1));
    tree.setValue(openvdb::Coord::max(), static_cast<Value>(1));
    return grid;
}

/// Where a chunk's length, which precedes compressed values, lies in the file.
inline std::vector<std::size_t> chunkLengths(const std::string& bytes, const std::vector<detail::ByteField>& fields)
{
    std::vector<std::size_t> result;
    for (std::size_t i = 0; i + 1 < fields.size(); ++i) {
        std::int64_t length = 0;
        if (fields[i].size != sizeof(length) || fields[i + 1].position != fields[i].position + sizeof(length)) continue;
        std::memcpy(&length, bytes.data() + fields[i].position, sizeof(length));
        if (length == 0 || static_cast<std::size_t>(std::abs(length)) != fields[i + 1].size) continue;
        result.push_back(fields[i].position);
    }
    return result;
}

template <class Value>
std::string withValue(std::string bytes, std::size_t position, Value value)
{
    std::memcpy(bytes.data() + position, &value, sizeof(value));
    return bytes;
}

} // namespace vdbcage::test
