// Files that are no models: each gives one clear line that names the file, the place and the value.

#include <boost/test/unit_test.hpp>

#include <cmath>
#include <filesystem>
#include <limits>
#include <random>
#include <regex>

#include <sys/stat.h>
#include <unistd.h>

#include <mesh/mesh_samples.h>
#include <support/temporary_folder.h>
#include <vdbcage/core/error.h>
#include <vdbcage/mesh/mesh_io.h>

using namespace vdbcage;
using namespace vdbcage::test;

namespace {

struct Bad {
    const char* file;                   ///< name
    std::string bytes;                  ///< what is in it
    std::vector<std::string> mentioned; ///< by the message
};

const std::string threePoints = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
const std::string offPoints = "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n";
const std::string stlFacet =
    "facet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\n";

std::string ply(const std::string& body, const std::string& vertices = "3", const std::string& faces = "1",
                const std::string& format = "ascii")
{
    return "ply\nformat " + format + " 1.0\nelement vertex " + vertices +
           "\nproperty float x\nproperty float y\nproperty float z\nelement face " + faces +
           "\nproperty list uchar int vertex_indices\nend_header\n" + body;
}

std::string floats(const std::vector<float>& values)
{
    std::string bytes;
    for (const float value : values) bytes += littleEndian(value);
    return bytes;
}

/// Where the value at byte `at` of the body stands in the file.
std::string byteOfPly(std::size_t at)
{
    return "byte " + std::to_string(ply("", "3", "1", "binary_little_endian").size() + at) + ":";
}

std::string binaryPly(const std::vector<float>& points, std::vector<std::int32_t> corners)
{
    std::string body = floats(points) + char(corners.size());
    for (const std::int32_t corner : corners) body += littleEndian(corner);
    return ply(body, std::to_string(points.size() / 3), "1", "binary_little_endian");
}

std::string binaryStl(std::uint32_t announced, const std::string& facets)
{
    return std::string(80, 'h') + littleEndian(announced) + facets;
}

std::string stlFacetBytes(const std::vector<float>& corners)
{
    return std::string(12, '\0') + floats(corners) + std::string(2, '\0');
}

std::string junk(std::size_t size)
{
    std::mt19937 random(5);
    std::string bytes;
    for (std::size_t i = 0; i < size; ++i) bytes += static_cast<char>(random());
    return bytes;
}

const std::vector<Bad>& badFiles()
{
    constexpr float nan = std::numeric_limits<float>::quiet_NaN();
    constexpr float inf = std::numeric_limits<float>::infinity();
    static const std::vector<Bad> list = {
        // Any format
        {"empty.obj", "", {"empty"}},
        {"empty.off", "", {"empty"}},
        {"empty.ply", "", {"empty"}},
        {"empty.stl", "", {"empty"}},
        {"blank.obj", "\n \n", {"no faces"}},
        {"blank.off", "\n# nothing\n", {"line 3", "ends"}},
        {"blank.ply", "\n", {"line 1", "ply"}},
        {"blank.stl", "\n", {"byte 1", "ends"}},
        {"junk.obj", junk(5000), {"line 1", "\\x"}},
        {"junk.off", junk(5000), {"line 1", "\\x"}},
        {"junk.ply", junk(5000), {"line 1", "ply"}},
        {"junk.stl", junk(5000), {"byte 80", "5000"}},
        {"zeros.obj", std::string(3000, '\0'), {"line 1", "\\x00"}},
        {"zeros.off", std::string(3000, '\0'), {"line 1", "\\x00"}},
        {"zeros.stl", std::string(3000, '\0'), {"no faces"}},
        {"model.gltf", "{}", {"\".gltf\"", ".obj, .off, .ply, .stl"}},
        {"model", "v 0 0 0", {"no extension", ".obj"}},
        {"model.obj.gz", "\x1f\x8b", {"\".gz\""}},
        {"picture.obj", "\x89PNG\r\n\x1a\n", {"line 1", "\\x89PNG"}},
        // OBJ
        {"nan.obj", "v 0 0 0\nv 1 nan 0\nv 0 1 0\nf 1 2 3\n", {"line 2", "y coordinate", "\"nan\"", "finite"}},
        {"inf.obj", "v 0 0 0\n\nv 1 0 -inf\nf 1 1 1\n", {"line 3", "z coordinate", "\"-inf\"", "finite"}},
        {"large.obj", "v 1e400 0 0\n", {"line 1", "x coordinate", "\"1e400\"", "finite"}},
        {"largest.obj", "v 1e99999999999999999999 0 0\n", {"line 1", "finite"}},
        {"long.obj", "v -1" + std::string(400, '0') + " 0 0\n", {"line 1", "\"-10000", "finite"}},
        {"comma.obj", "v 0,5 0 0\n", {"line 1", "\"0,5\"", "not a number"}},
        {"word.obj", "v 0 zero 0\n", {"line 1", "y coordinate", "\"zero\"", "not a number"}},
        {"hex.obj", "v 0 0 0x10\n", {"line 1", "\"0x10\"", "not a number"}},
        {"sign.obj", "v +-1 0 0\n", {"line 1", "\"+-1\"", "not a number"}},
        {"short.obj", "v 0 0\nv 1 0 0\n", {"line 1", "z coordinate", "missing"}},
        {"joined.obj", "v 0 0 0 v 1 0 0\n", {"line 1", "\"v\"", "not a number"}},
        {"index0.obj", threePoints + "f 0 1 2\n", {"line 4", "\"0\"", "count from 1"}},
        {"beyond.obj", threePoints + "f 1 2 3\nf 1 2 4\n", {"line 5", "\"4\"", "3 points"}},
        {"beyond2.obj", "f 1 2 9\nf 1 2 3\n" + threePoints, {"line 1", "\"9\"", "3 points"}},
        {"before.obj", threePoints + "f -1 -2 -4\nv 1 1 1\n", {"line 4", "\"-4\"", "3 points before"}},
        {"huge.obj", threePoints + "f 1 2 99999999999999999999\n", {"line 4", "99999999999999999999"}},
        {"word2.obj", threePoints + "f 1 2 three\n", {"line 4", "\"three\""}},
        {"slashes.obj", threePoints + "f 1/1/1/1 2 3\n", {"line 4", "\"1/1/1/1\"", "v/vt/vn"}},
        {"point5.obj", threePoints + "f 1.5 2 3\n", {"line 4", "\"1.5\""}},
        {"cut.obj", threePoints + "f 1 2 3\nf 1 2", {"line 5", "ends within a face"}},
        {"cut2.obj", threePoints + "vt 0 0\nf 1/1 2/1 3/1\nf 1/1 2/1 3", {"line 6", "ends within a face"}},
        {"cut3.obj", threePoints + "f 1 2 3\nv 1", {"line 5", "y coordinate"}},
        {"cut4.obj", threePoints + "v 0 1 1\nf 1 2 3\nf 1 2 3", {"line 6", "point 4", "cut off"}},
        {"cut5.obj", threePoints + "f 1 2 3\nv 1 1 1.", {"line 5", "point 4", "cut off"}},
        {"numbers.obj", "0 0 0\n1 0 0\n", {"line 1", "\"0\""}},
        {"vertex.obj", "v 0 0 0\n", {"no faces"}},
        {"points.obj", threePoints + "p 1 2 3\n", {"no faces"}},
        {"flat.obj", "v 0 0 0\nv 1 1 1\nv 3 3 3\nf 1 2 3\nf 1 1 2\nf 1 1 1 1\n", {"every face is degenerate"}},
        // OFF
        {"kind.off", "4OFF\n0 0 0\n", {"line 1", "\"4OFF\"", "dimension"}},
        {"kind2.off", "nOFF 3\n0 0 0\n", {"line 1", "\"nOFF\"", "dimension"}},
        {"binary.off", "OFF BINARY\n\0\0", {"line 1", "binary OFF"}},
        {"word.off", "PLY\n", {"line 1", "\"PLY\"", "not the header"}},
        {"counts.off", "OFF\n", {"line 2", "number of points"}},
        {"counts2.off", "OFF\n3\n", {"number of faces"}},
        {"negative.off", "OFF\n-3 1 0\n", {"line 2", "\"-3\"", "below 0"}},
        {"many.off", "OFF\n1000000000000 1 0\n0 0 0\n", {"line 2", "1000000000000 points", "7 bytes"}},
        {"many2.off", "OFF\n1 1000000000000 0\n0 0 0\n3 0 0 0\n", {"line 2", "1000000000000 faces"}},
        {"many3.off", "OFF\n9223372036854775807 9223372036854775807 0\n", {"line 2", "9223372036854775807"}},
        {"many4.off", "OFF\n99999999999999999999 1 0\n", {"line 2", "99999999999999999999"}},
        {"nan.off", "OFF\n3 1 0\n0 0 0\n1 0 NaN\n0 1 0\n3 0 1 2\n", {"line 4", "z coordinate", "\"NaN\""}},
        {"below.off", offPoints + "3 0 1 -1\n", {"line 6", "\"-1\"", "3 points"}},
        {"beyond.off", offPoints + "3 0 1 3\n", {"line 6", "\"3\"", "3 points"}},
        {"corners.off", offPoints + "1000000000000 0 1 2\n", {"line 6", "1000000000000 corners"}},
        {"corners2.off", offPoints + "-3 0 1 2\n", {"line 6", "\"-3\"", "below 0"}},
        {"corners3.off", offPoints + "4 0 1 2\n", {"line 6", "4 corners"}},
        {"cut.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n", {"line 6", "ends within face 1 of 1"}},
        {"cut2.off", "OFF\n3 1 0\n0 0 0\n1 0 0.00000 0 0\n", {"line 5", "ends within point 3 of 3"}},
        {"more.off", offPoints + "3 0 1 2\n3 0 2 1\n", {"line 7", "\"3\"", "last of the 1 faces"}},
        {"none.off", "OFF\n3 0 0\n0 0 0\n1 0 0\n0 1 0\n", {"no faces"}},
        {"flat.off", "OFF\n3 1 0\n0 0 0\n1 1 1\n2 2 2\n3 0 1 2\n", {"every face is degenerate"}},
        // PLY
        {"word.ply", "plyx\nformat ascii 1.0\n", {"line 1", "ply"}},
        {"format.ply", "ply\nformat utf8 1.0\n", {"line 2", "\"utf8\""}},
        {"version.ply", "ply\nformat ascii 2.0\n", {"line 2", "\"2.0\""}},
        {"noformat.ply", "ply\nelement vertex 0\nend_header\n", {"line 3", "format"}},
        {"header.ply", "ply\nformat ascii 1.0\nelement vertex 3\n", {"line 4", "ends within its header"}},
        {"keyword.ply", "ply\nformat ascii 1.0\nelemnt vertex 3\n", {"line 3", "\"elemnt\""}},
        {"count.ply", "ply\nformat ascii 1.0\nelement vertex three\n", {"line 3", "\"three\""}},
        {"count2.ply", "ply\nformat ascii 1.0\nelement vertex -3\n", {"line 3", "\"-3\"", "below 0"}},
        {"type.ply", "ply\nformat ascii 1.0\nelement vertex 3\nproperty quad x\n", {"line 4", "\"quad\""}},
        {"list.ply", "ply\nformat ascii 1.0\nelement face 3\nproperty list float int a\n", {"line 4", "integer"}},
        {"property.ply", "ply\nformat ascii 1.0\nproperty float x\n", {"line 3", "before the first element"}},
        {"noz.ply",
         "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\nend_header\n",
         {"line 3", "\"z\""}},
        {"novertex.ply", "ply\nformat ascii 1.0\nelement face 0\nend_header\n", {"line 4", "no element \"vertex\""}},
        {"nolist.ply",
         ply("").replace(ply("").find("vertex_indices"), 14, "corners"),
         {"line 7", "\"vertex_indices\" of \"face\""}},
        {"many.ply", ply("0 0 0\n", "1000000000000"), {"line 3", "1000000000000", "\"vertex\"", "7 bytes"}},
        {"many2.ply",
         ply("0 0 0\n", "1000000000000", "1", "binary_little_endian"),
         {"line 3", "1000000000000", "12 bytes"}},
        {"many3.ply", ply("0 0 0\n", "9223372036854775807", "9223372036854775807"), {"9223372036854775807"}},
        {"nan.ply", ply("0 0 0\n1 nan 0\n0 1 0\n3 0 1 2\n"), {"line 11", "y coordinate", "\"nan\""}},
        {"nan2.ply",
         binaryPly({0, 0, 0, 1, nan, 0, 0, 1, 0}, {0, 1, 2}),
         {byteOfPly(16), "y coordinate", "2 of 3", "nan"}},
        {"inf.ply",
         binaryPly({0, 0, -inf, 1, 0, 0, 0, 1, 0}, {0, 1, 2}),
         {byteOfPly(8), "z coordinate", "1 of 3", "-inf"}},
        {"beyond.ply", ply("0 0 0\n1 0 0\n0 1 0\n3 0 1 3\n"), {"line 13", "corner 3", "3 points"}},
        {"beyond2.ply", binaryPly({0, 0, 0, 1, 0, 0, 0, 1, 0}, {0, 1, 3}), {byteOfPly(45), "corner 3", "3 points"}},
        {"below.ply", binaryPly({0, 0, 0, 1, 0, 0, 0, 1, 0}, {0, 1, -1}), {byteOfPly(45), "corner -1", "3 points"}},
        {"half.ply", ply("0 0 0\n1 0 0\n0 1 0\n3 0 1 1.5\n"), {"line 13", "\"1.5\"", "integer"}},
        {"list2.ply", ply("0 0 0\n1 0 0\n0 1 0\n1000000000000 0 1 2\n"), {"line 13", "1000000000000"}},
        {"list3.ply", ply("0 0 0\n1 0 0\n0 1 0\n-3 0 1 2\n"), {"line 13", "-3", "below 0"}},
        {"less.ply", ply("0 0\n1 0 0\n0 1 0\n3 0 1 2\n"), {"line 10", "z coordinate", "missing"}},
        {"more.ply", ply("0 0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n"), {"line 10", "\"0\"", "1 of 3"}},
        {"more2.ply", ply("0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n3 2 1 0\n"), {"line 14", "\"3\"", "last element"}},
        {"more3.ply", binaryPly({0, 0, 0, 1, 0, 0, 0, 1, 0}, {0, 1, 2}) + "more", {byteOfPly(49), "4 bytes follow"}},
        {"cut.ply", ply("0 0 0\n1 0 0\n0 1 0 4 5 6\n"), {"line 12", "\"4\""}},
        {"cut2.ply", ply("0 0 0\n1 0 0\n"), {"line 3", "3 elements \"vertex\""}},
        {"cut3.ply", ply("0.000 0.000 0.000\n1 0 0\n"), {"line 12", "ends before element \"vertex\" 3 of 3"}},
        {"cut4.ply", binaryPly({0, 0, 0, 1, 0, 0, 0, 1, 0}, {0, 1, 2}).substr(0, 215), {"3 values", "9 bytes"}},
        {"splats.ply",
         "ply\nformat ascii 1.0\nelement vertex 9\nproperty float x\nproperty float y\nproperty float z\n"
         "property float f_dc_0\nproperty float opacity\nproperty float scale_0\nproperty float rot_0\nend_header\n",
         {"line 3", "Gaussian splats", "make a mesh"}},
        {"packed.ply",
         "ply\nformat binary_little_endian 1.0\nelement chunk 1\nproperty float min_x\nelement vertex 9\n"
         "property uint packed_position\nproperty uint packed_rotation\nproperty uint packed_scale\n"
         "property uint packed_color\nend_header\n",
         {"line 5", "Gaussian splats", "make a mesh"}},
        {"none.ply", ply("0 0 0\n1 0 0\n0 1 0\n", "3", "0"), {"no faces"}},
        {"flat.ply", ply("0 0 0\n1 1 1\n2 2 2\n3 0 1 2\n"), {"every face is degenerate"}},
        // STL
        {"short.stl", "h", {"byte 1", "84 bytes"}},
        {"header.stl", binaryStl(0, "").substr(0, 83), {"byte 83", "84 bytes"}},
        {"none.stl", binaryStl(0, ""), {"no faces"}},
        {"none2.stl", "solid\nendsolid\n", {"no faces"}},
        {"many.stl",
         binaryStl(4000000000U, stlFacetBytes({0, 0, 0, 1, 0, 0, 0, 1, 0})),
         {"byte 80", "4000000000 triangles"}},
        {"zero.stl", binaryStl(0, stlFacetBytes({0, 0, 0, 1, 0, 0, 0, 1, 0})), {"byte 84", "50 bytes follow"}},
        {"nan.stl",
         binaryStl(1, stlFacetBytes({0, 0, 0, 1, nan, 0, 0, 1, 0})),
         {"byte 112", "y coordinate", "triangle 1", "nan"}},
        {"solid.stl",
         "solid" + binaryStl(2, stlFacetBytes({0, 0, 0, 1, 0, 0, 0, 1, 0})).substr(5),
         {"byte 80", "2 triangles", "184", "134"}},
        {"name.stl", "solid a", {"line 1", "endsolid"}},
        {"end.stl", "solid a\n" + stlFacet, {"line 9", "endsolid"}},
        {"word.stl", "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 a\n", {"line 4", "z coordinate", "\"a\""}},
        {"inf.stl",
         "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 inf\n",
         {"line 4", "z coordinate", "\"inf\"", "finite"}},
        {"keyword.stl", "solid a\nfacette normal 0 0 1\n", {"line 2", "\"facette\"", "\"facet\""}},
        {"quad.stl",
         "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nvertex 1 1 1\n",
         {"line 7", "\"vertex\"", "\"endloop\""}},
        {"after.stl", "solid a\n" + stlFacet + "endsolid\nmore\n", {"line 10", "\"more\""}},
        {"flat.stl", binaryStl(1, stlFacetBytes({0, 0, 0, 1, 1, 1, 2, 2, 2})), {"every face is degenerate"}},
    };
    return list;
}

/// The message of the error that `act` throws, empty if it throws none. It must begin with `name` and be one line.
template <typename Act>
std::string messageOf(const std::string& name, const Act& act)
{
    try {
        act();
    } catch (const IoError& error) {
        const std::string message = error.what();
        BOOST_TEST_REQUIRE(message.find(name + ": ") == 0U, message);
        BOOST_TEST_REQUIRE(message.find_first_of("\r\n") == std::string::npos, message);
        BOOST_TEST_REQUIRE(message.size() < name.size() + 250, message);
        return message;
    }
    return {};
}

} // namespace

BOOST_AUTO_TEST_SUITE(mesh_io_bad)

BOOST_AUTO_TEST_CASE(each_bad_file_gives_one_clear_line)
{
    const TemporaryFolder folder;
    BOOST_TEST(badFiles().size() >= 100U);
    for (const Bad& bad : badFiles()) {
        const std::filesystem::path path = folder / bad.file;
        writeText(path, bad.bytes);
        const std::string message = messageOf(path.string(), [&] { readMesh(path); });
        BOOST_TEST_MESSAGE(message);
        BOOST_TEST(!message.empty(), bad.file);
        // A place, but of what is wrong with the whole file; and what is allowed, or what to do.
        static const std::regex form("(line \\d+: |byte \\d+: |the file |it has no faces|every face is )[^;]*; .+");
        BOOST_TEST(std::regex_match(message.substr(path.string().size() + 2), form), message);
        for (const std::string& word : bad.mentioned) {
            BOOST_TEST(message.find(word) != std::string::npos, "no " << word << " in " << message);
        }
        std::filesystem::remove(path);
    }
}

BOOST_AUTO_TEST_CASE(what_is_no_readable_file)
{
    const TemporaryFolder folder;
    const auto message = [&](const std::string& name) {
        const std::filesystem::path path = folder / name;
        return messageOf(path.string(), [&] { readMesh(path); });
    };
    const auto has = [](const std::string& text, const char* part) { return text.find(part) != std::string::npos; };
    BOOST_TEST(has(message("missing.obj"), "No such file"));
    BOOST_TEST(has(message("no/such/folder.obj"), "No such file"));
    std::filesystem::create_directory(folder / "folder.obj");
    BOOST_TEST(has(message("folder.obj"), "is a directory"));
    std::filesystem::create_symlink(folder / "missing.obj", folder / "link.obj");
    BOOST_TEST(has(message("link.obj"), "No such file"));
    BOOST_REQUIRE(::mkfifo((folder / "pipe.obj").c_str(), 0600) == 0);
    BOOST_TEST(has(message("pipe.obj"), "not a regular file"));
    std::filesystem::create_symlink("/dev/zero", folder / "zero.obj");
    BOOST_TEST(has(message("zero.obj"), "not a regular file"));
    writeText(folder / "secret.obj", "v 0 0 0\n");
    std::filesystem::permissions(folder / "secret.obj", std::filesystem::perms::none);
    const bool isRoot = ::geteuid() == 0; // who may read everything
    if (isRoot) BOOST_REQUIRE(::seteuid(65534) == 0);
    const std::string secret = message("secret.obj");
    if (isRoot) BOOST_REQUIRE(::seteuid(0) == 0);
    BOOST_TEST(has(secret, "Permission denied"), secret);
}

BOOST_AUTO_TEST_CASE(truncated_anywhere, *boost::unit_test::label("property"))
{
    for (const Sample& sample : samples()) {
        const Mesh whole = sample.parse(sample.bytes, "a").mesh;
        const bool isObj = std::strcmp(sample.extension, ".obj") == 0;
        // The last line end, and the name behind "endsolid", may be missing.
        std::size_t needed = sample.bytes.find_last_not_of("\n") + 1;
        if (std::strcmp(sample.kind, "ascii stl") == 0) needed = sample.bytes.rfind("endsolid") + 8;
        if (sample.bytes.find("binary") != std::string::npos) needed = sample.bytes.size();
        for (std::size_t size = 0; size < needed; ++size) {
            // In memory of its own, so that reading behind the end is seen by the address sanitizer.
            const std::vector<char> bytes(sample.bytes.begin(), sample.bytes.begin() + std::ptrdiff_t(size));
            Mesh mesh;
            const std::string message = messageOf("a", [&] {
                mesh = sample.parse({bytes.data(), bytes.size()}, "a").mesh;
            });
            if (!message.empty()) continue;
            // An OBJ may end behind any line, and nothing tells whether its last number is whole.
            BOOST_TEST_REQUIRE(isObj, sample.kind << " of " << size << " bytes");
            BOOST_TEST_REQUIRE(mesh.triangles.size() + 2 * mesh.quads.size() <= 6U);
            for (std::size_t i = 0; i + 1 < mesh.triangles.size(); ++i) {
                BOOST_REQUIRE(mesh.triangles[i] == whole.triangles[i]);
            }
        }
    }
}

BOOST_AUTO_TEST_CASE(damaged_anywhere, *boost::unit_test::label("property"))
{
    std::mt19937 random(11);
    const std::string spice = " \n\r\\/#-+.e0123456789vfnaiolst\0\1\xFF";
    std::size_t errors = 0;
    std::size_t meshes = 0;
    for (const Sample& sample : samples()) {
        for (int trial = 0; trial < 3000; ++trial) {
            std::vector<char> bytes(sample.bytes.begin(), sample.bytes.end());
            for (unsigned change = 0; change <= random() % 4; ++change) {
                const std::ptrdiff_t at = static_cast<std::ptrdiff_t>(random() % bytes.size());
                const char value = random() % 2 == 0 ? spice[random() % spice.size()] : static_cast<char>(random());
                switch (random() % 3) {
                case 0:
                    bytes[std::size_t(at)] = value;
                    break;
                case 1:
                    bytes.insert(bytes.begin() + at, value);
                    break;
                default:
                    bytes.erase(bytes.begin() + at);
                }
            }
            Mesh mesh;
            if (messageOf("a", [&] { mesh = sample.parse({bytes.data(), bytes.size()}, "a").mesh; }).empty()) {
                ++meshes;
                BOOST_REQUIRE_NO_THROW(requireUsable(mesh, "a"));
                for (const openvdb::Vec3d& p : mesh.points) {
                    BOOST_REQUIRE((std::isfinite(p.x()) && std::isfinite(p.y()) && std::isfinite(p.z())));
                }
            } else {
                ++errors;
            }
        }
    }
    BOOST_TEST(errors > 1000U);
    BOOST_TEST(meshes > 1000U);
}

BOOST_AUTO_TEST_SUITE_END()
