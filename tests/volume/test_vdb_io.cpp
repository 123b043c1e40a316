#include <boost/test/unit_test.hpp>

#include <volume/masks.h>

#include <csignal>

#include <sys/resource.h>

#include <openvdb/io/File.h>
#include <openvdb/tools/LevelSetSphere.h>
#include <support/says.h>
#include <support/temporary_folder.h>
#include <vdbcage/core/error.h>
#include <vdbcage/volume/vdb_io.h>

using namespace vdbcage;
using namespace vdbcage::test;

namespace {

struct WithOpenVdb {
    WithOpenVdb() { openvdb::initialize(); }
};

// Blobs, and tiles of three levels.
MaskGrid::Ptr model()
{
    auto grid = toGrid(randomBlobs(cubeAt(Coord(-20), 40), 3));
    grid->sparseFill(cubeAt(Coord(64), 16), true);
    grid->tree().addTile(2, Coord(256, 0, -128), true, true);
    grid->tree().addTile(3, Coord(-8192, 0, 0), true, true);
    openvdb::Mat4d matrix = openvdb::Mat4d::identity();
    matrix.setToRotation(openvdb::Vec3d(1, 2, 3), 0.5);
    matrix.postScale(openvdb::Vec3d(0.01));
    matrix.setTranslation(openvdb::Vec3d(1000.125, -1e-3, 7));
    grid->setTransform(openvdb::math::Transform::createLinearTransform(matrix));
    return grid;
}

void writeGrids(const std::filesystem::path& path, const openvdb::GridCPtrVec& grids)
{
    openvdb::io::File file(path.string());
    file.write(grids);
}

} // namespace

BOOST_TEST_GLOBAL_FIXTURE(WithOpenVdb);

BOOST_AUTO_TEST_SUITE(vdb_io)

BOOST_AUTO_TEST_CASE(reads_back_what_was_written)
{
    const TemporaryFolder folder;
    const auto grid = model();
    writeVdb(*grid, folder / "a.vdb");
    const auto back = readVdb(folder / "a.vdb");
    BOOST_TEST(sameTree(*back, *grid));
    BOOST_CHECK(back->transform() == grid->transform());
    writeVdb(*MaskGrid::create(), folder / "empty.vdb");
    BOOST_TEST(readVdb(folder / "empty.vdb")->empty());
    BOOST_TEST(folder.entries() == 2U);
}

BOOST_AUTO_TEST_CASE(is_the_fog_volume_that_hosts_expect)
{
    const TemporaryFolder folder;
    const auto mask = model();
    writeVdb(*mask, folder / "a.vdb", {{"stage", "solid"}, {"source", "b\xC3\xA4r.obj"}});
    openvdb::io::File file((folder / "a.vdb").string());
    file.open();
    BOOST_TEST(file.hasGrid("density"));
    BOOST_TEST(file.getGrids()->size() == 1U);
    const auto grid = openvdb::gridPtrCast<openvdb::FloatGrid>(file.readGrid("density"));
    BOOST_REQUIRE(grid);
    BOOST_TEST(grid->background() == 0.0F);
    BOOST_TEST(grid->getGridClass() == openvdb::GRID_FOG_VOLUME);
    BOOST_TEST(grid->getCreator().find("vdbcage ") == 0U);
    BOOST_TEST(!grid->saveFloatAsHalf());
    BOOST_TEST(grid->metaValue<std::string>("vdbcage_stage") == "solid");
    BOOST_TEST(grid->metaValue<std::string>("vdbcage_source") == "b\xC3\xA4r.obj");
    BOOST_TEST(grid->tree().hasSameTopology(mask->tree()));
    bool allOne = true;
    for (auto value = grid->cbeginValueOn(); value; ++value) allOne = allOne && *value == 1.0F;
    BOOST_TEST(allOne);
    bool allZero = true;
    for (auto value = grid->cbeginValueOff(); value; ++value) allZero = allZero && *value == 0.0F;
    BOOST_TEST(allZero);
}

BOOST_AUTO_TEST_CASE(reads_what_others_write)
{
    const TemporaryFolder folder;
    const auto mask = model();
    const auto path = folder / "a.vdb";
    mask->setName("whatever");
    writeGrids(path, {mask});
    BOOST_TEST(sameTree(*readVdb(path), *mask));

    openvdb::BoolGrid bits(false);
    bits.topologyUnion(*mask); // active tiles with the value false
    bits.tree().setValueOn(Coord(5000), true);
    writeGrids(path, {bits.copy()});
    const auto fromBits = readVdb(path);
    BOOST_TEST(fromBits->tree().isValueOn(Coord(5000)));
    BOOST_TEST(!fromBits->tree().isValueOn(Coord(300, 10, -100)));

    auto sphere = openvdb::tools::createLevelSetSphere<openvdb::FloatGrid>(20, openvdb::Vec3f(3), 1);
    writeGrids(path, {sphere});
    const auto ball = readVdb(path);
    const CoordBBox around = grown(CoordBBox(Coord(3), Coord(3)), 25);
    for (auto c = around.begin(); c; ++c) {
        if (ball->tree().isValueOn(*c) != (sphere->tree().getValue(*c) < 0)) BOOST_ERROR("differs at " << *c);
    }
    BOOST_TEST(ball->tree().isValueOn(Coord(3)));

    auto other = openvdb::DoubleGrid::create(0);
    other->tree().setValueOn(Coord(1), 0.5000001);
    other->tree().setValueOff(Coord(2), 0.6); // the value counts
    other->tree().setValueOn(Coord(3), 0.5);
    other->setName("density");
    writeGrids(path, {sphere, other});
    const auto fromDoubles = readVdb(path);
    BOOST_TEST(fromDoubles->activeVoxelCount() == 2U);
}

BOOST_AUTO_TEST_CASE(bad_files_are_refused)
{
    const TemporaryFolder folder;
    const auto path = folder / "a.vdb";
    BOOST_CHECK_EXCEPTION(readVdb(path), IoError, says("a.vdb: cannot be read: No such file"));
    BOOST_CHECK_EXCEPTION(readVdb(folder.path()), IoError, says("is a directory"));
    for (const std::string& text : {std::string(), std::string("v 0 0 0\n"), std::string(5000, '\0'),
                                    std::string(5000, '\xFF'), std::string(" BDV", 4)}) {
        writeText(path, text);
        BOOST_CHECK_EXCEPTION(readVdb(path), IoError, says(path.string()));
    }
    const auto fog = [](const char* name, float background) {
        auto grid = openvdb::FloatGrid::create(background);
        grid->setName(name);
        return grid;
    };
    writeGrids(path, {fog("temperature", 0), fog("flame", 0)});
    BOOST_CHECK_EXCEPTION(readVdb(path), IoError, says("several grids but none named density: temperature, flame"));
    writeGrids(path, {});
    BOOST_CHECK_EXCEPTION(readVdb(path), IoError, says("holds no grid"));
    writeGrids(path, {fog("density", 1)});
    BOOST_CHECK_EXCEPTION(readVdb(path), IoError, says("background"));
    writeGrids(path, {openvdb::Vec3SGrid::create()});
    BOOST_CHECK_EXCEPTION(readVdb(path), IoError, says("vec3s"));
}

BOOST_AUTO_TEST_CASE(truncated_files_are_refused)
{
    const TemporaryFolder folder;
    writeVdb(*model(), folder / "a.vdb", {{"stage", "solid"}});
    const std::string whole = readText(folder / "a.vdb");
    const std::size_t step = whole.size() / 400 + 1;
    for (std::size_t size = 0; size<whole.size(); size += size + 200> whole.size() ? 1 : step) {
        writeText(folder / "b.vdb", whole.substr(0, size));
        BOOST_CHECK_THROW(readVdb(folder / "b.vdb"), IoError);
    }
}

BOOST_AUTO_TEST_CASE(a_failed_write_leaves_the_old_file_and_nothing_else)
{
    const TemporaryFolder folder;
    const auto path = folder / "a.vdb";
    const auto grid = fatBlobs(60);
    BOOST_CHECK_EXCEPTION(writeVdb(*grid, folder / "no/such/a.vdb"), IoError, says("no/such"));
    writeText(path, "old");
    // A file-size limit stands in for a full disk. At each size the write must fail, also in the last block.
    writeVdb(*grid, folder / "whole.vdb");
    const auto whole = std::filesystem::file_size(folder / "whole.vdb");
    const auto handler = std::signal(SIGXFSZ, SIG_IGN);
    rlimit old{};
    ::getrlimit(RLIMIT_FSIZE, &old);
    for (const auto limit : {std::uintmax_t{0}, std::uintmax_t{100}, whole / 2, whole - 1}) {
        const rlimit small{limit, old.rlim_max};
        ::setrlimit(RLIMIT_FSIZE, &small);
        bool refused = false;
        try {
            writeVdb(*grid, path);
        } catch (const IoError& error) {
            refused = std::string(error.what()).find(path.string()) == 0;
        }
        ::setrlimit(RLIMIT_FSIZE, &old);
        BOOST_TEST(refused);
        BOOST_TEST(readText(path) == "old");
        BOOST_TEST(folder.entries() == 2U);
    }
    std::signal(SIGXFSZ, handler);
}

BOOST_AUTO_TEST_SUITE_END()
