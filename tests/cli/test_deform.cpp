#include <boost/test/unit_test.hpp>

#include <algorithm>
#include <cstring>
#include <random>
#include <sstream>

#include <deform/cages.h>
#include <support/read_png.h>
#include <support/reordered.h>
#include <support/run_command.h>
#include <support/shapes.h>
#include <vdbcage/check/check.h>
#include <vdbcage/deform/binding.h>
#include <vdbcage/mesh/mesh_io.h>

using namespace vdbcage;
using openvdb::Vec3d;
using test::runCommand;
using test::TemporaryFolder;

namespace {

const std::string command = VDBCAGE_COMMAND;

/// A folder with a cage, its poses as frames 8 to 11, and a model within that has all that an OBJ can have.
struct Scene {
    Scene()
    {
        cage = test::sphere({}, 2, 5);
        writeMesh(cage, folder / "cage.obj");
        for (int frame = 8; frame <= 11; ++frame) {
            Mesh posed = cage;
            for (Vec3d& p : posed.points) p.x() *= 1 + 0.1 * (frame - 8);
            char name[32];
            std::snprintf(name, sizeof name, "posed.%04d.obj", frame);
            writeMesh(posed, folder / name);
        }
        test::writeText(folder / "model.obj", "mtllib a.mtl\nv 1 0 0\nv 0 1 0\nv 0 0 1\nv -1 0 0\nvt 0 0\nvn 0 0 1\n"
                                              "g part\nusemtl red\nf 1/1/1 2/1/1 3/1/1\nf 1//1 3//1 4//1\n");
        model = readMesh(folder / "model.obj");
    }
    std::string at(const std::string& name) const { return folder / name; }

    TemporaryFolder folder;
    Mesh cage, model;
};

double difference(const std::vector<Vec3d>& a, const std::vector<Vec3d>& b)
{
    BOOST_REQUIRE(a.size() == b.size());
    double most = 0;
    for (std::size_t i = 0; i < a.size(); ++i) most = std::max(most, (a[i] - b[i]).length());
    return most;
}

void expectRefusal(const Scene& scene, std::vector<std::string> words, const std::string& mention)
{
    words.insert(words.begin(), command);
    const std::size_t before = scene.folder.entries();
    const auto result = runCommand(words);
    BOOST_TEST(result.status == 1);
    BOOST_TEST(std::count(result.err.begin(), result.err.end(), '\n') == 1, result.err);
    BOOST_TEST(result.err.find(mention) != std::string::npos, result.err + " lacks " + mention);
    BOOST_TEST(scene.folder.entries() == before);
}

/// All names that --coordinates takes.
std::vector<std::string> familyNames()
{
    std::vector<std::string> names;
    for (const FamilyInfo& family : coordinateFamilies()) {
        names.emplace_back(family.name);
        if (family.nameOnQuads != names.back()) names.emplace_back(family.nameOnQuads);
    }
    return names;
}

} // namespace

BOOST_AUTO_TEST_SUITE(deform)

BOOST_AUTO_TEST_CASE(bind_and_deform)
{
    const Scene scene;
    const std::string cage = scene.at("cage.obj"), model = scene.at("model.obj"), posed = scene.at("posed.0010.obj");
    for (const std::string& family : familyNames()) {
        const std::string weights = scene.at("w.npy");
        const auto bound = runCommand({command, "bind", cage, model, "-o", weights, "--coordinates", family});
        BOOST_TEST(bound.status == 0, bound.err);
        BOOST_TEST(bound.err.find("4 points") != std::string::npos, bound.err);
        const auto stored =
            runCommand({command, "deform", cage, posed, model, "-o", scene.at("a.obj"), "--weights", weights});
        BOOST_TEST(stored.status == 0, stored.err);
        const auto fresh =
            runCommand({command, "deform", cage, posed, model, "-o", scene.at("b.obj"), "--coordinates", family, "-q"});
        BOOST_TEST(fresh.status == 0);
        BOOST_TEST(fresh.err.empty(), fresh.err);
        const std::string text = test::readText(scene.at("a.obj"));
        BOOST_TEST(text == test::readText(scene.at("b.obj")));
        for (const char* kept : {"mtllib a.mtl\n", "usemtl red\nf 1/1/1 2/1/1 3/1/1\nf 1//1 3//1 4//1\n", "g part\n"}) {
            BOOST_TEST(text.find(kept) != std::string::npos, text);
        }
        const Binding binding(scene.cage, scene.model.points, coordinatesNamed(family));
        BOOST_TEST(difference(readMesh(scene.at("a.obj")).points, binding.pose(readMesh(posed).points)) == 0);
        const std::vector<float> computed =
            computeWeights(scene.cage, scene.model.points, coordinatesNamed(family)); // all that a float tells
        const std::string file = test::readText(weights);
        BOOST_REQUIRE(file.size() > computed.size() * sizeof(float));
        BOOST_TEST((std::memcmp(file.data() + file.size() - computed.size() * sizeof(float), computed.data(),
                                computed.size() * sizeof(float)) == 0));
    }
    // The rest pose gives back the model, byte by byte but for the normals.
    BOOST_TEST(runCommand({command, "deform", cage, cage, model, "-o", scene.at("rest.obj")}).status == 0);
    BOOST_TEST((readMesh(scene.at("rest.obj")).points == scene.model.points));
}

BOOST_AUTO_TEST_CASE(weights_that_were_made_elsewhere)
{
    const Scene scene;
    const std::string cage = scene.at("cage.obj"), model = scene.at("model.obj"), posed = scene.at("posed.0010.obj"),
                      out = scene.at("out.obj"), given = scene.at("given.npy"), text = scene.at("given.dmat");
    const std::size_t rows = scene.model.points.size(), columns = scene.cage.points.size();
    const std::vector<float> weights = computeWeights(scene.cage, scene.model.points, Coordinates::maximumLikelihood);
    std::string header = "{'descr': '<f4', 'fortran_order': False, 'shape': (" + std::to_string(rows) + ", " +
                         std::to_string(columns) + "), }\n";
    std::string npy("\x93NUMPY\x01\x00", 8), dmat = std::to_string(columns) + ' ' + std::to_string(rows) + '\n';
    npy += char(header.size());
    npy += '\0';
    npy += header;
    npy.append(reinterpret_cast<const char*>(weights.data()), weights.size() * sizeof(float));
    for (std::size_t i = 0; i < weights.size(); ++i) {
        char digits[32];
        std::snprintf(digits, sizeof digits, "%.9g\n", double(weights[i % rows * columns + i / rows]));
        dmat += digits;
    }
    test::writeText(given, npy);
    test::writeText(text, dmat);
    const std::vector<Vec3d> expected =
        Binding(scene.cage, scene.model.points, Coordinates::maximumLikelihood).pose(readMesh(posed).points);
    for (const std::string& file : {given, text}) {
        const auto result = runCommand({command, "deform", cage, posed, model, "-o", out, "--weights", file});
        BOOST_TEST(result.status == 0, result.err);
        BOOST_TEST(result.err.find("1 pose of 4 points") != std::string::npos, result.err);
        BOOST_TEST(difference(readMesh(out).points, expected) == 0);
        std::filesystem::remove(out);
        for (const char* family : {"mvc", "mlc", "harmonic"}) {
            expectRefusal(scene, {"deform", cage, posed, model, "-o", out, "--weights", file, "--coordinates", family},
                          file + ": its weights were made elsewhere; they do not go with --coordinates " + family);
        }
        expectRefusal(scene, {"deform", cage, posed, model, "-o", out, "--weights", file, "--inversions"},
                      file + ": its weights were made elsewhere; --inversions needs coordinates that can be computed "
                             "at other points");
        BOOST_TEST(!std::filesystem::exists(out));
        expectRefusal(scene, {"deform", cage, posed, cage, "-o", out, "--weights", file},
                      file + ": it has 4 rows; rows: the model has 42 points");
    }
    test::writeText(given, npy.substr(0, npy.size() - 1));
    expectRefusal(scene, {"deform", cage, posed, model, "-o", out, "--weights", given}, given + ": it is truncated");
    expectRefusal(scene, {"deform", cage, posed, model, "-o", out, "--coordinates", "given"}, test::thereAreFamilies());
    expectRefusal(scene, {"bind", cage, model, "-o", scene.at("w.npy"), "--coordinates", "given"},
                  test::thereAreFamilies());
}

BOOST_AUTO_TEST_CASE(families_compared)
{
    const Scene scene;
    const std::string cage = scene.at("cage.obj"), model = scene.at("model.obj"), posed = scene.at("posed.0010.obj");
    const std::string sheet = scene.at("sheet.png");
    const auto compared = runCommand({command, "deform", cage, posed, model, "-o", sheet, "--compare"});
    BOOST_TEST(compared.status == 0, compared.err);
    BOOST_TEST(test::readText(sheet).substr(1, 3) == "PNG");
    std::istringstream lines(compared.out);
    std::string line;
    std::getline(lines, line);
    BOOST_TEST(line == "family     distortion   99th pct     volume   inverted");
    for (const FamilyInfo& family : coordinateFamilies()) {
        std::getline(lines, line);
        BOOST_TEST(line.substr(0, line.find(' ')) == family.name);
    }
    BOOST_TEST(!std::getline(lines, line));
    const auto atRest = runCommand({command, "deform", cage, cage, model, "-o", sheet, "--compare"});
    BOOST_TEST(atRest.out.find("mlc             1.000      1.000          -          0\n") != std::string::npos,
               atRest.out);

    const std::string other = scene.at("other.png");
    expectRefusal(scene, {"deform", cage, posed, model, "-o", scene.at("other.obj"), "--compare"},
                  "the name must end so");
    for (const std::vector<std::string>& options :
         {std::vector<std::string>{"--inversions"}, {"--weights", "w.npy"}, {"--coordinates", "mvc"}}) {
        std::vector<std::string> words{"deform", cage, posed, model, "-o", other, "--compare"};
        words.insert(words.end(), options.begin(), options.end());
        expectRefusal(scene, words, "--compare shows all families");
    }
    expectRefusal(scene, {"deform", cage, scene.at("posed.%04d.obj"), model, "-o", other, "--compare"},
                  "--compare is of one pose");
    // What is far outside has mean value coordinates only.
    const std::string outside = scene.at("outside.obj");
    test::writeText(outside, "v 9 9 9\nv 9 8 9\nv 8 9 9\nf 1 2 3\n");
    const auto far = runCommand({command, "deform", cage, posed, outside, "-o", other, "--compare"});
    BOOST_TEST(far.status == 0, far.err);
    BOOST_TEST(far.out.find("green: points: green coordinates are not defined at 3 of 3 points, first at point 0") !=
                   std::string::npos,
               far.out);
    BOOST_TEST(far.out.find("mvc ") != std::string::npos, far.out);
}

BOOST_AUTO_TEST_CASE(points_of_no_face_are_told_and_ride_along_or_stay)
{
    const Scene scene;
    const std::string cage = scene.at("cage.obj"), posed = scene.at("posed.0010.obj"), model = scene.at("loose.obj");
    test::writeText(model, "v 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 2 3\nv 0 0 0\nv 9 0 0\n");
    const std::string out = scene.at("out.obj");
    const auto checked = runCommand({command, "check", cage, model});
    BOOST_TEST(checked.status == 0, checked.out);
    BOOST_TEST(checked.out.find("points of no face         2, outside of the cage 1\n") != std::string::npos,
               checked.out);
    for (const std::string& family : familyNames()) {
        const auto ridden = runCommand({command, "deform", cage, posed, model, "-o", out, "--coordinates", family});
        BOOST_TEST(ridden.status == 0, ridden.err);
        BOOST_TEST(ridden.err.find("that no face uses: 2; outside of the cage they ride along") != std::string::npos,
                   ridden.err);
        BOOST_TEST(readMesh(out).points[4].x() > 9.5);
        const auto still =
            runCommand({command, "deform", cage, posed, model, "-o", out, "--coordinates", family, "--loose", "stay"});
        BOOST_TEST(still.err.find("that no face uses: 2; they stay") != std::string::npos, still.err);
        BOOST_TEST(readMesh(out).points[4] == Vec3d(9, 0, 0));
        const auto bound = runCommand({command, "bind", cage, model, "-o", scene.at("w.npy"), "--coordinates", family});
        BOOST_TEST(bound.status == 0, bound.err);
        BOOST_TEST(bound.err.find("that no face uses: 2") != std::string::npos, bound.err);
        const auto stored =
            runCommand({command, "deform", cage, posed, model, "-o", out, "--weights", scene.at("w.npy")});
        BOOST_TEST(stored.status == 0, stored.err);
        BOOST_TEST(readMesh(out).points[4].x() > 9.5);
    }
    expectRefusal(scene, {"deform", cage, posed, model, "-o", scene.at("other.obj"), "--loose", "fly"},
                  "it must be ride or stay");
    const auto made = runCommand({command, "make", model, "-o", scene.at("made.obj"), "--report", scene.at("r.json")});
    BOOST_TEST(made.err.find("points of the model that no face uses: 2, outside of the cage: ") != std::string::npos,
               made.err);
}

BOOST_AUTO_TEST_CASE(resolutions)
{
    const Scene scene;
    const std::string cage = scene.at("cage.obj"), model = scene.at("model.obj"), weights = scene.at("w.npy");
    const auto bytesOf = [&](const std::vector<std::string>& options) {
        std::vector<std::string> words{command, "bind", cage, model, "-o", weights, "--coordinates", "harmonic"};
        words.insert(words.end(), options.begin(), options.end());
        const auto bound = runCommand(words);
        BOOST_TEST(bound.status == 0, bound.err);
        return test::readText(weights);
    };
    const std::string usual = bytesOf({});
    BOOST_TEST((bytesOf({"--resolution", "64"}) == usual));
    BOOST_TEST((bytesOf({"--resolution", "5"}) != usual));
    expectRefusal(scene,
                  {"deform", cage, scene.at("posed.0010.obj"), model, "-o", scene.at("out.obj"), "--weights", weights,
                   "--resolution", "5"},
                  "--resolution is of weights that are computed; it does not go with --weights");
    std::filesystem::remove(weights);
    expectRefusal(scene, {"bind", cage, model, "-o", weights, "--coordinates", "harmonic", "--resolution", "3"},
                  "resolution: 3 is not allowed; it must be 4 to 256");
    expectRefusal(scene, {"bind", cage, model, "-o", weights, "--resolution", "64"},
                  "resolution: only harmonic coordinates have it; these are mvc");
    BOOST_TEST(!std::filesystem::exists(weights));
}

BOOST_AUTO_TEST_CASE(elasticities)
{
    const Scene scene;
    const std::string cage = scene.at("cage.obj"), model = scene.at("model.obj"), posed = scene.at("posed.0010.obj"),
                      weights = scene.at("w.npy"), out = scene.at("out.obj");
    const auto posedBy = [&](const std::vector<std::string>& options) {
        std::vector<std::string> words{command, "deform", cage, posed, model, "-o", out, "-q"};
        words.insert(words.end(), options.begin(), options.end());
        const auto result = runCommand(words);
        BOOST_TEST(result.status == 0, result.err);
        return test::readText(out);
    };
    const std::string usual = posedBy({"--coordinates", "somigliana"});
    BOOST_TEST(runCommand({command, "bind", cage, model, "-o", weights, "--coordinates", "somigliana"}).status == 0);
    const std::vector<std::pair<const char*, const char*>> options{
        {"--nu", "-0.5"}, {"--rotations", "local"}, {"--local-bulging", "20"}, {"--global-bulging", "20"}};
    for (const auto& [name, value] : options) {
        const std::string other = posedBy({"--coordinates", "somigliana", name, value});
        BOOST_TEST((other != usual), name);
        BOOST_TEST((posedBy({"--weights", weights, name, value}) == other)); // the weights are the same
        std::filesystem::remove(out);
        expectRefusal(scene, {"deform", cage, posed, model, "-o", out, name, value},
                      std::string(name).substr(2) + ": only somigliana coordinates have it; these are mvc");
    }
    expectRefusal(scene, {"deform", cage, posed, model, "-o", out, "--coordinates", "somigliana", "--nu", "0.5"},
                  "nu: 0.5 is not allowed; it must be above -1 and below 0.5");
    expectRefusal(scene, {"deform", cage, posed, model, "-o", scene.at("a.png"), "--compare", "--nu", "-1"},
                  "nu: -1 is not allowed");
    expectRefusal(scene, {"deform", cage, posed, model, "-o", out, "--coordinates", "somigliana", "--rotations", "x"},
                  "rotations: 'x' is not allowed; it must be global or local");
    BOOST_TEST(runCommand({command, "bind", cage, model, "-o", weights}).status == 0);
    expectRefusal(scene, {"deform", cage, posed, model, "-o", out, "--weights", weights, "--nu", "0.1"},
                  "nu: only somigliana coordinates have it; these are mvc");
}

BOOST_AUTO_TEST_CASE(sequences)
{
    const Scene scene;
    test::writeText(scene.at("posed.12.obj"), "not of the pattern");
    const auto result = runCommand({command, "deform", scene.at("cage.obj"), scene.at("posed.%04d.obj"),
                                    scene.at("model.obj"), "-o", scene.at("out.%d.ply")});
    BOOST_TEST(result.status == 0, result.err);
    BOOST_TEST(result.err.find("4 poses") != std::string::npos, result.err);
    for (int frame = 8; frame <= 11; ++frame) {
        std::vector<Vec3d> expected = scene.model.points;
        for (Vec3d& p : expected) p.x() *= 1 + 0.1 * (frame - 8);
        BOOST_TEST(difference(readMesh(scene.at("out." + std::to_string(frame) + ".ply")).points, expected) < 1e-6);
    }
    BOOST_TEST(!std::filesystem::exists(scene.at("out.12.ply")));
    // One bad frame and none is written.
    writeMesh(test::box(Vec3d(-1), Vec3d(1)), scene.at("posed.0010.obj"));
    expectRefusal(scene,
                  {"deform", scene.at("cage.obj"), scene.at("posed.%04d.obj"), scene.at("model.obj"), "-o",
                   scene.at("next.%d.ply")},
                  "posed.0010.obj: it has 8 points, 0 triangles and 6 quads; the cage");
}

BOOST_AUTO_TEST_CASE(points_in_another_order)
{
    Scene scene;
    std::mt19937 random(1);
    scene.cage = test::lopsided(scene.cage);
    const std::string cage = scene.at("cage.obj"), model = scene.at("model.obj"), out = scene.at("out.obj");
    const auto posedAs = [](Mesh mesh) {
        for (Vec3d& p : mesh.points) p = Vec3d(openvdb::Vec3s(Vec3d(1.5 * p.x() + 0.25 * p.y(), p.y(), p.z())));
        return mesh;
    };
    const auto posedBy = [&](const std::string& posed, bool isReordered) {
        const auto result = runCommand({command, "deform", cage, posed, model, "-o", out, "--inversions"});
        BOOST_TEST(result.status == 0, result.err);
        const std::string said =
            "  " + posed + ": the points are in another order than the cage's; matched by the faces\n";
        BOOST_TEST((result.err.find(said) != std::string::npos) == isReordered, result.err);
        BOOST_TEST(result.out == posed + ": a valid cage, 0 of 2 triangles inverted\n"); // by the faces of the cage
        return test::readText(out);
    };
    Mesh triangles = scene.cage;
    triangles.triangles = triangulate(scene.cage);
    triangles.quads.clear();
    for (const Mesh& rest : {scene.cage, triangles}) {
        writeMesh(rest, cage);
        const Mesh posed = posedAs(rest);
        writeMesh(posed, scene.at("posed.obj"));
        const std::string expected = posedBy(scene.at("posed.obj"), false);
        writeMesh(test::withFacesShuffled(posed, random), scene.at("faces.obj"));
        BOOST_TEST((posedBy(scene.at("faces.obj"), false) == expected));
        for (const char* const name : {"a.obj", "a.off", "a.ply", "a.stl"}) {
            const bool isStl = name == std::string("a.stl");
            if (isStl && !rest.quads.empty()) continue;
            writeMesh(test::reordered(posed, random), scene.at(name));
            BOOST_TEST((posedBy(scene.at(name), true) == expected), name);
        }
    }
    // A frame of several.
    for (int frame = 8; frame <= 11; ++frame) {
        writeMesh(frame == 9 ? test::reordered(posedAs(triangles), random) : posedAs(triangles),
                  scene.at("posed." + std::string(frame < 10 ? "000" : "00") + std::to_string(frame) + ".obj"));
    }
    const std::string frames = scene.at("posed.%04d.obj"), outs = scene.at("out.%d.obj");
    const auto sequence = runCommand({command, "deform", cage, frames, model, "-o", outs});
    BOOST_TEST(sequence.status == 0, sequence.err);
    BOOST_TEST(sequence.err.find("  " + frames + ": 1 of 4 frames: the points are in another order") !=
                   std::string::npos,
               sequence.err);
    BOOST_TEST(test::readText(scene.at("out.8.obj")) == test::readText(scene.at("out.9.obj")));
    const auto compared =
        runCommand({command, "deform", cage, scene.at("a.stl"), model, "-o", scene.at("sheet.png"), "--compare"});
    BOOST_TEST(compared.err.find("a.stl: the points are in another order") != std::string::npos, compared.err);

    // No face tells which corner of a box is which.
    writeMesh(test::box(Vec3d(-2), Vec3d(2)), cage);
    writeMesh(test::reordered(test::box(Vec3d(-2), Vec3d(2)), random), scene.at("box.obj"));
    std::filesystem::remove(out);
    expectRefusal(scene, {"deform", cage, scene.at("box.obj"), model, "-o", out},
                  scene.at("box.obj") + ": its points are in another order than the cage's, and its faces do not tell "
                                        "which is which; keep the order");
    expectRefusal(scene, {"deform", cage, scene.at("box.obj"), model, "-o", scene.at("b.png"), "--compare"},
                  scene.at("box.obj") + ": its points are in another order");
}

BOOST_AUTO_TEST_CASE(tells_what_is_outside_and_what_crosses)
{
    const Scene scene;
    const std::string model = scene.at("model.obj"), cage = scene.at("cage.obj"), weights = scene.at("w.npy");
    const auto bound = [&] { return runCommand({command, "bind", cage, model, "-o", weights}).err; };
    BOOST_TEST(bound().find("  ") == std::string::npos);
    Mesh crossing = scene.cage;
    crossing.points[0] = Vec3d(0, 0, -5); // through the other side, and over points of the model
    writeMesh(crossing, cage);
    CheckOptions options;
    options.measure = false;
    const CageCheck check = checkCage(crossing, scene.model, options);
    BOOST_TEST(check.selfIntersections > 1);
    BOOST_TEST(check.modelVerticesOutside > 0);
    const std::string line = "\n  " + std::to_string(check.modelVerticesOutside) +
                             " of 4 points are not inside the cage; the cage has " +
                             std::to_string(check.selfIntersections) + " self-intersections\n";
    const std::string said = bound();
    BOOST_TEST(said.find(line) != std::string::npos, said + " lacks " + line);
    const auto posed = runCommand({command, "deform", cage, cage, model, "-o", scene.at("out.obj")});
    BOOST_TEST(posed.err.find(line) != std::string::npos, posed.err);
    const auto quiet = runCommand({command, "bind", cage, model, "-o", weights, "-q"});
    BOOST_TEST(quiet.err == "");
}

BOOST_AUTO_TEST_CASE(a_walk_without_inverted_triangles)
{
    const TemporaryFolder folder;
    const std::string creature = std::string(VDBCAGE_MODELS) + "/creature.obj", cage = folder / "cage.obj";
    BOOST_TEST(runCommand({command, "make", creature, "-o", cage, "-q"}).status == 0);
    const auto walk = runCommand({VDBCAGE_WALK, cage, folder / "walk"});
    BOOST_REQUIRE_MESSAGE(walk.status == 0, walk.err);
    const Mesh whole = readMesh(creature);
    Mesh part; // of the triangles, each with points of its own
    const std::vector<openvdb::Vec3I> triangles = triangulate(whole);
    for (std::size_t i = 0; i < triangles.size(); i += 8) {
        const auto first = static_cast<openvdb::Index32>(part.points.size());
        part.triangles.emplace_back(first, first + 1, first + 2);
        for (int k = 0; k < 3; ++k) part.points.push_back(whole.points[triangles[i][k]]);
    }
    writeMesh(part, folder / "part.ply");
    const auto result = runCommand({command, "deform", cage, folder / "walk/walk.%04d.obj", folder / "part.ply", "-o",
                                    folder / "out.%04d.ply", "--coordinates", "green", "--inversions"});
    BOOST_TEST(result.status == 0, result.err);
    std::string expected;
    for (const char* frame : {"00", "01", "02", "03", "04", "05", "06", "07", "08", "09", "10", "11"}) {
        expected +=
            folder / (std::string("walk/walk.00") + frame + ".obj: a valid cage, 0 of 4632 triangles inverted\n");
    }
    BOOST_TEST(result.out == expected);
}

BOOST_AUTO_TEST_CASE(counts_inverted_triangles)
{
    const Scene scene;
    Mesh mirrored = scene.cage;
    for (Vec3d& p : mirrored.points) p.x() *= -1;
    writeMesh(mirrored, scene.at("mirrored.obj"));
    const auto result = runCommand({command, "deform", scene.at("cage.obj"), scene.at("mirrored.obj"),
                                    scene.at("model.obj"), "-o", scene.at("out.obj"), "--inversions", "-q"});
    BOOST_TEST(result.status == 0, result.err);
    BOOST_TEST(result.err == "");
    BOOST_TEST(result.out == scene.at("mirrored.obj") + ": NOT a valid cage, 2 of 2 triangles inverted\n");
}

BOOST_AUTO_TEST_CASE(wrong_pairs)
{
    const Scene scene;
    const std::string cage = scene.at("cage.obj"), model = scene.at("model.obj"), posed = scene.at("posed.0009.obj"),
                      weights = scene.at("w.npy"), out = scene.at("out.obj");
    BOOST_TEST(runCommand({command, "bind", cage, model, "-o", weights, "-q"}).status == 0);
    expectRefusal(scene, {"deform", posed, cage, model, "-o", out, "--weights", weights}, "made for another cage");
    expectRefusal(scene, {"deform", cage, posed, cage, "-o", out, "--weights", weights}, "made for another model");
    expectRefusal(scene, {"deform", cage, posed, model, "-o", out, "--weights", weights, "--coordinates", "green"},
                  "has mvc coordinates; --coordinates asks for green");
    expectRefusal(scene, {"deform", cage, posed, model, "-o", out, "--weights", model}, "not a weights file");
    expectRefusal(scene, {"deform", cage, model, model, "-o", out}, "model.obj: it has 4 points");
    expectRefusal(scene, {"deform", cage, posed, model, "-o", model}, "would be overwritten");
    expectRefusal(scene, {"deform", cage, posed, model, "-o", scene.at("out.%d.obj")}, "must have a frame number");
    expectRefusal(scene, {"deform", cage, scene.at("no.%d.obj"), model, "-o", scene.at("out.%d.obj")},
                  "no file of this");
    expectRefusal(scene, {"deform", cage, posed, model, "-o", out, "--coordinates", "best"}, test::thereAreFamilies());
    expectRefusal(scene, {"bind", cage, model, "-o", scene.at("w.txt")}, ".npy");
    expectRefusal(scene, {"bind", model, model, "-o", scene.at("v.npy")}, "model.obj: it is not closed");
    writeMesh(test::box(Vec3d(1), Vec3d(3)), scene.at("outside.obj"));
    for (const FamilyInfo& family : coordinateFamilies()) {
        if (family.isEverywhere) continue;
        expectRefusal(scene,
                      {"bind", cage, scene.at("outside.obj"), "-o", scene.at("v.npy"), "--coordinates", family.name},
                      "outside.obj: " + std::string(family.name) + " coordinates are not defined at ");
    }
}

BOOST_AUTO_TEST_CASE(influence_pictures)
{
    const Scene scene;
    writeMesh(test::sphere({}, 1.9, 8), scene.at("ball.obj"));
    const std::string picture = scene.at("picture.png");
    const auto draw = [&](const std::string& vertex) {
        const auto result =
            runCommand({command, "render", scene.at("ball.obj"), scene.at("cage.obj"), "-o", picture, "--size",
                        "200x200", "--influence", vertex, "--azimuth", "0", "--elevation", "0"});
        BOOST_TEST(result.status == 0, result.err);
        const draw::Picture read = test::readPng(picture);
        int redness = -255; // of the reddest pixel near the middle
        for (std::size_t y = 80; y < 120; ++y) {
            for (std::size_t x = 80; x < 120; ++x) {
                const std::uint8_t* pixel = &read.rgb[3 * (y * 200 + x)];
                redness = std::max(redness, int(pixel[0]) - int(pixel[2]));
            }
        }
        return redness;
    };
    // The cage's first point is at +z, in front of the middle, its last behind it.
    BOOST_TEST(draw("0") > 50);
    BOOST_TEST(draw(std::to_string(scene.cage.points.size() - 1)) < 20);
    std::filesystem::remove(picture);
    expectRefusal(scene, {"render", scene.at("ball.obj"), scene.at("cage.obj"), "-o", picture, "--influence", "9999"},
                  "9999 is not a vertex of the cage; 0 to 41 are");
    expectRefusal(scene, {"render", scene.at("ball.obj"), "-o", picture, "--influence", "0"}, "a model and its cage");
}

BOOST_AUTO_TEST_SUITE_END()
