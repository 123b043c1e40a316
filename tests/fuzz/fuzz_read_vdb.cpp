// Any bytes at all: the reader of .vdb files answers with one line or with a grid that OpenVDB can walk and write, and
// that is read again as it was.

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include <fuzz/bytes.h>
#include <vdbcage/core/error.h>
#include <volume/vdb_samples.h>

using namespace vdbcage;
using detail::VdbValues;
using fuzz::require;
using openvdb::GridBase;

namespace {

const std::string name = "fuzz";

GridBase::Ptr parse(std::string_view bytes, VdbValues values)
{
    try {
        GridBase::Ptr grid = detail::parseVdb(bytes, name, "density", values);
        require(grid != nullptr);
        return grid;
    } catch (const IoError& error) {
        const std::string_view message = error.what();
        require(message.substr(0, 6) == "fuzz: " && message.find('\n') == std::string_view::npos);
        return nullptr;
    }
}

/// Whether both are of type Grid and have the same nodes and active values.
template <class Grid>
bool sameAs(const GridBase& a, const GridBase& b)
{
    const auto* const first = dynamic_cast<const Grid*>(&a);
    const auto* const second = dynamic_cast<const Grid*>(&b);
    if (!first || !second || !first->tree().hasSameTopology(second->tree())) return false;
    using Value = typename Grid::ValueType;
    for (auto i = first->tree().cbeginValueOn(), j = second->tree().cbeginValueOn(); i; ++i, ++j) {
        if (!j) return false;
        const Value x = *i, y = *j;
        if (!(x == y || (x != x && y != y))) return false; // or not a number both
    }
    return true;
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    openvdb::initialize();
    const std::string_view bytes(reinterpret_cast<const char*>(data), size);
    const GridBase::Ptr grid = parse(bytes, VdbValues::scalars);
    if (!grid) return 0;
    const bool isFloat = grid->type() == openvdb::FloatGrid::gridType();
    require(isFloat == (parse(bytes, VdbValues::floats) != nullptr));
    test::MemoryArchive archive;
    archive.setCompression(openvdb::io::COMPRESS_ACTIVE_MASK);
    archive.setGridStatsMetadataEnabled(false);
    grid->setSaveFloatAsHalf(false);
    const GridBase::Ptr again = parse(archive.bytes({grid}), VdbValues::scalars);
    require(again && again->getName() == grid->getName() && again->getGridClass() == grid->getGridClass());
    require(sameAs<openvdb::FloatGrid>(*again, *grid) || sameAs<openvdb::DoubleGrid>(*again, *grid) ||
            sameAs<openvdb::BoolGrid>(*again, *grid) || sameAs<openvdb::MaskGrid>(*again, *grid));
    return 0;
}
