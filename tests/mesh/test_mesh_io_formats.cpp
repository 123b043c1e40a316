// What each format allows: every text here is a file that some program writes.

#include <boost/test/unit_test.hpp>

#include <cmath>
#include <limits>
#include <numeric>
#include <sstream>

#include <mesh/mesh_samples.h>
#include <support/shapes.h>
#include <vdbcage/core/detail/pi.h>
#include <vdbcage/core/error.h>
#include <vdbcage/mesh/io/polygon_soup.h>
#include <vdbcage/mesh/io/polygon_splitter.h>

using namespace vdbcage;
using namespace vdbcage::test;
using openvdb::Vec3d;
using openvdb::Vec3I;
using openvdb::Vec4I;

namespace {

Mesh obj(const std::string& text)
{
    return detail::parseObj(text, "a.obj").mesh;
}

Mesh off(const std::string& text)
{
    return detail::parseOff(text, "a.off").mesh;
}

Mesh ply(const std::string& text)
{
    return detail::parsePly(text, "a.ply").mesh;
}

Mesh stl(const std::string& text)
{
    return detail::parseStl(text, "a.stl").mesh;
}

const std::string threePoints = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";

std::string plyHeader(const std::string& format, const std::string& elements)
{
    return "ply\nformat " + format + " 1.0\n" + elements + "end_header\n";
}

const std::string vertexElement = "element vertex 3\nproperty float x\nproperty float y\nproperty float z\n";

std::string binaryStl(const std::string& header, std::uint32_t announced, const std::vector<float>& coordinates)
{
    std::string bytes = header + std::string(80 - header.size(), ' ') + littleEndian(announced);
    for (std::size_t i = 0; i < coordinates.size(); ++i) {
        if (i % 9 == 0) bytes += std::string(12, '\0');
        bytes += littleEndian(coordinates[i]);
        if (i % 9 == 8) bytes += std::string(2, '\0');
    }
    return bytes;
}

} // namespace

BOOST_AUTO_TEST_SUITE(mesh_io_formats)

BOOST_AUTO_TEST_CASE(line_ends_and_byte_order_mark)
{
    for (const Sample& sample : samples()) {
        const std::string kind = sample.kind;
        if (kind.find("obj") != 0 && kind.find("off") != 0 && kind.find("ascii") != 0) continue;
        const Mesh expected = sample.parse(sample.bytes, "a").mesh;
        for (const char* lineEnd : {"\r\n", "\r", "\n\n", " \t\n"}) {
            const std::string text = replaced(sample.bytes, "\n", lineEnd);
            // A PLY header ends exactly one line end behind end_header, but blank lines before and behind do no harm.
            BOOST_TEST(sameBits(sample.parse(text, "a").mesh, expected), kind);
        }
        BOOST_TEST(sameBits(sample.parse("\xEF\xBB\xBF" + sample.bytes, "a").mesh, expected), kind);
        BOOST_TEST(sameBits(sample.parse(sample.bytes + "\n \r\n\n", "a").mesh, expected), kind);
        const std::string noLastLineEnd = sample.bytes.substr(0, sample.bytes.size() - 1);
        BOOST_TEST(sameBits(sample.parse(noLastLineEnd, "a").mesh, expected), kind);
    }
}

BOOST_AUTO_TEST_CASE(numbers)
{
    const Mesh mesh = obj("v +1.5 -2. .5\nv 1e-300 1E+300 -1e-400\nv 1e-320 0.1 179769313486231570000e288\n"
                          "v 0e999999999999 1e-99999999999999999999 0." +
                          std::string(400, '0') + "1e-1\nf 1 2 3\n");
    BOOST_CHECK(mesh.points[0] == Vec3d(1.5, -2, 0.5));
    BOOST_CHECK(mesh.points[1] == Vec3d(1e-300, 1e300, 0));
    BOOST_TEST(std::signbit(mesh.points[1].z()));
    BOOST_CHECK(mesh.points[2] == Vec3d(1e-320, 0.1, std::numeric_limits<double>::max()));
    BOOST_CHECK(mesh.points[3] == Vec3d(0, 0, 0));
    // Halfway between two doubles but for the last digit: rounded correctly.
    const Mesh halfway =
        obj("v 9007199254740993 9007199254740993.0000000000000000000000000001 1\n" + threePoints + "f 2 3 4\n");
    BOOST_TEST(halfway.points[0].x() == 9007199254740992.0);
    BOOST_TEST(halfway.points[0].y() == 9007199254740994.0);
    // A number outside the range of exponents that its mantissa brings back, both ways.
    const std::string zeros(350, '0');
    const Mesh shifted = obj("v 1" + zeros + "e-350 0." + zeros + "1e351 1\n" + threePoints + "f 2 3 4\n");
    BOOST_CHECK(shifted.points[0] == Vec3d(1, 1, 1));
}

BOOST_AUTO_TEST_CASE(obj_corners_in_every_form)
{
    const std::string before = "v 9 9 9\n" + threePoints + "v 1 1 0\nvt 0 0\nvn 0 0 1\nf 1 4 5\n";
    for (const char* face :
         {"f 2 3 4", "f 2/1 3/1 4/1", "f 2//1 3//1 4//1", "f 2/1/1 3/1/1 4/1/1", "f -4 -3 -2",
          "f -4/-1/-1 -3/-1/-1 -2/-1/-1", "f 2/1/ 3/1/ 4/1/", "f 2// 3// 4//", "f 2/ 3/ 4/", "\t f\t2  3 4   # a face",
          "f 2 \\\n 3 \\\r\n 4", "f 2\\\n3 4", "fo 2 3 4", "f +2 +3 +4"}) {
        for (const char* end : {"\n", "", "\r\n"}) {
            const Mesh mesh = obj(before + face + end);
            BOOST_REQUIRE_MESSAGE(mesh.triangles.size() == 2U, face);
            BOOST_CHECK_MESSAGE(mesh.triangles[1] == Vec3I(1, 2, 3), face);
        }
    }
}

BOOST_AUTO_TEST_CASE(obj_relative_corners_count_from_the_face_and_faces_may_come_first)
{
    const Mesh mesh = obj(threePoints + "f -3 -2 -1\nf 4 5 6\nv 0 0 1\nv 1 0 1\nv 0 1 1\nf -3 -2 -1\nf -6 -5 -4\n");
    const std::vector<Vec3I> expected = {{0, 1, 2}, {3, 4, 5}, {3, 4, 5}, {0, 1, 2}};
    BOOST_CHECK(mesh.triangles == expected);
}

BOOST_AUTO_TEST_CASE(obj_without_a_last_line_end_is_whole_if_all_its_points_are_used)
{
    BOOST_CHECK_NO_THROW(obj(threePoints + "f 1 2 3"));
    BOOST_CHECK_NO_THROW(obj(threePoints + "v 9 9 9\nf 1 2 3\n"));
    BOOST_CHECK_NO_THROW(obj(threePoints + "v 9 9 9\np 4\nf 1 2 3")); // a point may serve another element
    BOOST_CHECK_THROW(obj(threePoints + "v 9 9 9\nf 1 2 3"), IoError);
}

BOOST_AUTO_TEST_CASE(obj_weights_and_colours_are_not_read)
{
    const Mesh mesh = obj("v 0 0 0 2\nv 1 0 0 0.5 0.5 0.5\nv 0 1 0 1 0 nan 0.5 # red\nf 1 2 3\n");
    BOOST_CHECK(mesh.points[1] == Vec3d(1, 0, 0));
    BOOST_CHECK(mesh.points[2] == Vec3d(0, 1, 0));
}

BOOST_AUTO_TEST_CASE(obj_other_statements_are_ignored_and_elements_counted)
{
    const auto [mesh, summary] = detail::parseObj(
        "# by hand \\\nmtllib C:\\models\\\no a\ng a b\ns off\nusemtl stone #1\n" + threePoints +
            "vp 1 2\nvt 1 1\nvn 0 0 1\np 1 2 3\nl 1 2 \\\n 3\nf 1 2\nf 3\ncurv 0 1 1 \\\n2\nparm u 0 \\\n"
            "1 2\nend\nf 1 2 3\nd_interp on\nmy_own-word.2 77 \"\x01\xFF\n",
        "a.obj");
    BOOST_TEST(mesh.points.size() == 3U);
    BOOST_TEST(mesh.triangles.size() == 1U);
    BOOST_TEST(summary.ignoredElements == 5U); // p, l, curv and two faces without area
}

BOOST_AUTO_TEST_CASE(polygons_are_split_and_bad_faces_counted)
{
    const auto [mesh, summary] = detail::parseObj("v 0 0 0\nv 2 0 0\nv 2 2 0\nv 0 2 0\nv 0.5 1 0\n"
                                                  "f 1 2 3 4\n"    // convex: stays
                                                  "f 1 2 3 5\n"    // convex as well
                                                  "f 1 2 5 4\n"    // has an inward corner: two triangles
                                                  "f 1 2 3 4 5\n"  // five corners: three triangles
                                                  "f 1 1 2\n"      // no area
                                                  "f 1 1 2 2\n"    // no area
                                                  "f 1 2 3 3\n"    // repeats a corner, but has an area
                                                  "f 1 2 3 3 4\n", // the same with five corners
                                                  "a.obj");
    BOOST_TEST(mesh.quads.size() == 4U);
    BOOST_TEST(mesh.triangles.size() == 1U + 2U + 3U + 3U);
    BOOST_TEST(summary.polygons == 2U);
    BOOST_TEST(summary.degenerateFaces == 4U);
    BOOST_TEST(summary.ignoredElements == 0U);
}

namespace {

/// Faces over points on a circle: each of `count` corners that follow each other, from the given one.
MeshFile onCircle(const std::vector<std::pair<std::size_t, std::size_t>>& firstAndCount)
{
    constexpr std::size_t points = 5000;
    detail::PolygonSoup soup;
    for (std::size_t i = 0; i < points; ++i) {
        const double angle = 2 * detail::pi * static_cast<double>(i) / static_cast<double>(points);
        soup.points.emplace_back(std::cos(angle), std::sin(angle), 0);
    }
    for (const auto& [first, count] : firstAndCount) {
        std::vector<openvdb::Index32> face;
        for (std::size_t i = 0; i < count; ++i) face.push_back(static_cast<openvdb::Index32>((first + i) % points));
        soup.addFace(face.data(), count);
    }
    return detail::toMesh(std::move(soup), "circle");
}

} // namespace

BOOST_AUTO_TEST_CASE(equal_polygons_have_their_alternatives_once)
{
    std::string text = "OFF\n64 60 0\n";
    for (int i = 0; i < 64; ++i) {
        text += std::to_string(std::cos(0.098174770424681 * i)) + ' ' +
                std::to_string(std::sin(0.098174770424681 * i)) + " 0\n";
    }
    for (int face = 0; face < 60; ++face) { // from any start, in either direction
        text += "64";
        for (int i = 0; i < 64; ++i) {
            text += ' ' + std::to_string((7 * face + (face % 2 == 0 ? i : 64 - i)) % 64);
        }
        text += '\n';
    }
    const auto [mesh, summary] = detail::parseOff(text, "a.off");
    BOOST_TEST(mesh.triangles.size() == 60U * 62U); // they stay faces
    BOOST_TEST(mesh.alternatives.size() == 64U * 62U);
    BOOST_TEST(summary.polygons == 60U);
    BOOST_TEST(summary.alternateCorners == 64U);
    // The same corners in another order are another polygon.
    const std::string five = "OFF\n5 3 0\n0 0 0\n2 0 0\n3 1 0\n2 2 0\n0 2 0\n";
    BOOST_TEST(off(five + "5 0 1 2 3 4\n5 4 3 2 1 0\n5 2 3 4 0 1\n").alternatives.size() == 10U);
    BOOST_TEST(off(five + "5 0 1 2 3 4\n5 4 3 2 1 0\n5 0 2 1 3 4\n").alternatives.size() == 20U);
}

BOOST_AUTO_TEST_CASE(faces_of_more_than_64_corners_are_there_as_a_fan_and_as_ears)
{
    // Convex ones are split as a fan.
    const auto [mesh, summary] = onCircle({{0, 65}, {10, 65}, {0, 64}, {0, 5}});
    BOOST_TEST(mesh.alternatives.size() == 2U * 63U + 64U * 62U + 10U);
    BOOST_TEST(summary.alternateCorners == 64U);
    std::vector<Vec3I> ears;
    std::vector<openvdb::Index32> first(65);
    std::iota(first.begin(), first.end(), openvdb::Index32(0));
    detail::PolygonSplitter(mesh.points).splitByEars(first.data(), first.size(), ears);
    BOOST_TEST_REQUIRE(ears.size() == 63U);
    for (std::size_t i = 0; i < ears.size(); ++i) BOOST_REQUIRE((mesh.alternatives[i] == ears[i]));
    BOOST_REQUIRE((mesh.triangles[63] == Vec3I(10, 11, 12)));
    BOOST_TEST(!std::equal(ears.begin(), ears.end(), mesh.triangles.begin()));
    // A star has no fan that divides it.
    for (const std::size_t corners : {66U, 200U, 5000U}) {
        detail::PolygonSoup soup;
        std::vector<openvdb::Index32> face;
        for (std::size_t i = 0; i < corners; ++i) {
            const double angle = 2 * detail::pi * double(i) / double(corners), radius = i % 2 == 0 ? 1 : 0.5;
            soup.points.emplace_back(radius * std::cos(angle), radius * std::sin(angle), 0);
            face.push_back(openvdb::Index32((i + 7) % corners));
        }
        soup.addFace(face.data(), corners);
        const Mesh star = detail::toMesh(std::move(soup), "star").mesh;
        BOOST_TEST(star.triangles.size() == corners - 2);
        BOOST_TEST_REQUIRE(star.alternatives.size() == corners - 2);
        for (std::size_t i = 0; i < star.alternatives.size(); ++i) {
            BOOST_REQUIRE((star.alternatives[i] == Vec3I(face[0], face[i + 1], face[i + 2])));
        }
    }
}

BOOST_AUTO_TEST_CASE(alternatives_keep_within_their_budget)
{
    // Too many of 64 corners; copies take nothing; the smaller ones have theirs.
    std::vector<std::pair<std::size_t, std::size_t>> faces;
    const std::size_t fit = detail::mostAlternates / (64 * 62);
    for (std::size_t i = 0; i < fit; ++i) faces.emplace_back(i, 64);
    faces.emplace_back(0, 64);
    {
        const auto [mesh, summary] = onCircle(faces);
        BOOST_TEST(mesh.alternatives.size() == fit * 64 * 62);
        BOOST_TEST(summary.alternateCorners == 64U);
    }
    faces.emplace_back(fit, 64);
    faces.emplace_back(0, 65);
    faces.emplace_back(0, 5);
    faces.emplace_back(0, 20);
    const auto [mesh, summary] = onCircle(faces);
    BOOST_TEST(mesh.alternatives.size() == 10U + 20U * 18U + (fit + 2) * 62 + 63);
    BOOST_TEST(summary.alternateCorners == 63U);
    BOOST_TEST(mesh.triangles.size() == (fit + 2) * 62 + 63 + 3 + 18);
}

BOOST_AUTO_TEST_CASE(off_headers)
{
    const std::string points = "0 0 0\n1 0 0\n0 1 0\n";
    const std::string fullPoints = "0 0 0 0 0 1 0.5 0.5 0.5 1\n1 0 0 nan nan nan 255 0 0\n0 1 0 # none\n";
    for (const std::string& text :
         {"OFF\n3 1 0\n" + points + "3 0 1 2\n", "OFF 3 1 3\n" + points + "3 0 1 2", "3 1 0\n" + points + "3 0 1 2\n",
          "OFF3 1 0\n" + points + "3 0 1 2\n", "OFF\n3 1\n" + points + "3 0 1 2\n",
          "# first\nOFF # the kind\n# counts\n\n3 1 0 # counts\n#points\n" + points + "\n# faces\n3 0 1 2 # last\n#end",
          "OFF\n3 1 0\n" + points + "3 0 1 2 255 0 0\n", "OFF\n3 1 0\n" + points + "3 0 1 2 0.5 0.5 0.5 1.0\n",
          "COFF\n3 1 0\n" + fullPoints + "3 0 1 2 17\n", "NOFF\n3 1 0\n" + fullPoints + "3 0 1 2\n",
          "STOFF\n3 1 0\n" + fullPoints + "3 0 1 2\n", "CNOFF\n3 1 0\n" + fullPoints + "3 0 1 2\n",
          "STCNOFF\n3 1 0\n" + fullPoints + "3 0 1 2\n", "NCOFF\n3 1 0\n" + fullPoints + "3 0 1 2\n",
          "NCSTOFF\n3 1 0\n" + fullPoints + "3 0 1 2\n"}) {
        const Mesh mesh = off(text);
        BOOST_REQUIRE_MESSAGE(mesh.triangles.size() == 1U, text);
        BOOST_CHECK_MESSAGE(mesh.triangles[0] == Vec3I(0, 1, 2), text);
        BOOST_CHECK_MESSAGE(mesh.points[2] == Vec3d(0, 1, 0), text);
    }
}

BOOST_AUTO_TEST_CASE(off_records_may_go_over_line_ends)
{
    const Mesh mesh = off("OFF\n4\n1 0\n0\n0 0\n1\n0\n0\n1 1 0\n0 1 0\n4 0\n1 2\n3 255 0 0\n");
    BOOST_REQUIRE(mesh.quads.size() == 1U);
    BOOST_CHECK(mesh.quads[0] == Vec4I(0, 1, 2, 3));
}

BOOST_AUTO_TEST_CASE(off_faces_of_one_or_two_corners_are_ignored)
{
    const auto [mesh, summary] = detail::parseOff("OFF 3 3 0\n0 0 0\n1 0 0\n0 1 0\n1 0\n2 0 1\n3 0 1 2\n", "a.off");
    BOOST_TEST(mesh.triangles.size() == 1U);
    BOOST_TEST(summary.ignoredElements == 2U);
}

BOOST_AUTO_TEST_CASE(ply_of_every_type_and_order, *boost::unit_test::label("property"))
{
    struct Type {
        const char* name;
        int size; // below zero: floating
        bool isSigned;
    };
    const std::vector<Type> types = {
        {"char", 1, true},     {"uchar", 1, false},  {"short", 2, true},   {"ushort", 2, false}, {"int", 4, true},
        {"uint", 4, false},    {"float", -4, true},  {"double", -8, true}, {"int8", 1, true},    {"uint8", 1, false},
        {"int16", 2, true},    {"uint16", 2, false}, {"int32", 4, true},   {"uint32", 4, false}, {"float32", -4, true},
        {"float64", -8, true}, {"int64", 8, true},   {"uint64", 8, false}};
    const auto encode = [](const Type& type, int value, bool big) {
        std::string bytes;
        if (type.size == -4) bytes = littleEndian(float(value));
        if (type.size == -8) bytes = littleEndian(double(value));
        if (type.size > 0) bytes = littleEndian(std::int64_t(value)).substr(0, std::size_t(type.size));
        return big ? std::string(bytes.rbegin(), bytes.rend()) : bytes;
    };
    for (const Type& coordinate : types) {
        for (const Type& count : types) {
            if (count.size < 0) continue;
            for (const Type& index : types) {
                for (const int kind : {0, 1, 2}) {
                    const int low = coordinate.isSigned ? -100 : 100;
                    const int points[9] = {low, 0, 1, 2, 3, 4, 5, low, 7};
                    std::string text = plyHeader(kind == 0   ? "ascii"
                                                 : kind == 1 ? "binary_little_endian"
                                                             : "binary_big_endian",
                                                 "element vertex 3\nproperty " + std::string(coordinate.name) +
                                                     " x\nproperty " + coordinate.name + " y\nproperty " +
                                                     coordinate.name + " z\nelement face 1\nproperty list " +
                                                     count.name + " " + index.name + " vertex_index\n");
                    if (kind == 0) {
                        for (int i = 0; i < 9; ++i) text += std::to_string(points[i]) + (i % 3 == 2 ? "\n" : " ");
                        text += "3 2 0 1\n";
                    } else {
                        for (const int value : points) text += encode(coordinate, value, kind == 2);
                        text += encode(count, 3, kind == 2);
                        for (const int value : {2, 0, 1}) text += encode(index, value, kind == 2);
                    }
                    const Mesh mesh = ply(text);
                    BOOST_TEST_REQUIRE(mesh.points.size() == 3U);
                    for (int i = 0; i < 9; ++i) {
                        BOOST_TEST_REQUIRE(mesh.points[std::size_t(i / 3)][i % 3] == double(points[i]));
                    }
                    BOOST_TEST_REQUIRE(mesh.triangles.size() == 1U);
                    BOOST_REQUIRE((mesh.triangles[0] == Vec3I(2, 0, 1)));
                }
            }
        }
    }
}

BOOST_AUTO_TEST_CASE(ply_other_elements_and_properties_are_skipped)
{
    const auto [mesh, summary] = detail::parsePly(
        plyHeader("ascii", "obj_info anything goes: format element\nelement camera 1\n"
                           "property float view\nproperty list uchar float matrix\nelement nothing 9\n" +
                               vertexElement +
                               "property uchar red\nproperty list int int lists\nelement face 2\n"
                               "property float quality\nproperty list uchar int texnumber\n"
                               "property list uchar uint vertex_indices\nelement edge 2\n"
                               "property int vertex1\nproperty int vertex2\n") +
            "0.5 3 1 2 3\n0 0 0 255 0\n1 0 0 255 2 7 7\n0 1 0 255 1 -9\n0.5 0 3 0 1 2\nnan 1 5 3 2 1 0\n"
            "0 1\n1 2\n",
        "a.ply");
    BOOST_CHECK(mesh.points[2] == Vec3d(0, 1, 0));
    const std::vector<Vec3I> expected = {{0, 1, 2}, {2, 1, 0}};
    BOOST_CHECK(mesh.triangles == expected);
    BOOST_TEST(summary.ignoredElements == 1U + 9U + 2U);
}

BOOST_AUTO_TEST_CASE(ply_with_faces_is_a_mesh_though_its_points_have_what_splats_have)
{
    const Mesh mesh = ply(plyHeader("ascii", vertexElement + "property float opacity\nproperty float scale_0\n"
                                                             "property float rot_0\nelement face 1\n"
                                                             "property list uchar int vertex_indices\n") +
                          "0 0 0 1 1 1\n1 0 0 1 1 1\n0 1 0 1 1 1\n3 0 1 2\n");
    BOOST_TEST(mesh.triangles.size() == 1U);
}

BOOST_AUTO_TEST_CASE(ply_faces_before_points_polygons_and_faces_without_area)
{
    const auto [mesh, summary] = detail::parsePly(
        plyHeader("ascii", "element face 4\nproperty list uchar int vertex_indices\n"
                           "element vertex 5\nproperty double z\nproperty double x\nproperty double y\n") +
            "5 0 1 2 3 4\n2 0 1\n0\n3 1 1 2\n7 0 0\n7 2 0\n7 2 2\n7 0 2\n7 -1 1\n",
        "a.ply");
    BOOST_CHECK(mesh.points[1] == Vec3d(2, 0, 7));
    BOOST_TEST(mesh.triangles.size() == 4U);
    BOOST_TEST(summary.polygons == 1U);
    BOOST_TEST(summary.degenerateFaces == 1U);
    BOOST_TEST(summary.ignoredElements == 2U);
}

BOOST_AUTO_TEST_CASE(ply_strips_keep_one_orientation)
{
    const Mesh mesh = ply(plyHeader("ascii", "element vertex 6\nproperty float x\nproperty float y\nproperty float z\n"
                                             "element tristrips 1\nproperty list int int vertex_indices\n") +
                          "0 0 0\n0 1 0\n1 0 0\n1 1 0\n2 0 0\n2 1 0\n13 0 1 2 3 3 5 -1 2 3 4 -1 0 1\n");
    // The square 0 1 2 3 as two; 3 3 5 only steers; then a strip of its own.
    const std::vector<Vec3I> expected = {{0, 1, 2}, {2, 1, 3}, {2, 3, 4}};
    BOOST_CHECK(mesh.triangles == expected);
}

BOOST_AUTO_TEST_CASE(ply_line_ends_of_a_binary_header)
{
    // The first byte of the body is a line feed, which must not be taken for a part of the header.
    const std::string body = "\x0A\x0B\x0C"
                             "\x01\x02\x03"
                             "\x04\x06\x08"
                             "\x03" +
                             std::string("\0\1\2", 3);
    const std::string header = "ply\nformat binary_little_endian 1.0\nelement vertex 3\nproperty uchar x\n"
                               "property uchar y\nproperty uchar z\nelement face 1\n"
                               "property list uchar uchar vertex_indices\nend_header\n";
    for (const char* lineEnd : {"\n", "\r", "\r\n"}) {
        const Mesh mesh = ply(replaced(header, "\n", lineEnd) + body);
        BOOST_CHECK(mesh.points[0] == Vec3d(10, 11, 12));
        BOOST_CHECK(mesh.triangles[0] == Vec3I(0, 1, 2));
    }
    BOOST_CHECK_NO_THROW(ply(header + body + "\r\n" + std::string(3, '\0')));
}

BOOST_AUTO_TEST_CASE(stl_binary_files_that_begin_like_ascii)
{
    for (const char* header : {"solid", "solid facet normal", "SOLID name\nfacet", "", "facet"}) {
        const Mesh mesh = stl(binaryStl(header, 1, {0, 0, 0, 1, 0, 0, 0, 1, 0}));
        BOOST_TEST(mesh.triangles.size() == 1U);
        BOOST_CHECK_NO_THROW(stl(binaryStl(header, 1, {0, 0, 0, 1, 0, 0, 0, 1, 0}) + std::string(10, '\0')));
    }
}

BOOST_AUTO_TEST_CASE(ply_with_colours_is_read_back_and_has_them_behind_each_point)
{
    const Mesh mesh = test::box({0.1, 0, -1}, {1, 2, 3});
    std::vector<PointColour> colours;
    for (std::size_t i = 0; i < mesh.points.size(); ++i) {
        colours.push_back({static_cast<std::uint8_t>(i), static_cast<std::uint8_t>(255 - i), 7});
    }
    std::ostringstream out;
    writeColouredPly(mesh, colours, out, "a.ply");
    const std::string bytes = out.str();
    const Mesh back = ply(bytes);
    BOOST_CHECK(back.points == mesh.points);
    BOOST_CHECK(back.quads == mesh.quads);
    const std::size_t body = bytes.find("end_header\n") + 11;
    for (std::size_t i = 0; i < colours.size(); ++i) {
        const std::string colour = bytes.substr(body + 27 * i + 24, 3);
        BOOST_TEST((colour == std::string(colours[i].begin(), colours[i].end())));
    }
    colours.pop_back();
    BOOST_CHECK_THROW(writeColouredPly(mesh, colours, out, "a.ply"), InputError);
}

BOOST_AUTO_TEST_CASE(stl_ascii_in_capitals_in_several_solids_and_on_one_line)
{
    const std::string facet = " FACET NORMAL 0 0 1 OUTER LOOP VERTEX 0 0 0 VERTEX 1 0 0 VERTEX 0 1 0 ENDLOOP ENDFACET";
    const std::string text =
        "SOLID a b c\n" + facet + "\n" + facet + "\nENDSOLID a b c\n\nsolid\n" + facet + "\nendsolid";
    const Mesh mesh = stl(text);
    BOOST_TEST(mesh.triangles.size() == 3U);
    BOOST_TEST(mesh.points.size() == 3U);
}

BOOST_AUTO_TEST_CASE(stl_merges_zero_with_minus_zero_and_keeps_doubles_apart)
{
    const Mesh merged = stl(binaryStl("", 2, {0, 0, 0, 1, 0, 0, 0, 1, 0, -0.0F, 0, -0.0F, 0, 1, -0.0F, -1, 0, 0}));
    BOOST_TEST(merged.points.size() == 4U);
    const std::string text = "solid\nfacet normal 0 0 0\nouter loop\nvertex 0.1 0 0\nvertex 0.10000000000000002 0 0\n"
                             "vertex 0 1 0\nendloop\nendfacet\nendsolid\n";
    BOOST_TEST(stl(text).points.size() == 3U);
}

BOOST_AUTO_TEST_SUITE_END()
