#include <vdbcage/volume/vdb_io.h>

#include <cerrno>
#include <cstdint>
#include <exception>
#include <fstream>
#include <new>
#include <system_error>
#include <utility>

#include <openvdb/io/Archive.h>
#include <openvdb/io/Stream.h>
#include <openvdb/tools/Prune.h>
#include <vdbcage/core/atomic_file.h>
#include <vdbcage/core/detail/mask_grid.h>
#include <vdbcage/core/error.h>
#include <vdbcage/core/version.h>

namespace vdbcage {

namespace {

using openvdb::FloatGrid;
using openvdb::MaskGrid;
using openvdb::MaskTree;

constexpr const char* gridName = "density";

// openvdb::io::File does not notice a full disk. This writes the same bytes to a stream, whose state can be asked.
class SeekableArchive : public openvdb::io::Archive {
public:
    Ptr copy() const override { return std::make_shared<SeekableArchive>(*this); }
    void writeTo(std::ostream& stream, const openvdb::GridCPtrVec& grids) const { write(stream, grids, true); }
};

template <class Grid>
MaskGrid::Ptr maskWhere(const Grid& grid, const std::string& path, bool (*isInside)(typename Grid::ValueType, bool))
{
    if (isInside(grid.background(), false)) {
        throw IoError(path + ": the background of grid '" + grid.getName() + "' is inside: the solid has no end");
    }
    using Leaf = typename Grid::TreeType::LeafNodeType;
    auto tree = std::make_shared<MaskTree>(false);
    openvdb::tree::ValueAccessor<MaskTree> target(*tree);
    auto tile = grid.tree().cbeginValueAll();
    tile.setMaxDepth(Grid::TreeType::ValueAllCIter::LEAF_DEPTH - 1);
    for (; tile; ++tile) {
        if (!isInside(*tile, tile.isValueOn())) continue;
        openvdb::CoordBBox box;
        tile.getBoundingBox(box);
        target.addTile(tile.getLevel(), box.min(), true, true);
    }
    for (auto leaf = grid.tree().cbeginLeaf(); leaf; ++leaf) {
        auto* const out = target.touchLeaf(leaf->origin());
        for (openvdb::Index i = 0; i < Leaf::SIZE; ++i) {
            if (isInside(leaf->getValue(i), leaf->isValueOn(i))) out->setValueOn(i);
        }
    }
    openvdb::tools::prune(*tree);
    return detail::maskGridLike(grid, std::move(tree));
}

template <class Grid>
MaskGrid::Ptr maskOfScalars(const Grid& grid, const std::string& path)
{
    using Value = typename Grid::ValueType;
    if (grid.getGridClass() == openvdb::GRID_LEVEL_SET) {
        return maskWhere(
            grid, path, +[](Value value, bool) { return value < 0; });
    }
    return maskWhere(
        grid, path, +[](Value value, bool) { return value > Value(0.5); });
}

template <class Grid>
MaskGrid::Ptr maskOfBits(const Grid& grid, const std::string& path)
{
    return maskWhere(
        grid, path, +[](bool value, bool isOn) { return value && isOn; });
}

openvdb::GridBase::Ptr chosenGrid(const openvdb::GridPtrVec& grids, const std::string& wanted, const std::string& path)
{
    for (const auto& grid : grids) {
        if (grid && grid->getName() == wanted) return grid;
    }
    if (grids.size() == 1 && grids.front()) return grids.front();
    std::string names;
    for (const auto& grid : grids) names += (names.empty() ? "" : ", ") + (grid ? grid->getName() : std::string());
    throw IoError(
        path + (grids.empty() ? ": holds no grid" : ": holds several grids but none named " + wanted + ": " + names));
}

MaskGrid::Ptr toMask(const openvdb::GridBase& grid, const std::string& path)
{
    if (const auto* floats = dynamic_cast<const FloatGrid*>(&grid)) return maskOfScalars(*floats, path);
    if (const auto* doubles = dynamic_cast<const openvdb::DoubleGrid*>(&grid)) return maskOfScalars(*doubles, path);
    if (const auto* bools = dynamic_cast<const openvdb::BoolGrid*>(&grid)) return maskOfBits(*bools, path);
    if (const auto* masks = dynamic_cast<const MaskGrid*>(&grid)) return maskOfBits(*masks, path);
    throw IoError(path + ": grid '" + grid.getName() + "' holds " + grid.valueType() +
                  " values; float, double, bool or mask is needed");
}

openvdb::GridBase::Ptr readGrid(const std::filesystem::path& path, const std::string& wanted)
{
    const std::string name = path.string();
    std::error_code ignored;
    if (std::filesystem::is_directory(path, ignored)) throw IoError(name + ": is a directory; a .vdb file is needed");
    errno = 0;
    std::ifstream stream(path, std::ios::binary);
    if (!stream) throw IoError(name + ": cannot be read: " + std::generic_category().message(errno));
    openvdb::initialize();
    openvdb::GridPtrVecPtr grids;
    try {
        // OpenVDB does not look whether its reads succeed; the stream does.
        stream.exceptions(std::ios::failbit | std::ios::badbit | std::ios::eofbit);
        grids = openvdb::io::Stream(stream, false).getGrids();
    } catch (const std::ios_base::failure&) {
        throw IoError(name + ": is not a .vdb file, or is truncated");
    } catch (const std::bad_alloc&) {
        throw IoError(name + ": is damaged, or needs more memory than there is");
    } catch (const std::exception& error) {
        throw IoError(name + ": is not a .vdb file that can be read: " + error.what());
    }
    return chosenGrid(*grids, wanted, name);
}

} // namespace

void writeVdb(const MaskGrid& mask, const std::filesystem::path& path,
              const std::map<std::string, std::string>& metadata)
{
    writeFileAtomically(path, [&](std::ostream& out) { writeVdb(mask, out, path, metadata); });
}

void writeVdb(const MaskGrid& mask, std::ostream& out, const std::filesystem::path& path,
              const std::map<std::string, std::string>& metadata)
{
    openvdb::initialize();
    const auto tree = std::make_shared<openvdb::FloatTree>(mask.tree(), 0.0F, 1.0F, openvdb::TopologyCopy());
    const auto grid = FloatGrid::create(tree);
    detail::copyTransform(mask, *grid);
    grid->setName(gridName);
    grid->setGridClass(openvdb::GRID_FOG_VOLUME);
    grid->setCreator("vdbcage " VDBCAGE_VERSION);
    for (const auto& [key, value] : metadata) grid->insertMeta("vdbcage_" + key, openvdb::StringMetadata(value));
    try {
        SeekableArchive().writeTo(out, {grid});
    } catch (const openvdb::Exception& error) {
        if (out) throw IoError(path.string() + ": cannot be written: " + error.what());
    } // a failed stream is the caller's to report, with the system's reason
}

MaskGrid::Ptr readVdb(const std::filesystem::path& path)
{
    return toMask(*readGrid(path, gridName), path.string());
}

FloatGrid::Ptr readFloatGrid(const std::filesystem::path& path, const std::string& wanted)
{
    const auto grid = readGrid(path, wanted);
    auto floats = openvdb::gridPtrCast<FloatGrid>(grid);
    if (floats) return floats;
    throw IoError(path.string() + ": grid '" + grid->getName() + "' holds " + grid->valueType() +
                  " values; float is needed");
}

} // namespace vdbcage
