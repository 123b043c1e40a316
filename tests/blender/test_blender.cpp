#include <boost/test/unit_test.hpp>

#include <nlohmann/json.hpp>
#include <support/run_command.h>
#include <vdbcage/volume/vdb_io.h>

using namespace vdbcage;
using nlohmann::json;

namespace {

/// Runs a script of this folder, which is to end with exit status 0.
void runInBlender(const std::string& script, const std::string& first, const std::string& second)
{
    const auto result =
        test::runCommand({VDBCAGE_BLENDER, "--background", "--factory-startup", "--python-exit-code", "1", "--python",
                          VDBCAGE_SOURCE_DIR "/tests/blender/" + script, "--", first, second});
    BOOST_TEST(result.status == 0, result.out + result.err);
    BOOST_TEST_MESSAGE(result.out);
}

} // namespace

BOOST_AUTO_TEST_CASE(blender_opens_every_stage_and_meshes_it_in_its_place)
{
    const test::TemporaryFolder folder;
    const std::string bishop = VDBCAGE_SOURCE_DIR "/data/bishop.obj", stages = folder / "stages";
    const auto made =
        test::runCommand({VDBCAGE_COMMAND, "make", bishop, "-o", folder / "cage.obj", "--stages", stages, "-q"});
    BOOST_REQUIRE(made.status == 0);

    json facts;
    for (const char* stage : {"solid", "dilated", "closed", "contour"}) {
        const auto mask = readVdb(std::filesystem::path(stages) / (std::string(stage) + ".vdb"));
        const double voxel = mask->voxelSize()[0];
        const openvdb::CoordBBox box = mask->evalActiveVoxelBoundingBox();
        const openvdb::Vec3d corner(0.5);
        const openvdb::Vec3d low = mask->indexToWorld(box.min().asVec3d() - corner);
        const openvdb::Vec3d high = mask->indexToWorld(box.max().asVec3d() + corner);
        facts[stage]["voxel"] = voxel;
        facts[stage]["low"] = {low.x(), low.y(), low.z()};
        facts[stage]["high"] = {high.x(), high.y(), high.z()};
        // A shell one voxel thick is thinner where it is slanted: only its place is compared.
        if (std::string(stage) != "contour") {
            facts[stage]["volume"] = static_cast<double>(mask->activeVoxelCount()) * voxel * voxel * voxel;
        }
    }
    test::writeText(folder / "facts.json", facts.dump());
    runInBlender("stages.py", stages, folder / "facts.json");
}

BOOST_AUTO_TEST_CASE(blender_binds_its_mesh_deform_modifier_to_a_cage)
{
    const test::TemporaryFolder folder;
    const std::string creature = VDBCAGE_SOURCE_DIR "/data/creature.obj", cage = folder / "cage.obj";
    BOOST_REQUIRE(test::runCommand({VDBCAGE_COMMAND, "make", creature, "-o", cage, "--faces", "400", "-q"}).status ==
                  0);
    runInBlender("mesh_deform.py", creature, cage);
}
