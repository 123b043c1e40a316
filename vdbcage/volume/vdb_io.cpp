#include <vdbcage/volume/vdb_io.h>

#include <new>
#include <utility>

#include <openvdb/io/Archive.h>
#include <openvdb/tools/Prune.h>
#include <vdbcage/core/detail/atomic_file.h>
#include <vdbcage/core/detail/io_failure.h>
#include <vdbcage/core/detail/mask_grid.h>
#include <vdbcage/core/detail/parallel.h>
#include <vdbcage/core/detail/read_file.h>
#include <vdbcage/core/error.h>
#include <vdbcage/core/version.h>
#include <vdbcage/volume/detail/vdb/vdb_file.h>

namespace vdbcage {

namespace {

using openvdb::FloatGrid;
using openvdb::MaskGrid;
using openvdb::MaskTree;

constexpr const char* gridName = "density";

// Writes the same bytes as openvdb::io::File, which does not notice a full disk, to a stream with a state to check.
class SeekableArchive : public openvdb::io::Archive {
public:
    Ptr copy() const override { return std::make_shared<SeekableArchive>(*this); }
    void writeTo(std::ostream& stream, const openvdb::GridCPtrVec& grids) const { write(stream, grids, true); }
};

template <class Grid>
MaskGrid::Ptr maskWhere(const Grid& grid, const std::string& path, bool (*isInside)(typename Grid::ValueType, bool))
{
    if (isInside(grid.background(), false)) {
        throw IoError(path + ": the background of grid '" + detail::shortened(grid.getName()) +
                      "' is inside: the solid has no end");
    }
    using Leaf = typename Grid::TreeType::LeafNodeType;
    auto tree = detail::emptyTree<MaskTree>(false);
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
    detail::isolated([&] { openvdb::tools::prune(*tree); });
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

MaskGrid::Ptr toMask(const openvdb::GridBase& grid, const std::string& path)
{
    if (const auto* floats = dynamic_cast<const FloatGrid*>(&grid)) return maskOfScalars(*floats, path);
    if (const auto* doubles = dynamic_cast<const openvdb::DoubleGrid*>(&grid)) return maskOfScalars(*doubles, path);
    if (const auto* bools = dynamic_cast<const openvdb::BoolGrid*>(&grid)) return maskOfBits(*bools, path);
    return maskOfBits(dynamic_cast<const MaskGrid&>(grid), path);
}

/// Reads a grid. The file is read once: the checked bytes are the ones that are used.
openvdb::GridBase::Ptr readGrid(const std::filesystem::path& path, const std::string& wanted, detail::VdbValues values)
{
    openvdb::initialize();
    return detail::withMemoryToRead(
        path, [&] { return detail::parseVdb(detail::readFile(path), path.string(), wanted, values); });
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
    const auto tree = detail::treeLike<openvdb::FloatTree>(mask.tree(), 0.0F, 1.0F);
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
    } // the caller reports a failed stream, with the system's reason
}

MaskGrid::Ptr readVdb(const std::filesystem::path& path)
{
    return toMask(*readGrid(path, gridName, detail::VdbValues::scalars), path.string());
}

FloatGrid::Ptr readFloatGrid(const std::filesystem::path& path, const std::string& wanted)
{
    return openvdb::gridPtrCast<FloatGrid>(readGrid(path, wanted, detail::VdbValues::floats));
}

} // namespace vdbcage
