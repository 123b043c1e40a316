// What OpenVDB writes is read as OpenVDB reads it, and a file that is damaged gives one line or a grid, never more.

#include <boost/test/unit_test.hpp>

#include <volume/vdb_samples.h>

#include <limits>
#include <set>

#include <openvdb/io/File.h>
#include <openvdb/io/Stream.h>
#include <openvdb/points/PointDataGrid.h>
#include <support/says.h>
#include <support/temporary_folder.h>
#include <vdbcage/core/error.h>
#include <vdbcage/volume/vdb_io.h>

using namespace vdbcage;
using namespace vdbcage::test;
using detail::ByteField;
using detail::parseVdb;
using detail::VdbValues;
using openvdb::Coord;
using openvdb::GridBase;

namespace {

GridBase::Ptr parse(const std::string& bytes, const std::string& wanted = "density",
                    VdbValues values = VdbValues::scalars)
{
    openvdb::initialize();
    return parseVdb(bytes, "a.vdb", wanted, values);
}

GridBase::Ptr readByOpenVdb(const std::string& bytes, const std::string& wanted)
{
    const TemporaryFolder folder;
    writeText(folder / "a.vdb", bytes);
    openvdb::io::File file(folder / "a.vdb");
    file.open(false);
    return file.readGrid(wanted);
}

template <class Tree>
bool sameValues(const Tree& a, const Tree& b)
{
    if (a.background() != b.background() || a.nodeCount() != b.nodeCount()) return false;
    auto i = a.cbeginValueAll(), j = b.cbeginValueAll();
    for (; i && j; ++i, ++j) {
        openvdb::CoordBBox boxA, boxB;
        i.getBoundingBox(boxA);
        j.getBoundingBox(boxB);
        if (boxA != boxB || *i != *j || i.isValueOn() != j.isValueOn()) return false;
    }
    return !i && !j;
}

template <class Grid>
bool sameAs(const GridBase& a, const GridBase& b)
{
    const auto* const treeA = dynamic_cast<const typename Grid::TreeType*>(&a.constBaseTree());
    const auto* const treeB = dynamic_cast<const typename Grid::TreeType*>(&b.constBaseTree());
    return treeA && treeB && sameValues(*treeA, *treeB);
}

bool sameGrids(const GridBase& a, const GridBase& b)
{
    return a.transform() == b.transform() && static_cast<const openvdb::MetaMap&>(a) == b &&
           a.getName() == b.getName() && a.getGridClass() == b.getGridClass() &&
           (sameAs<openvdb::FloatGrid>(a, b) || sameAs<openvdb::DoubleGrid>(a, b) || sameAs<openvdb::BoolGrid>(a, b) ||
            sameAs<openvdb::MaskGrid>(a, b));
}

/// Each kind of content once, named density.
template <class Grid>
std::vector<typename Grid::Ptr> contents()
{
    using Value = typename Grid::ValueType;
    std::vector<typename Grid::Ptr> grids;
    grids.reserve(8); // else g++ 12 sees writes behind its end
    grids.push_back(gridOfTiles<Grid>());
    grids.push_back(Grid::create(Value(1)));
    if constexpr (std::is_floating_point_v<Value>) {
        grids.push_back(gridOfAllCodes<Grid>());
        grids.push_back(openvdb::tools::createLevelSetSphere<Grid>(20, openvdb::Vec3f(5), 1));
        grids.push_back(gridOfTiles<Grid>());
        grids.back()->setGridClass(openvdb::GRID_FOG_VOLUME);
        grids.push_back(Grid::create(Value(0.5)));
        std::mt19937 random(3);
        for (int i = 0; i < 3000; ++i) {
            const auto pick = [&] { return static_cast<int>(random() % 24); };
            const Value value = static_cast<Value>(random()) / Value(7e8);
            grids.back()->tree().setValue(Coord(pick(), pick(), pick()), value);
            if (i % 2 == 0) grids.back()->tree().setValueOff(Coord(pick(), pick(), pick()), -value);
        }
    } else {
        grids.push_back(Grid::create(false));
        grids.back()->sparseFill(openvdb::CoordBBox(Coord(-3), Coord(40)), true, true);
        if constexpr (std::is_same_v<Grid, openvdb::BoolGrid>) {
            grids.back()->sparseFill(openvdb::CoordBBox(Coord(3), Coord(20)), false, true);
            grids.back()->sparseFill(openvdb::CoordBBox(Coord(-3), Coord(2)), true, false);
        }
    }
    for (const auto& grid : grids) {
        grid->setName("density");
        grid->setCreator("me");
        grid->insertMeta("vector", openvdb::Vec3DMetadata(openvdb::Vec3d(1, 2, 3)));
        grid->insertMeta("matrix", openvdb::Mat4DMetadata(openvdb::Mat4d::identity()));
        grid->insertMeta("flag", openvdb::BoolMetadata(true));
        grid->insertMeta("number", openvdb::Int64Metadata(-5));
        grid->insertMeta("text", openvdb::StringMetadata(std::string("a\0b\n", 4)));
    }
    return grids;
}

template <class Grid>
void expectReadsBack()
{
    openvdb::initialize();
    for (std::uint32_t compression = 0; compression < 8; ++compression) {
        for (const bool isHalf : {false, true}) {
            for (const bool hasOffsets : {false, true}) {
                int number = 0;
                for (const auto& grid : contents<Grid>()) {
                    BOOST_TEST_CONTEXT(Grid::gridType() << " compression " << compression << " half " << isHalf
                                                        << " offsets " << hasOffsets << " content " << number++)
                    {
                        grid->setSaveFloatAsHalf(isHalf);
                        const std::string bytes = vdbBytes({grid}, compression, hasOffsets);
                        const GridBase::Ptr back = parse(bytes);
                        BOOST_TEST(sameGrids(*back, *readByOpenVdb(bytes, "density")));
                        if (!isHalf) BOOST_TEST((sameAs<Grid>(*back, *grid)));
                    }
                }
            }
        }
    }
}

/// One leaf node, in a file of less than 12 KB.
std::string smallFile(std::uint32_t compression, bool hasOffsets = true)
{
    openvdb::initialize();
    auto grid = openvdb::FloatGrid::create(0);
    for (int i = 0; i < 60; ++i) grid->tree().setValue(Coord(i % 4, i / 4 % 4, i / 16), i < 30 ? 1.0F : 0.25F);
    grid->tree().setValueOff(Coord(7), 0.7F);
    grid->tree().addTile(3, Coord(8192, 0, 0), 1, true);
    grid->setName("density");
    return vdbBytes({grid}, compression, hasOffsets);
}

std::vector<ByteField> fieldsOf(const std::string& bytes)
{
    std::vector<ByteField> fields;
    parseVdb(bytes, "a.vdb", "density", VdbValues::scalars, &fields);
    return fields;
}

/// The bytes are refused with one line that names the file, or are a grid, of both functions.
bool isHarmless(const std::filesystem::path& path, const std::string& bytes, int* accepted = nullptr)
{
    writeText(path, bytes);
    const auto isHandled = [&](auto read) {
        try {
            if (read() && accepted) ++*accepted;
        } catch (const IoError& error) {
            const std::string text = error.what();
            return text.rfind(path.string() + ": ", 0) == 0 && text.find('\n') == std::string::npos;
        }
        return true;
    };
    return isHandled([&] { return readVdb(path); }) && isHandled([&] { return readFloatGrid(path, "density"); });
}

} // namespace

BOOST_AUTO_TEST_SUITE(vdb_file)

BOOST_AUTO_TEST_CASE(float_grids_are_read_as_openvdb_reads_them)
{
    expectReadsBack<openvdb::FloatGrid>();
}

BOOST_AUTO_TEST_CASE(double_grids_are_read_as_openvdb_reads_them)
{
    expectReadsBack<openvdb::DoubleGrid>();
}

BOOST_AUTO_TEST_CASE(bool_and_mask_grids_are_read_as_openvdb_reads_them)
{
    expectReadsBack<openvdb::BoolGrid>();
    expectReadsBack<openvdb::MaskGrid>();
}

BOOST_AUTO_TEST_CASE(the_samples_have_all_codes_of_inactive_values)
{
    auto grid = gridOfAllCodes<openvdb::FloatGrid>();
    openvdb::initialize();
    const std::string bytes = vdbBytes({grid}, openvdb::io::COMPRESS_ACTIVE_MASK);
    std::set<int> codes;
    for (const ByteField& field : fieldsOf(bytes)) {
        if (field.size == 1) codes.insert(bytes[field.position]);
    }
    for (int code = 0; code <= 6; ++code) BOOST_TEST(codes.count(code) == 1U, "no code " << code);
}

BOOST_AUTO_TEST_CASE(transforms_of_all_kinds)
{
    openvdb::initialize();
    using namespace openvdb::math;
    Mat4d rotation = Mat4d::identity();
    rotation.setToRotation(openvdb::Vec3d(1, 2, 3), 0.5);
    Mat4d affine = rotation;
    affine.postScale(openvdb::Vec3d(0.1, 2, 3));
    affine.setTranslation(openvdb::Vec3d(1e6, 2, 3));
    const openvdb::Vec3d scale(1, 2, -3), shift(-4, 5, 6e5);
    const std::vector<MapBase::Ptr> maps{
        std::make_shared<AffineMap>(affine),
        std::make_shared<UnitaryMap>(openvdb::Vec3d(1, 2, 3), 0.5),
        std::make_shared<ScaleMap>(scale),
        std::make_shared<UniformScaleMap>(0.01),
        std::make_shared<TranslationMap>(shift),
        std::make_shared<ScaleTranslateMap>(scale, shift),
        std::make_shared<UniformScaleTranslateMap>(2, shift),
        std::make_shared<NonlinearFrustumMap>(openvdb::BBoxd(openvdb::Vec3d(0), openvdb::Vec3d(100)), 0.5, 2,
                                              std::make_shared<AffineMap>(affine))};
    for (const MapBase::Ptr& map : maps) {
        auto grid = openvdb::FloatGrid::create(0);
        grid->setName("density");
        grid->setTransform(std::make_shared<Transform>(map));
        const std::string bytes = vdbBytes({grid}, 0);
        BOOST_TEST(parse(bytes)->transform() == grid->transform(), map->type());
        BOOST_TEST(sameGrids(*parse(bytes), *readByOpenVdb(bytes, "density")), map->type());
        // No number of it may be anything at all.
        const std::vector<ByteField> fields = fieldsOf(bytes);
        const std::string type = grid->transform().mapType();
        const std::size_t begin = bytes.find(type) + type.size();
        for (const ByteField& field : fields) {
            if (field.size != 8 || field.position < begin) continue;
            for (const double bad : {std::nan(""), HUGE_VAL}) {
                BOOST_CHECK_EXCEPTION(parse(withValue(bytes, field.position, bad)), IoError, says("damaged"));
            }
        }
    }
}

BOOST_AUTO_TEST_CASE(the_wanted_grid_among_others)
{
    openvdb::initialize();
    const auto named = [](auto grid, const char* name) {
        grid->setName(name);
        return grid;
    };
    const auto density = named(gridOfTiles<openvdb::FloatGrid>(), "density");
    const auto heat = named(gridOfAllCodes<openvdb::FloatGrid>(), "heat");
    const auto second = named(gridOfAllCodes<openvdb::DoubleGrid>(), "density");
    const auto velocity = named(openvdb::Vec3SGrid::create(openvdb::Vec3f(1)), "velocity");
    velocity->tree().setValue(Coord(1), openvdb::Vec3f(2));
    const auto points = named(openvdb::points::PointDataGrid::create(), "points");
    for (const bool hasOffsets : {false, true}) {
        const std::string bytes = vdbBytes({heat, density, second}, 7, hasOffsets);
        BOOST_TEST(sameGrids(*parse(bytes), *readByOpenVdb(bytes, "density[0]")));
        BOOST_TEST(sameGrids(*parse(bytes, "heat"), *readByOpenVdb(bytes, "heat")));
        BOOST_CHECK_EXCEPTION(parse(bytes, "fire"), IoError, says("named fire: heat, density, density"));
        const std::string after = vdbBytes({density, velocity, points}, 7, hasOffsets);
        BOOST_TEST(sameGrids(*parse(after), *readByOpenVdb(after, "density")));
        for (const GridBase::Ptr& other : {GridBase::Ptr(velocity), GridBase::Ptr(points)}) {
            const std::string name = other->getName(), type = other->valueType();
            BOOST_CHECK_EXCEPTION(parse(vdbBytes({other}, 7, hasOffsets)), IoError,
                                  says("grid '" + name + "' holds " + type + " values; float, double"));
            const std::string before = vdbBytes({other, density}, 7, hasOffsets);
            BOOST_CHECK_EXCEPTION(parse(before, name, VdbValues::floats), IoError,
                                  says("holds " + type + " values; float is needed"));
            if (hasOffsets) {
                BOOST_TEST(sameGrids(*parse(before), *readByOpenVdb(before, "density")));
            } else {
                BOOST_CHECK_EXCEPTION(parse(before), IoError, says("has no offsets"));
            }
        }
    }
    BOOST_CHECK_EXCEPTION(parse(vdbBytes({second}, 7), "density", VdbValues::floats), IoError,
                          says("holds double values; float is needed"));
}

BOOST_AUTO_TEST_CASE(grids_that_share_a_tree)
{
    openvdb::initialize();
    const auto first = gridOfTiles<openvdb::FloatGrid>();
    first->setName("first");
    const auto second = openvdb::FloatGrid::create(first->treePtr());
    second->setName("density");
    second->setTransform(openvdb::math::Transform::createLinearTransform(0.25));
    for (const bool hasOffsets : {false, true}) {
        const std::string bytes = vdbBytes({first, second}, 7, hasOffsets);
        BOOST_TEST(sameGrids(*parse(bytes), *readByOpenVdb(bytes, "density")));
        BOOST_TEST(parse(bytes)->transform() == second->transform());
        std::string orphan = bytes; // the parent's name in the second descriptor is the last of its kind
        orphan[orphan.rfind("first")] = 'F';
        const std::size_t parent = orphan.find("first", orphan.find("density"));
        BOOST_TEST(sameGrids(*parse(bytes, "first"), *readByOpenVdb(bytes, "first")));
        if (parent != std::string::npos) orphan[parent] = 'F';
        BOOST_CHECK_EXCEPTION(parse(orphan), IoError, says("shares the tree"));
    }
}

BOOST_AUTO_TEST_CASE(versions)
{
    const std::string bytes = smallFile(7);
    for (const std::uint32_t version : {222U, 223U, 224U, 225U}) BOOST_TEST(parse(withValue(bytes, 8, version)));
    for (const std::uint32_t version : {0U, 221U, 226U, 0xFFFFFFFFU}) {
        BOOST_CHECK_EXCEPTION(parse(withValue(bytes, 8, version)), IoError, says("222 to 225 can be read"));
    }
}

// Written by OpenVDB 13, which has grids of half floats and version 225 of the format.
BOOST_AUTO_TEST_CASE(half_grids_are_read_as_floats)
{
    const std::string bytes = readText(VDBCAGE_SOURCE_DIR "/tests/fuzz/corpus/read_vdb/half_grid_of_openvdb_13");
    const auto half = [](float value) { return static_cast<float>(openvdb::math::half(value)); };
    const auto expected = openvdb::FloatGrid::create(half(0.25F));
    auto accessor = expected->getAccessor();
    accessor.setValue(Coord(1, 2, 3), half(1.5F));
    accessor.setValueOff(Coord(1, 2, 4), half(0.75F));
    accessor.setValue(Coord(9, 9, 9), half(-2.0F));
    expected->fill({Coord(128, 0, 0), Coord(255, 127, 127)}, half(0.1F), true);
    expected->fill({Coord(16, 0, 0), Coord(23, 7, 7)}, half(3.0F), false);
    for (const VdbValues values : {VdbValues::scalars, VdbValues::floats}) {
        const GridBase::Ptr read = parse(bytes, "density", values);
        BOOST_REQUIRE(read->isType<openvdb::FloatGrid>());
        BOOST_TEST(sameValues(static_cast<const openvdb::FloatGrid&>(*read).tree(), expected->tree()));
    }
}

// OpenVDB 10.0.1 reads as many bytes into the node's values as the file says.
BOOST_AUTO_TEST_CASE(lengths_of_chunks_that_do_not_fit)
{
    for (const std::uint32_t compression : {4U, 6U, 1U, 3U}) {
        const std::string bytes = smallFile(compression);
        const std::vector<std::size_t> lengths = chunkLengths(bytes, fieldsOf(bytes));
        BOOST_REQUIRE(!lengths.empty());
        for (const std::size_t position : lengths) {
            for (const std::int64_t length :
                 {std::int64_t{-1}, std::int64_t{-5000}, std::int64_t{-1000000}, std::int64_t{1}, std::int64_t{1000000},
                  std::int64_t{0x7FFFFFFF}, std::int64_t{-0x80000000LL}, std::numeric_limits<std::int64_t>::min(),
                  std::numeric_limits<std::int64_t>::max()}) {
                BOOST_CHECK_EXCEPTION(parse(withValue(bytes, position, length)), IoError, says("a chunk of"));
            }
            // One byte changed: the highest makes it negative, another one too large.
            BOOST_CHECK_EXCEPTION(parse(withValue(bytes, position + 7, '\xFF')), IoError, says("a chunk of"));
            BOOST_CHECK_EXCEPTION(parse(withValue(bytes, position + 2, '\x01')), IoError, says("a.vdb: is "));
        }
    }
}

BOOST_AUTO_TEST_CASE(every_byte_changed)
{
    const TemporaryFolder folder;
    const std::string bytes = smallFile(openvdb::io::COMPRESS_ACTIVE_MASK | openvdb::io::COMPRESS_BLOSC);
    int accepted = 0;
    bool isHandled = true;
    for (std::size_t i = 0; i < bytes.size() && isHandled; ++i) {
        std::string changed = bytes;
        changed[i] = static_cast<char>(i % 2 == 0 ? ~changed[i] : changed[i] ^ 1);
        isHandled = isHarmless(folder / "a.vdb", changed, &accepted);
        BOOST_TEST(isHandled, "byte " << i);
    }
    BOOST_TEST(accepted > 100); // say in the UUID
    BOOST_TEST(static_cast<std::size_t>(accepted) < 2 * bytes.size());
}

BOOST_AUTO_TEST_CASE(every_field_changed)
{
    const TemporaryFolder folder;
    for (const std::uint32_t compression : {2U, 3U, 6U}) {
        for (const bool hasOffsets : {false, true}) {
            const std::string bytes = smallFile(compression, hasOffsets);
            for (const ByteField& field : fieldsOf(bytes)) {
                if (field.size > 8) continue;
                for (const std::int64_t value :
                     {std::int64_t{0}, std::int64_t{1}, std::int64_t{-1}, std::int64_t{0x7FFFFFFF},
                      std::int64_t{0x80000000}, std::int64_t{-0x80000000LL}, std::int64_t{2000},
                      std::numeric_limits<std::int64_t>::max(), std::numeric_limits<std::int64_t>::min()}) {
                    std::string changed = bytes;
                    std::memcpy(changed.data() + field.position, &value, field.size);
                    BOOST_TEST(isHarmless(folder / "a.vdb", changed), "byte " << field.position << " = " << value);
                }
            }
        }
    }
}

BOOST_AUTO_TEST_CASE(every_truncation)
{
    for (const bool hasOffsets : {false, true}) {
        const std::string bytes = smallFile(6, hasOffsets);
        for (std::size_t size = 0; size < bytes.size(); ++size) {
            BOOST_CHECK_EXCEPTION(parse(bytes.substr(0, size)), IoError, says("is not a .vdb file, or is truncated"));
        }
    }
}

BOOST_AUTO_TEST_CASE(damage_that_only_shows_in_the_tree)
{
    const std::string bytes = smallFile(0);
    const std::vector<ByteField> fields = fieldsOf(bytes);
    const auto masks = std::find_if(fields.begin(), fields.end(), [](const ByteField& f) { return f.size == 4096; });
    BOOST_REQUIRE(masks != fields.end());
    const std::size_t children = masks->position, tiles = children + 4096, node = children - 12, tile = node - 17;
    std::string both = bytes;
    for (std::size_t i = 0; i < 4096; ++i) both[tiles + i] = static_cast<char>(both[tiles + i] | both[children + i]);
    BOOST_CHECK_EXCEPTION(parse(both), IoError, says("a tile is where a node is"));
    BOOST_CHECK_EXCEPTION(parse(withValue(bytes, node, 8192)), IoError, says("the same origin"));
    BOOST_CHECK_EXCEPTION(parse(withValue(bytes, node, 1)), IoError, says("not a multiple of 4096"));
    BOOST_CHECK_EXCEPTION(parse(withValue(bytes, tile + 8, 7)), IoError, says("not a multiple of 4096"));
    BOOST_CHECK_EXCEPTION(parse(withValue(bytes, tile + 16, '\2')), IoError, says("neither 0 nor 1"));
    BOOST_CHECK_EXCEPTION(parse(withValue(bytes, node - 8 - 17, 2)), IoError, says("damaged"));
    std::string leaf = bytes; // its mask comes twice; the second one is followed by a code and 512 values
    leaf[leaf.size() - 512 * sizeof(float) - 2] = '\1';
    BOOST_CHECK_EXCEPTION(parse(leaf), IoError, says("the two masks"));

    openvdb::BoolGrid bits(true);
    bits.setName("density");
    bits.tree().setValue(Coord(0), false);
    const std::string ofBits = vdbBytes({bits.copy()}, 0);
    const auto code = ofBits.find(std::string("\6\0", 2) + std::string(100, '\1')); // the values of a node
    BOOST_REQUIRE(code != std::string::npos);
    BOOST_CHECK_EXCEPTION(parse(withValue(ofBits, code + 50, '\2')), IoError, says("neither 0 nor 1"));
    BOOST_CHECK_EXCEPTION(parse(withValue(ofBits, ofBits.size() - 64 - 12, 8)), IoError, says("the two origins"));
}

BOOST_AUTO_TEST_CASE(a_message_is_one_line_whatever_names_a_file_has)
{
    openvdb::initialize();
    const auto grid = openvdb::FloatGrid::create(1);
    grid->setName("two\nlines\x1B[31m" + std::string(1000, 'x'));
    const TemporaryFolder folder;
    BOOST_TEST(isHarmless(folder / "a.vdb", vdbBytes({grid}, 0)));
    BOOST_TEST(isHarmless(folder / "a.vdb", vdbBytes({grid, grid->deepCopy()}, 0)));
    BOOST_TEST(detail::shortened(std::string(81, 'x')).size() == 83U);
}

BOOST_AUTO_TEST_SUITE_END()
