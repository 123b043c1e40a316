#include <boost/test/unit_test.hpp>

#include <algorithm>
#include <cctype>

#include <support/run_command.h>
#include <vdbcage/mesh/mesh_io.h>
#include <vdbcage/pipeline/pipeline.h>

using namespace vdbcage;

namespace {

std::string lowerCase(std::string text)
{
    std::transform(text.begin(), text.end(), text.begin(), [](unsigned char c) { return std::tolower(c); });
    return text;
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
            writeMesh(pipeline.run(options), folder / "cage.off");
            BOOST_TEST_CONTEXT(name << " with " << faces << " faces")
            {
                const auto detected = test::runCommand({VDBCAGE_TETGEN, "-d", folder / "cage.off"});
                BOOST_TEST(detected.status == 0, detected.out + detected.err);
                BOOST_TEST(detected.out.find("No faces are intersecting.") != std::string::npos, detected.out);

                const auto filled = test::runCommand({VDBCAGE_TETGEN, "-p", folder / "cage.off"});
                BOOST_TEST(filled.status == 0, filled.out + filled.err);
                const std::string said = lowerCase(filled.out + filled.err);
                for (const char* complaint : {"error", "warning", "intersect"}) {
                    BOOST_TEST(said.find(complaint) == std::string::npos, said);
                }
                std::ifstream elements(folder / "cage.1.ele");
                std::size_t tetrahedra = 0;
                elements >> tetrahedra; // the file begins with their number
                BOOST_TEST(tetrahedra > 0U);
            }
        }
    }
}
