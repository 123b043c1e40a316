#include <boost/test/unit_test.hpp>

#include <clocale>
#include <cmath>
#include <cstring>
#include <limits>
#include <locale>
#include <random>

#include <mesh/mesh_samples.h>
#include <support/temporary_folder.h>
#include <vdbcage/core/error.h>
#include <vdbcage/mesh/mesh_io.h>

using namespace vdbcage;
using namespace vdbcage::test;
using openvdb::Vec3d;

namespace {

double randomFinite(std::mt19937_64& random)
{
    for (;;) {
        const std::uint64_t bits = random();
        double value = 0;
        std::memcpy(&value, &bits, sizeof(value));
        if (std::isfinite(value)) return value;
    }
}

/// Every kind of double, in triangles; and squares, which stay quads, of every size.
Mesh randomMesh(unsigned seed, std::size_t points)
{
    std::mt19937_64 random(seed);
    Mesh mesh;
    for (std::size_t i = 0; i < points; ++i) {
        mesh.points.emplace_back(randomFinite(random), randomFinite(random), randomFinite(random));
    }
    mesh.points[0] = Vec3d(0.0, -0.0, 5e-324);
    mesh.points[1] = Vec3d(-1.7976931348623157e308, 1.7976931348623157e308, 2.2250738585072014e-308);
    mesh.points[2] = Vec3d(0.1, 1e-300, -1e300);
    std::uniform_int_distribution<openvdb::Index32> corner(0, static_cast<openvdb::Index32>(points - 1));
    for (std::size_t i = 0; i < 2 * points; ++i) {
        mesh.triangles.emplace_back(corner(random), corner(random), corner(random));
    }
    for (int i = 0; i < 100; ++i) {
        const double size = std::ldexp(1.0, static_cast<int>(random() % 2000) - 1000);
        const auto first = static_cast<openvdb::Index32>(mesh.points.size());
        mesh.points.insert(mesh.points.end(), {{0, 0, size}, {size, 0, size}, {size, size, size}, {0, size, size}});
        mesh.quads.emplace_back(first, first + 1, first + 2, first + 3);
    }
    return mesh;
}

/// Numbers as a German would write them, and worse.
class OddPunctuation : public std::numpunct<char> {
    char do_decimal_point() const override { return ','; }
    char do_thousands_sep() const override { return '.'; }
    std::string do_grouping() const override { return "\1"; }
};

/// Changes the C++ and, where the system has one with a comma, the C locale for a scope.
class OddLocale {
public:
    OddLocale() : previous_(std::locale::global(std::locale(std::locale::classic(), new OddPunctuation)))
    {
        for (const char* name : {"de_DE.UTF-8", "de_DE.utf8", "fr_FR.UTF-8"}) {
            if (std::setlocale(LC_NUMERIC, name)) break;
        }
    }
    ~OddLocale()
    {
        std::locale::global(previous_);
        std::setlocale(LC_NUMERIC, "C");
    }
    OddLocale(const OddLocale&) = delete;
    OddLocale& operator=(const OddLocale&) = delete;

private:
    std::locale previous_;
};

} // namespace

BOOST_AUTO_TEST_SUITE(mesh_io)

BOOST_AUTO_TEST_CASE(obj_off_and_ply_read_back_bit_equal, *boost::unit_test::label("property"))
{
    const TemporaryFolder folder;
    for (unsigned seed = 1; seed <= 5; ++seed) {
        const Mesh mesh = randomMesh(seed, 3000);
        for (const char* name : {"a.obj", "a.off", "a.ply", "A.OBJ", "A.Ply"}) {
            writeMesh(mesh, folder / name);
            BOOST_TEST(sameBits(readMesh(folder / name), mesh), name);
        }
    }
}

BOOST_AUTO_TEST_CASE(stl_reads_back_as_the_same_triangles_in_floats, *boost::unit_test::label("property"))
{
    const TemporaryFolder folder;
    std::mt19937_64 random(3);
    std::uniform_real_distribution<double> coordinate(-2, 2);
    for (int trial = 0; trial < 5; ++trial) {
        Mesh mesh;
        // Few different values: many points have the same place, and zero comes with both signs.
        for (int i = 0; i < 200; ++i) {
            const auto value = [&] {
                return trial % 2 == 0 ? std::round(coordinate(random)) * 0.1 : coordinate(random);
            };
            mesh.points.emplace_back(value(), value(), value());
        }
        for (int i = 0; i < 5000; ++i) mesh.triangles.emplace_back(random() % 200, random() % 200, random() % 200);
        writeMesh(mesh, folder / "a.stl");
        const Mesh back = readMesh(folder / "a.stl");
        BOOST_TEST_REQUIRE(back.triangles.size() == mesh.triangles.size());
        for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
            for (int corner = 0; corner < 3; ++corner) {
                const Vec3d& wanted = mesh.points[mesh.triangles[i][corner]];
                const Vec3d& got = back.points[back.triangles[i][corner]];
                for (int axis = 0; axis < 3; ++axis) BOOST_TEST_REQUIRE(got[axis] == double(float(wanted[axis])));
            }
        }
        // Corners with equal coordinates are one point: compared with all pairs.
        for (std::size_t i = 0; i < back.points.size(); ++i) {
            for (std::size_t j = 0; j < i; ++j) BOOST_TEST_REQUIRE((back.points[i] != back.points[j]));
        }
    }
}

BOOST_AUTO_TEST_CASE(stl_splits_quads_by_the_diagonal_of_corners_0_and_2)
{
    Mesh mesh = pyramid();
    mesh.triangles.clear();
    const Mesh back = detail::parseStl(write(detail::writeStl, mesh), "a.stl").mesh;
    BOOST_REQUIRE(back.triangles.size() == 2U);
    const auto place = [&](std::size_t triangle, int corner) { return back.points[back.triangles[triangle][corner]]; };
    BOOST_CHECK((place(0, 0) == mesh.points[4] && place(0, 1) == mesh.points[3] && place(0, 2) == mesh.points[2]));
    BOOST_CHECK((place(1, 0) == mesh.points[4] && place(1, 1) == mesh.points[2] && place(1, 2) == mesh.points[1]));
}

BOOST_AUTO_TEST_CASE(stl_has_unit_normals_at_every_size)
{
    for (const float size : {1e-40F, 1.0F, 3e38F}) {
        Mesh mesh;
        mesh.points = {{-double(size), 0, 0}, {double(size), 0, 0}, {0, double(size), 0}};
        mesh.triangles = {{0, 1, 2}};
        const std::string bytes = write(detail::writeStl, mesh);
        BOOST_TEST(bytes.size() == 134U);
        float normal[3];
        std::memcpy(normal, bytes.data() + 84, sizeof(normal));
        BOOST_TEST(normal[0] == 0);
        BOOST_TEST(normal[1] == 0);
        BOOST_TEST(normal[2] == 1);
    }
}

BOOST_AUTO_TEST_CASE(the_locale_does_not_matter)
{
    const TemporaryFolder folder;
    const Mesh mesh = randomMesh(9, 2000);
    std::vector<std::string> expected;
    const auto writers = {detail::writeObj, detail::writeOff, detail::writePly};
    for (const auto writer : writers) expected.push_back(write(writer, mesh));
    const OddLocale odd;
    std::size_t i = 0;
    for (const auto writer : writers) BOOST_TEST((write(writer, mesh) == expected[i++]));
    for (const char* name : {"a.obj", "a.off", "a.ply"}) {
        writeMesh(mesh, folder / name);
        BOOST_TEST(sameBits(readMesh(folder / name), mesh), name);
    }
    for (const Sample& sample : samples()) BOOST_TEST(faceCount(sample.parse(sample.bytes, "a").mesh) >= 5U);
    const auto plain = [](const Error& error) {
        return std::string(error.what()).find("1000000") != std::string::npos;
    };
    BOOST_CHECK_EXCEPTION(detail::parseObj("v 0 0 0\nf 1 1 1000000\n", "a"), IoError, plain);
    Mesh large = mesh;
    large.triangles[0][0] = 1000000;
    BOOST_CHECK_EXCEPTION(writeMesh(large, folder / "b.obj"), InputError, plain);
}

BOOST_AUTO_TEST_CASE(every_sample_is_the_same_pyramid)
{
    for (const Sample& sample : samples()) {
        const auto [mesh, summary] = sample.parse(sample.bytes, "a");
        BOOST_TEST_CONTEXT(sample.kind)
        {
            BOOST_TEST(mesh.points.size() == 5U);
            BOOST_TEST(summary.degenerateFaces == 0U);
            BOOST_TEST(summary.ignoredElements == 0U);
            BOOST_TEST(summary.polygons == 0U);
            if (std::strcmp(sample.extension, ".stl") == 0) {
                BOOST_TEST(mesh.triangles.size() == 6U);
            } else {
                BOOST_TEST(sameBits(mesh, pyramid()));
            }
        }
    }
}

BOOST_AUTO_TEST_CASE(extensions_are_known)
{
    for (const char* name : {"a.obj", "a.off", "a.ply", "a.stl", "b/a.OBJ", "a.b.Stl"}) {
        BOOST_CHECK_NO_THROW(detail::requireMeshExtension(name));
    }
    for (const char* name : {"a", "a.ob", "a.objx", "obj", ".obj"})
        BOOST_CHECK_THROW(detail::requireMeshExtension(name), IoError);
}

BOOST_AUTO_TEST_CASE(what_cannot_be_written_leaves_no_file)
{
    const TemporaryFolder folder;
    const auto refuses = [&](const Mesh& mesh, const char* name, const std::string& text) {
        BOOST_CHECK_EXCEPTION(writeMesh(mesh, folder / name), Error, [&](const Error& error) {
            const std::string line = error.what();
            BOOST_TEST_MESSAGE(line);
            return line.find((folder / name).string()) == 0 && line.find(text) != std::string::npos &&
                   line.find('\n') == std::string::npos;
        });
        BOOST_TEST(folder.entries() == 0U);
    };
    Mesh mesh = pyramid();
    mesh.points[2].y() = 1e39;
    refuses(mesh, "a.stl", "the y coordinate of point 2 is 1e+39");
    BOOST_CHECK_THROW(writeMesh(mesh, folder / "a.stl"), IoError);
    refuses(pyramid(), "a.gltf", "ends in \".gltf\"");
    refuses(pyramid(), "a", "has no extension");
    refuses(pyramid(), "no/such/folder/a.obj", "does not exist");
    mesh = pyramid();
    mesh.points.emplace_back(0, std::nan(""), 0); // used by no face, but it would not read back
    refuses(mesh, "a.obj", "point 5 is not finite");
    mesh = pyramid();
    mesh.quads[0][3] = 5;
    refuses(mesh, "a.ply", "a face uses point 5");
    refuses(Mesh(), "a.off", "no faces");
}

BOOST_AUTO_TEST_CASE(writing_replaces_a_file_and_a_failed_one_leaves_it)
{
    const TemporaryFolder folder;
    writeMesh(pyramid(), folder / "a.stl");
    const std::string before = readText(folder / "a.stl");
    Mesh mesh = pyramid();
    mesh.points[2].y() = 1e39;
    BOOST_CHECK_THROW(writeMesh(mesh, folder / "a.stl"), IoError);
    BOOST_TEST((readText(folder / "a.stl") == before));
    BOOST_TEST(folder.entries() == 1U);
}

BOOST_AUTO_TEST_CASE(files_hold_what_as_written_says)
{
    const TemporaryFolder folder;
    std::mt19937_64 random(5);
    std::uniform_real_distribution<double> share(0, 1);
    Mesh mesh = pyramid();
    for (Vec3d& p : mesh.points) p += 1000 * Vec3d(share(random), share(random), share(random));
    for (const char* name : {"a.obj", "a.off", "a.ply", "a.stl", "a.STL"}) {
        const std::filesystem::path path = folder / name;
        const Mesh said = asWritten(mesh, path);
        writeMesh(mesh, path);
        const Mesh read = readMesh(path);
        const auto cornersOf = [](const Mesh& of) {
            std::vector<Vec3d> corners;
            for (const openvdb::Vec3I& t : triangulate(of)) {
                for (int i = 0; i < 3; ++i) corners.push_back(of.points[t[i]]);
            }
            return corners;
        };
        BOOST_TEST_CONTEXT(name)
        {
            BOOST_TEST((cornersOf(read) == cornersOf(said)));
            BOOST_TEST((said.points == mesh.points) == (precisionOf(path) == Precision::float64));
        }
    }
    mesh.points[1].z() = -1e39;
    BOOST_CHECK_THROW(asWritten(mesh, "a.stl"), IoError);
    BOOST_CHECK_THROW(asWritten(mesh, "a.xyz"), IoError);
    BOOST_CHECK_THROW(precisionOf("a"), IoError);
}

BOOST_AUTO_TEST_CASE(moved_obj_keeps_all_but_positions_and_normals)
{
    const TemporaryFolder folder;
    const std::string before = "# a tent\r\nmtllib my.mtl\\\no tent\n",
                      between = "vt 0 0\nvt 1 0.5\n\ng left right\nusemtl red v 1 2 3\ns 1\n"
                                "f 1/1/1 2/2/1 3/1/1 4/2/1 5//1 # five\nf -5/1/2 -4/1/2 -2\nl 1 2\n";
    test::writeText(folder / "model.obj", before + "v 0 0 0\nv  2 0 0 0.5 0.25 1\nv 2 2 0\\\n 1\nv 1 3 0\n\tv 0 2 0\n" +
                                              "vn 0 0 1\nvn 0 1 0\nvn 1 0 0\n" + between);
    // A quarter turn about x: (x, y, z) to (x, -z, y).
    std::vector<Vec3d> points = readMesh(folder / "model.obj").points;
    for (Vec3d& p : points) p = Vec3d(p.x(), -p.z(), p.y());
    writeMoved(folder / "model.obj", points, folder / "moved.obj");
    BOOST_TEST(test::readText(folder / "moved.obj") ==
               before + "v 0 -0 0\nv  2 -0 0 0.5 0.25 1\nv 2 -0 2\\\n 1\nv 1 -0 3\n\tv 0 -0 2\n" +
                   "vn 0 -1 0\nvn 0 0 1\nvn 1 0 0\n" + between);
    BOOST_TEST((readMesh(folder / "moved.obj").points == points));

    writeMoved(folder / "model.obj", points, folder / "moved.ply");
    BOOST_TEST((readMesh(folder / "moved.ply").points == points));
    points.pop_back();
    BOOST_CHECK_THROW(writeMoved(folder / "model.obj", points, folder / "a.obj"), InputError);
    points.emplace_back(0, std::nan(""), 0);
    BOOST_CHECK_THROW(writeMoved(folder / "model.obj", points, folder / "a.obj"), InputError);
    BOOST_CHECK_THROW(writeMoved(folder / "none.obj", points, folder / "a.obj"), Error);
    BOOST_TEST(!std::filesystem::exists(folder / "a.obj"));
}

BOOST_AUTO_TEST_SUITE_END()
