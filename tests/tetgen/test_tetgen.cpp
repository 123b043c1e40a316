#include <boost/test/unit_test.hpp>

#include <algorithm>
#include <cctype>
#include <fstream>
#include <set>
#include <string>

#include <support/run_command.h>
#include <vdbcage/mesh/mesh_io.h>
#include <vdbcage/pipeline/pipeline.h>

#include "pipeline/stress_models.h"

using namespace vdbcage;

namespace {

std::string lowerCase(std::string text)
{
    std::transform(text.begin(), text.end(), text.begin(), [](unsigned char c) { return std::tolower(c); });
    return text;
}

/// What TetGen leaves and says of a mesh in `folder`, by `-p` or other switches.
struct Filling {
    test::CommandResult run;
    std::size_t tetrahedra = 0;
};

Filling fill(const Mesh& cage, const test::TemporaryFolder& folder, const std::string& switches = "-p")
{
    writeMesh(cage, folder / "cage.off");
    Filling filling{test::runCommand({VDBCAGE_TETGEN, switches, folder / "cage.off"})};
    std::ifstream elements(folder / "cage.1.ele");
    elements >> filling.tetrahedra; // the file begins with their number
    return filling;
}

const char* const correctSays16 = "The input surface mesh is correct."; ///< TetGen 1.6 by `-d`

/// What TetGen says of faults of the mesh that fill() put into `folder`.
test::CommandResult detect(const test::TemporaryFolder& folder)
{
    return test::runCommand({VDBCAGE_TETGEN, "-d", folder / "cage.off"});
}

void checkCageIsFilled(const test::StressModel& model, Effort effort)
{
    CageOptions options;
    options.faces = 400;
    options.effort = effort;
    const test::TemporaryFolder folder;
    const Mesh cage = makeCage(model.mesh, options);
    Filling filling = fill(cage, folder);
    // TetGen 1.6 turns an edge of this cage, which then meets another one. Its -d finds no fault; -Y keeps the edges.
    if (model.name == "single-faces-05-huge" && detect(folder).out.find(correctSays16) != std::string::npos) {
        filling = fill(cage, folder, "-pY");
    }
    BOOST_TEST(filling.run.status == 0, model.name << filling.run.out << filling.run.err);
    BOOST_TEST(filling.tetrahedra > 0U, model.name);
}

} // namespace

BOOST_AUTO_TEST_CASE(tetgen_fills_cages_with_tetrahedra)
{
    for (const char* name : {"bishop", "bench", "botijo", "creature", "open_shell", "soup"}) {
        Pipeline pipeline(readMesh(std::string(VDBCAGE_MODELS "/") + name + ".obj"));
        for (const int faces : {100, 400}) {
            CageOptions options;
            options.faces = faces;
            options.effort = Effort::fast;
            const test::TemporaryFolder folder;
            const Filling filling = fill(pipeline.run(options), folder);
            BOOST_TEST_CONTEXT(name << " with " << faces << " faces")
            {
                const auto detected = detect(folder);
                BOOST_TEST(detected.status == 0, detected.out + detected.err);
                const bool isClean = detected.out.find("No faces are intersecting.") != std::string::npos || // 1.5
                                     detected.out.find(correctSays16) != std::string::npos;
                BOOST_TEST(isClean, detected.out);

                BOOST_TEST(filling.run.status == 0, filling.run.out + filling.run.err);
                const std::string said = lowerCase(filling.run.out + filling.run.err);
                for (const char* complaint : {"error", "warning", "intersect"}) {
                    BOOST_TEST(said.find(complaint) == std::string::npos, said);
                }
                BOOST_TEST(filling.tetrahedra > 0U);
            }
        }
    }
}

BOOST_AUTO_TEST_CASE(tetgen_fills_cages_of_flat_models)
{
    // Their sides nearly touch: it aborted on every other one before triangles of a cage kept apart.
    const std::set<std::string> flat{"close-sheets", "coplanar", "crossed-sheets", "plates", "single-faces"};
    int models = 0;
    for (const test::StressModel& model : test::stressModels()) {
        if (flat.count(model.name.substr(0, model.name.find_first_of("0123456789") - 1)) == 0) continue;
        checkCageIsFilled(model, Effort::fast);
        ++models;
    }
    BOOST_TEST(models >= 50);
}

BOOST_AUTO_TEST_CASE(tetgen_fills_the_tightest_cages_of_flat_models)
{
    // Their faces are flat, or nearly: it crashed on the second of these before edges were creased.
    int models = 0;
    for (const test::StressModel& model : test::stressModels()) {
        if (model.name.rfind("crossed-sheets-0", 0) != 0 || ++models > 4) continue;
        checkCageIsFilled(model, Effort::best);
    }
    BOOST_TEST(models >= 4);
}
