// What vdbcage-bench prints; never how fast anything is.

#include <boost/test/unit_test.hpp>

#include <algorithm>
#include <sstream>

#include <nlohmann/json.hpp>
#include <support/run_command.h>
#include <support/shapes.h>
#include <vdbcage/mesh/mesh_io.h>

using namespace vdbcage;
using nlohmann::json;
using test::runCommand;

namespace {

const std::string bench = VDBCAGE_BENCH;
const std::string bishop = VDBCAGE_MODELS "/bishop.obj";

/// Runs the benchmark with `words` and reads its lines.
std::vector<json> linesOf(std::vector<std::string> words)
{
    words.insert(words.begin(), bench);
    const auto result = runCommand(words);
    BOOST_TEST(result.status == 0, result.err);
    std::vector<json> lines;
    std::istringstream stream(result.out);
    for (std::string line; std::getline(stream, line);) lines.push_back(json::parse(line));
    return lines;
}

} // namespace

BOOST_AUTO_TEST_SUITE(benchmark)

BOOST_AUTO_TEST_CASE(stages_of_whole_runs)
{
    const auto lines = linesOf({"--threads", "1", "--faces", "100", "--resolutions", "16,32", bishop, bishop});
    BOOST_REQUIRE(lines.size() == 4U);
    for (std::size_t i = 0; i < lines.size(); ++i) BOOST_TEST(lines[i]["resolution"] == (i % 2 ? 32 : 16));
    for (const json& line : lines) {
        BOOST_TEST(line["bounding"] == true);
        BOOST_TEST(line["cage_faces"] <= 100);
        BOOST_TEST(line["memory_peak_mib"] > 1);
        for (const char* stage : {"read", "guard", "voxelize", "close", "surface", "decimate", "tighten", "certify"}) {
            BOOST_TEST(line["stage_seconds"].contains(stage));
            BOOST_TEST(line["stage_cpu_seconds"].contains(stage));
        }
    }
}

BOOST_AUTO_TEST_CASE(cages_beside_plain_decimation)
{
    const auto lines = linesOf(
        {"cage", bishop, "--faces", "50,200", "--efforts", "fast,fair", "--resolution", "32", "--threads", "2"});
    BOOST_REQUIRE(lines.size() == 4U);
    for (std::size_t i = 0; i < lines.size(); ++i) {
        const json& line = lines[i];
        BOOST_TEST(line["faces_asked"] == (i < 2 ? 50 : 200));
        BOOST_TEST(line["effort"] == (i % 2 == 0 ? "fast" : "fair"));
        BOOST_TEST(line["threads"] == 2);
        BOOST_TEST(line["copies"] == 1);
        BOOST_TEST(line["resolution"] == 32);
        BOOST_TEST(line["memory_peak_mib"] > 1);
        BOOST_TEST(line["stage_cpu_seconds"].contains("tighten"));
        BOOST_TEST(line["qem"]["stage_seconds"].size() == 1U);
        for (const json& cage : {line["cage"], line["qem"]}) {
            BOOST_TEST(cage["faces"] <= line["faces_asked"]);
            BOOST_TEST(cage["mean_distance_percent"] > 0);
            BOOST_TEST(cage["mean_distance_percent"] < cage["max_distance_percent"]);
            const json& angles = cage["angle_percentile_degrees"];
            BOOST_TEST(angles["0"] <= angles["1"]);
            BOOST_TEST(angles["1"] < angles["50"]);
        }
        BOOST_TEST(line["cage"]["bounding"] == true);
        BOOST_TEST(line["cage"]["volume_ratio"] > 1);
        BOOST_TEST(line["qem"]["bounding"] == false); // voxels can be tight, but nothing holds it back
    }
}

BOOST_AUTO_TEST_CASE(what_is_no_manifold_is_not_decimated)
{
    const auto lines = linesOf({"cage", VDBCAGE_MODELS "/soup.obj", "--faces", "50", "--efforts", "fast",
                                "--resolution", "16", "--copies", "2"});
    BOOST_REQUIRE(lines.size() == 1U);
    BOOST_TEST(lines[0]["cage"]["bounding"] == true);
    BOOST_TEST(lines[0]["qem"].is_null());
}

BOOST_AUTO_TEST_CASE(copies_are_turned_and_give_medians)
{
    const std::vector<std::string> words{"cage", bishop, "--faces", "50", "--efforts", "fast", "--resolution", "32"};
    const auto with = [&](const char* option, const char* value) {
        std::vector<std::string> all = words;
        all.insert(all.end(), {option, value});
        return linesOf(all).at(0);
    };
    const json median = with("--copies", "3");
    BOOST_TEST(median["copies"] == 3);
    std::vector<json> distances;
    for (const char* copy : {"0", "1", "2"}) {
        distances.push_back(with("--copy", copy)["cage"]["mean_distance_percent"]);
    }
    BOOST_TEST(with("--copies", "1")["cage"]["mean_distance_percent"] == distances[0]);
    std::sort(distances.begin(), distances.end());
    BOOST_TEST(distances[0] < distances[1]);
    BOOST_TEST(distances[1] < distances[2]);
    BOOST_TEST(median["cage"]["mean_distance_percent"] == distances[1]);
}

BOOST_AUTO_TEST_CASE(closings_beside_alternatives)
{
    for (const char* element : {"sphere", "cube"}) {
        const json line = linesOf({"closing", "--model", bishop, "--resolution", "64", "--radius", "5", "--element",
                                   element, "--threads", "1", "--runs", "1"})
                              .at(0);
        BOOST_TEST(line["resolution"] == 64);
        BOOST_TEST(line["radius_voxels"] == 5);
        BOOST_TEST(line["element"] == element);
        BOOST_TEST(line["threads"] == 1);
        BOOST_TEST(line["closed_voxels"] >= line["solid_voxels"]);
        for (const char* part : {"dilation", "erosion", "closing", "alternative"}) {
            BOOST_TEST(line[part].contains("cpu_seconds"));
            BOOST_TEST(line[part].contains("wall_seconds"));
        }
        BOOST_TEST(line["interrupter"]["questions"] > 1);
        BOOST_TEST(line["interrupter"]["largest_gap_cpu_ms"] > 0);
        BOOST_TEST(line["alternative"]["same_voxels"] == true);
        BOOST_TEST(line.contains("times_faster"));
    }
    const json alone =
        linesOf({"closing", "--model", bishop, "--resolution", "32", "--alone", "--scale-field", "sphere:0,0,0,2,0.5"})
            .at(0);
    BOOST_TEST(alone["radius_voxels"] == 2);
    BOOST_TEST(alone["scaled"]["cpu_seconds"] > 0);
    BOOST_TEST(alone["scaled"]["interrupter"]["largest_gap_cpu_ms"] > 0);
    BOOST_TEST(!alone.contains("alternative"));
}

BOOST_AUTO_TEST_CASE(voxelizers_side_by_side)
{
    std::vector<std::string> names{"gl", "gl-raster", "meshToVolume"};
    if (VDBCAGE_HAS_GPL_PART) names.emplace_back("cgal");
    std::string list;
    for (const std::string& name : names) list += (list.empty() ? "" : ",") + name;
    const auto lines =
        linesOf({"voxelize", bishop, "--resolutions", "9,16", "--repeat", "2", "--threads", "1", "--voxelizers", list});
    names.emplace_back("cpu");
    BOOST_REQUIRE(lines.size() == 3U);
    BOOST_TEST(lines[0]["device"].get<std::string>().find("OpenGL 4.") != std::string::npos);
    BOOST_TEST(lines[0]["context_seconds"] > 0);
    BOOST_TEST(lines[0]["compute_shader_seconds"] > 0);
    for (std::size_t i = 1; i < lines.size(); ++i) {
        BOOST_TEST(lines[i]["resolution"] == (i == 1 ? 9 : 16));
        BOOST_TEST(lines[i]["threads"] == 1);
        BOOST_TEST(lines[i]["cpu"]["wall_ratio"] == 1);
        for (const std::string& name : names) {
            BOOST_TEST(lines[i][name]["wall_ratio"] > 0);
            BOOST_TEST(lines[i][name]["cpu_ratio"] >= 0);
            if (name != "meshToVolume") BOOST_TEST(lines[i][name]["different_voxels"] == 0);
        }
        BOOST_TEST(!lines[i]["meshToVolume"].contains("different_voxels"));
    }
}

BOOST_AUTO_TEST_CASE(bad_arguments)
{
    struct Wrong {
        std::vector<std::string> words;
        const char* mention;
    };
    for (const Wrong& wrong : std::vector<Wrong>{{{"cage"}, "models"},
                                                 {{"cage", bishop, "--faces", "3"}, "faces"},
                                                 {{"cage", bishop, "--efforts", "none"}, "effort"},
                                                 {{"cage", bishop, "--copies", "0"}, "--copies"},
                                                 {{"cage", bishop, "--threads", "0"}, "--threads"},
                                                 {{"cage", bishop, "--bounding", "off"}, "--bounding"},
                                                 {{"cage", "missing.obj", "--faces", "50"}, "missing.obj"},
                                                 {{"closing"}, "--model"},
                                                 {{"closing", "--model", bishop, "--radius", "-1"}, "radius"},
                                                 {{"closing", "--model", bishop, "--element", "ball"}, "element"},
                                                 {{"voxelize", bishop, "--voxelizers", "abacus"}, "--voxelizers"},
                                                 {{"voxelize", bishop, "--repeat", "0"}, "--repeat"},
                                                 {{"voxelize", bishop, "--resolutions", "0"}, "--resolutions"},
                                                 {{bishop, "--threads", "0"}, "--threads"},
                                                 {{bishop, "--resolutions", "1"}, "resolution"}}) {
        std::vector<std::string> words{bench};
        words.insert(words.end(), wrong.words.begin(), wrong.words.end());
        const auto result = runCommand(words);
        BOOST_TEST_CONTEXT(wrong.words.back())
        {
            BOOST_TEST(result.status != 0);
            BOOST_TEST(result.out.empty());
            BOOST_TEST(result.err.find(wrong.mention) != std::string::npos, result.err);
        }
    }
}

BOOST_AUTO_TEST_CASE(binding_and_posing)
{
    const auto lines = linesOf({"deform", bishop, "--faces", "50", "--points", "100", "--mesh", "triangles",
                                "--coordinates", "mvc,green", "--runs", "2"});
    BOOST_REQUIRE(lines.size() == 2U);
    for (const json& line : lines) {
        BOOST_TEST(line["points"] == 100);
        BOOST_TEST(line["cage_triangles"] <= 50);
        for (const char* work : {"bind", "pose", "update_of_one_vertex"}) {
            BOOST_TEST(line[work]["cpu_seconds"].get<double>() >= 0);
        }
    }
    BOOST_TEST(lines[1]["handles"] == lines[0]["handles"].get<int>() + lines[0]["cage_triangles"].get<int>());
}

BOOST_AUTO_TEST_SUITE_END()
