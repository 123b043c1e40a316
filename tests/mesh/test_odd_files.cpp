// Files as some programs write them, otherwise than their format: read where the meaning is plain, with a warning; and
// those like them that are refused, as they may mean something else.

#include <boost/test/unit_test.hpp>

#include <cstring>
#include <stdexcept>
#include <string_view>

#include <mesh/mesh_samples.h>
#include <support/temporary_folder.h>
#include <vdbcage/core/error.h>
#include <vdbcage/mesh/mesh_io.h>

using namespace vdbcage;
using namespace vdbcage::test;

namespace {

/// Of text in ASCII.
std::string utf16(const std::string& text, bool isLittleEndian)
{
    std::string bytes = isLittleEndian ? "\xFF\xFE" : "\xFE\xFF";
    for (const char c : text) bytes += isLittleEndian ? std::string{c, '\0'} : std::string{'\0', c};
    return bytes;
}

const Sample& sample(std::string_view kind)
{
    for (const Sample& each : samples()) {
        if (each.kind == kind) return each;
    }
    throw std::logic_error("there is no sample " + std::string(kind));
}

std::string obj()
{
    return sample("obj").bytes;
}

std::string off()
{
    return sample("off").bytes;
}

/// The pyramid in ascii, its header and its body.
std::string plyBody()
{
    return "0.5 0.5 0.75\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n3 1 2 0\n3 2 3 0\n3 3 4 0\n3 4 1 0\n4 4 3 2 1\n";
}

std::string plyHeader(const std::string& moreLines = "", const std::string& format = "ascii")
{
    return "ply\nformat " + format + " 1.0\n" + moreLines +
           "element vertex 5\nproperty float x\nproperty float y\nproperty float z\n"
           "element face 5\nproperty list uchar int vertex_indices\nend_header\n";
}

/// A binary PLY with other ends of the lines of its header.
std::string binaryPly(const std::string& lineEnd, const std::string& lastEnd)
{
    const std::string bytes = write(detail::writePly, pyramid());
    const std::size_t body = bytes.find("end_header\n") + 11;
    return replaced(bytes.substr(0, body - 1), "\n", lineEnd) + lastEnd + bytes.substr(body);
}

struct Odd {
    const char* kind;
    Parse parse;
    std::string bytes;
    std::vector<std::string> warnings;
};

constexpr const char* utf16Warning = "line 1: the text is UTF-16; it is read as if it were UTF-8";
constexpr const char* signWarning =
    ": a number has the sign of its exponent before the e, like 3.1+e2, which is read as 3.1e+2";
constexpr const char* fortranWarning = ": a number has an exponent of Fortran, like 1.5d3, which is read as 1.5e3";
constexpr const char* remarkWarning = ": a line begins with a word that the format does not have; it is passed over";
constexpr const char* offHeaderWarning = ": the header of an OFF file comes before the OBJ file; it is passed over";
constexpr const char* commentWarning = ": a line of the header has no keyword; it is taken for a comment";
constexpr const char* moreValuesWarning =
    ": the line of a face has more values than the header says; they are not used";
constexpr const char* lineEndWarning =
    ": the header ends in CR LF or CR before binary data, which are taken to begin behind it";

std::string on(int line, const char* warning, int times = 1)
{
    return "line " + std::to_string(line) + warning + (times > 1 ? " (" + std::to_string(times) + " times)" : "");
}

std::vector<Odd> oddFiles()
{
    std::vector<Odd> list;
    for (const bool isLittleEndian : {true, false}) {
        for (const char* kind : {"obj", "off", "ascii ply", "ascii stl"}) {
            const Sample& each = sample(kind);
            list.push_back({kind, each.parse, utf16(each.bytes, isLittleEndian), {utf16Warning}});
        }
        // Two kinds of oddity; lines count as an editor shows them.
        list.push_back({"obj",
                        detail::parseObj,
                        utf16(replaced(obj(), "0.75", "7.5-E1"), isLittleEndian),
                        {utf16Warning, on(1, signWarning)}});
    }
    const std::string objFaces = obj().substr(obj().find('f'));
    for (const char* number : {"0.5", "5-e1", "0.05+e1", "+.5+e0", "5.-E01", "5d-1", "0.05D1", "0.05D+01", ".5d0"}) {
        const std::string points = "v 0.5 " + std::string(number) + " 0.75\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";
        const bool isFortran = std::strpbrk(number, "dD") != nullptr;
        const bool isOdd = std::string(number) != "0.5";
        list.push_back({number, detail::parseObj, points + objFaces,
                        isOdd ? std::vector<std::string>{on(1, isFortran ? fortranWarning : signWarning)}
                              : std::vector<std::string>{}});
    }
    list.push_back({"odd numbers in OFF",
                    detail::parseOff,
                    replaced(replaced(off(), "0.75", "7.5-e1"), "0.5", "5d-1"),
                    {on(3, fortranWarning, 2), on(3, signWarning)}});
    list.push_back({"odd numbers in PLY",
                    detail::parsePly,
                    plyHeader() + replaced(plyBody(), "0.75", "75-e2"),
                    {on(10, signWarning)}});
    list.push_back({"odd numbers in STL",
                    detail::parseStl,
                    replaced(asciiStlPyramid(), "0.75", "75-e2"),
                    {on(6, signWarning, 4)}});
    list.push_back({"counts", detail::parseObj, "5 5\n" + obj(), {on(1, offHeaderWarning)}});
    list.push_back({"counts with edges", detail::parseObj, "# tent\n\n5 5 8\n" + obj(), {on(3, offHeaderWarning)}});
    list.push_back({"OFF header", detail::parseObj, "OFF\n5 5 0\n" + obj(), {on(1, offHeaderWarning)}});
    list.push_back({"OFF header on a line", detail::parseObj, "OFF 5 5 0\r\n" + obj(), {on(1, offHeaderWarning)}});
    for (const char* remark :
         {"$ remark", "// remark \\", "; C:\\models\\", "%", "*** v 1 2 3 ***", "-- f", "\"quoted\"",
          "Gr\xC3\xB6\xC3\x9F"
          "e 12",
          "\xC2\xA7 2", "made by hand", "made: 2026", "F 1 2 3", "vertex_quality 1 \\\n2"}) {
        list.push_back({remark, detail::parseObj, std::string(remark) + "\n" + obj(), {on(1, remarkWarning)}});
    }
    list.push_back(
        {"remarks throughout", detail::parseObj, replaced(obj(), "\nf", "\n! v 1 2 3\nf"), {on(6, remarkWarning, 5)}});
    const std::string stl = asciiStlPyramid();
    for (const char* remark : {"color 0.5 0.5 0.5", "# this facet is a side", "// facet",
                               "Fl\xC3\xA4"
                               "che 1",
                               "%"}) {
        list.push_back({remark,
                        detail::parseStl,
                        replaced(stl, "endfacet\n", "endfacet\n" + std::string(remark) + "\n"),
                        {on(9, remarkWarning, 6)}});
    }
    list.push_back({"a remark before the first facet",
                    detail::parseStl,
                    replaced(stl, "of stone\n", "of stone\n\n  units mm\n"),
                    {on(3, remarkWarning)}});
    list.push_back(
        {"Blender 2.47",
         detail::parsePly,
         plyHeader("Created by Blender3D 2.47 - www.blender.org, source file: /home/a/tent.blend\n") + plyBody(),
         {on(3, commentWarning)}});
    list.push_back({"free text",
                    detail::parsePly,
                    plyHeader("made in Zürich\n\tby hand, 3\tdays\n") + plyBody(),
                    {on(3, commentWarning, 2)}});
    std::string more = plyBody();
    for (const char* face : {"3 1 2 0", "3 3 4 0", "4 4 3 2 1"}) {
        more = replaced(more, std::string(face) + "\n", std::string(face) + " 6 0 0.5 1 1e-3 nan 0\n");
    }
    list.push_back({"MeshLab", detail::parsePly, plyHeader() + more, {on(15, moreValuesWarning, 3)}});
    for (const char* lineEnd : {"\r\n", "\r"}) {
        list.push_back({"binary", detail::parsePly, binaryPly(lineEnd, lineEnd), {on(9, lineEndWarning)}});
    }
    list.push_back({"binary, mixed", detail::parsePly, binaryPly("\n", "\r\n"), {on(9, lineEndWarning)}});
    list.push_back({"binary, mixed", detail::parsePly, binaryPly("\r\n", "\n"), {}});
    return list;
}

/// Not to be guessed at. The number of the line, and words of the problem and of the remedy.
struct Refused {
    Parse parse;
    std::string bytes;
    const char* place;
    std::vector<std::string> words;
};

/// A binary PLY in which each byte 10 got a 13 before it, in the data too.
std::string throughTextMode()
{
    Mesh mesh = pyramid();
    mesh.points.resize(10, openvdb::Vec3d(0));
    mesh.points.emplace_back(1, 0, 1);
    mesh.triangles.emplace_back(1, 2, 10);
    return replaced(write(detail::writePly, mesh), "\n", "\r\n");
}

std::vector<Refused> refusedFiles()
{
    const auto number = [](const std::string& text) {
        return Refused{detail::parseObj,
                       "v 0 0 0\nv 1 " + text + " 0\n",
                       "line 2: ",
                       {"the y coordinate is \"" + text + "\"", "not a number; numbers are written like"}};
    };
    const std::string blender = "; it must begin with format, comment";
    const auto header = [&](const std::string& lines) {
        return Refused{
            detail::parsePly, plyHeader(lines) + plyBody(), "line 3: ", {"not a line of a PLY header", blender}};
    };
    const std::string body = plyBody();
    const std::string again = "again", stl = asciiStlPyramid();
    return {
        // Two numbers that touch, or numbers of a country; an exponent alone, twice, or none.
        number("1.5-300"),
        number("1.5+3"),
        number("1,5"),
        number("1.000.5"),
        number("1.5e"),
        number("1.5d"),
        number("1.5+e"),
        number("1.5+e+2"),
        number("1.5++e2"),
        number("1.5e+d2"),
        number("d2"),
        number("+e2"),
        number(".+e2"),
        number("1.5f"),
        number("1.5d2d2"),
        number("1_000"),
        number("1.5+e2x"),
        number("0x1p3"),
        number("1/2"),
        number("--1"),
        // An OFF file, and counts that are not those of the file.
        {detail::parseObj, off(), "line 3: ", {"cannot begin with \"0.5\"", "let its name end in .off"}},
        {detail::parseObj, "5 6 0\n" + obj(), "line 1: ", {"5 points and 6 faces, but there are 5 and 5", "delete"}},
        {detail::parseObj, "OFF\n4 5\n" + obj(), "line 2: ", {"4 points and 5 faces", "delete this line"}},
        {detail::parseObj, "5 5 8 1\n" + obj(), "line 1: ", {"cannot begin with \"5\"", "like v or f"}},
        {detail::parseObj, "5\n" + obj(), "line 1: ", {"cannot begin with \"5\"", "like v or f"}},
        {detail::parseObj, "5 -5\n" + obj(), "line 1: ", {"cannot begin with \"5\"", "like v or f"}},
        {detail::parseObj, "5 5.0\n" + obj(), "line 1: ", {"cannot begin with \"5\"", "like v or f"}},
        {detail::parseObj, obj() + "5 5\n", "line 11: ", {"cannot begin with \"5\"", "like v or f"}},
        {detail::parseObj, "5 5\n5 5\n" + obj(), "line 2: ", {"cannot begin with \"5\""}},
        // What may be a part of the model, and files of other formats.
        {detail::parseObj, "$ remark \\\n-.5 0 0\n" + obj(), "line 2: ", {"cannot begin with \"-.5\""}},
        {detail::parseObj, obj() + "1/2/3 4\n", "line 11: ", {"cannot begin with \"1/2/3\"", "like v or f"}},
        {detail::parseObj, "$\x1b[31m\n" + obj(), "line 1: ", {"cannot begin with \"$\\x1b[31m\"", "like v or f"}},
        {detail::parseObj, "\xDC 2\n" + obj(), "line 1: ", {"cannot begin with \"\\xdc\"", "like v or f"}},
        {detail::parseObj, "<!DOCTYPE html>\n<p>\n", "line 1: ", {"cannot begin with \"<!DOCTYPE\"", "like v or f"}},
        {detail::parseObj, "\n{\"asset\": {}}\n", "line 2: ", {"cannot begin with \"{\"asset\":\"", "like v or f"}},
        {detail::parseStl, replaced(stl, "endfacet\n", "endfacet\n0 0 1\n"), "line 9: ", {"\"0\" stands here"}},
        {detail::parseStl, replaced(stl, "endfacet\n", "endfacet red\n"), "line 8: ", {"\"red\" stands here"}},
        {detail::parseStl, replaced(stl, "outer loop", "red\nouter loop"), "line 3: ", {"must be \"outer\""}},
        {detail::parseStl, replaced(stl, "facet normal", "facette normal"), "line 2: ", {"must be \"facet\""}},
        {detail::parseStl, replaced(stl, "endsolid", "ensolid"), "line 45: ", {"ends before \"endsolid\"", again}},
        // A line of the header that may be mistyped: what it says of the data must not be lost.
        header("elemnt vertex 5\n"),
        header("fromat ascii 1.0\n"),
        header("fromat binary_little_endian 1.0\n"),
        header("proprty float x\n"),
        header("proprty list uchar int a\n"),
        header("made by \x1b[31m hand\n"),
        {detail::parsePly,
         replaced(plyHeader(), "end_header", "made by hand\nend_header") + body,
         "line 9: ",
         {"\"made\" is not a line", blender}},
        {detail::parsePly,
         replaced(plyHeader(), "element face", "made by hand\nelement face") + body,
         "line 7: ",
         {"\"made\" is not a line", blender}},
        // More values of a point, or words behind a face.
        {detail::parsePly,
         plyHeader() + replaced(body, "1 1 0\n", "1 1 0 9\n"),
         "line 13: ",
         {"\"9\" follows the properties of element \"vertex\" 4 of 5", "the header must have a property"}},
        {detail::parsePly,
         plyHeader() + replaced(body, "3 1 2 0\n", "3 1 2 0 red\n"),
         "line 15: ",
         {"\"red\" follows the properties of element \"face\" 1 of 5", "the header must have a property"}},
        {detail::parsePly, plyHeader() + replaced(body, "3 1 2 0\n", "3 1 2 0 1 red\n"), "line 15: ", {"\"red\""}},
        {detail::parsePly,
         plyHeader() + replaced(body, "3 1 2 0\n3", "3 1 2 0 3"),
         "line 19: ",
         {"ends before element \"face\" 5 of 5", again}},
        {detail::parsePly,
         plyHeader() + body + "9 9 9\n",
         "line 20: ",
         {"\"9\" follows the last", "correct the counts"}},
        // Line ends that some transfer changed in the data too.
        {detail::parsePly, throughTextMode(), "byte ", {"out of range; there are 11 points"}},
        {detail::parsePly, binaryPly("\r", "\n\n"), "byte ", {again}},
        {detail::parsePly, binaryPly("\n", "\n") + '\1', "byte ", {"1 bytes follow", again}},
        // UTF-16 that is cut off, holds binary data, or has no mark; UTF-32.
        {detail::parseObj, utf16(obj(), true) + 'x', "byte ", {"within a character of UTF-16", again}},
        {detail::parseOff, utf16(off(), false) + 'x', "byte ", {"within a character of UTF-16", again}},
        {detail::parsePly,
         utf16(binaryPly("\n", "\n"), true),
         "line 9: ",
         {"binary data follow text of UTF-16", again}},
        {detail::parseObj, utf16(obj(), true).substr(2), "line 1: ", {"\"v\\x00\"", "like v or f"}},
        {detail::parseOff, utf16(off(), false).substr(2), "line 1: ", {"\\x00", "the first line must be OFF"}},
        {detail::parsePly, utf16(plyHeader() + body, true).substr(2), "line 1: ", {"it must be \"ply\""}},
        {detail::parseObj, "\xFF\xFE" + std::string("\0\0v\0\0\0 \0\0\0", 10), "line 1: ", {"\\x00", "like v or f"}},
        {detail::parseObj, std::string("\xFF\xFE\x00\xD8v\0", 6), "line 1: ", {"\\xef\\xbf\\xbd", "like v or f"}},
        {detail::parseStl, utf16("solid a\nfacet normal 0 0 1\n", true), "line 3: ", {"endsolid"}},
    };
}

} // namespace

BOOST_AUTO_TEST_SUITE(odd_files)

BOOST_AUTO_TEST_CASE(each_is_read_to_its_mesh_with_a_warning)
{
    for (const Odd& odd : oddFiles()) {
        BOOST_TEST_CONTEXT(odd.kind)
        {
            const auto [mesh, summary] = odd.parse(odd.bytes, "a");
            BOOST_TEST(summary.warnings == odd.warnings, boost::test_tools::per_element());
            if (odd.parse == detail::parseStl) {
                const Mesh expected = sample("ascii stl").parse(asciiStlPyramid(), "a").mesh;
                BOOST_TEST(sameBits(mesh, expected));
            } else {
                BOOST_TEST(sameBits(mesh, pyramid()));
            }
            BOOST_TEST(summary.ignoredElements == 0U);
            // Cut short, it is refused or a part of the mesh, and nothing is read behind its end.
            for (std::size_t size = 0; size < odd.bytes.size(); size += 7) {
                const std::vector<char> part(odd.bytes.begin(), odd.bytes.begin() + std::ptrdiff_t(size));
                try {
                    BOOST_TEST(faceCount(odd.parse({part.data(), part.size()}, "a").mesh) <= 6U);
                } catch (const IoError& error) {
                    BOOST_TEST(std::string(error.what()).find('\n') == std::string::npos);
                }
            }
        }
    }
}

BOOST_AUTO_TEST_CASE(what_may_mean_something_else_is_refused_with_its_line_and_a_remedy)
{
    const std::vector<Refused> list = refusedFiles();
    BOOST_TEST(list.size() >= 40U);
    for (const Refused& refused : list) {
        const std::string place = std::string("a.file: ") + refused.place;
        BOOST_CHECK_EXCEPTION(refused.parse(refused.bytes, "a.file"), IoError, [&](const IoError& error) {
            const std::string message = error.what();
            BOOST_TEST_MESSAGE(message);
            BOOST_TEST(message.substr(0, place.size()) == place, message);
            BOOST_TEST(message.find("; ") != std::string::npos, message);
            BOOST_TEST(message.find_first_of("\r\n\x1b") == std::string::npos, message);
            for (const std::string& word : refused.words) {
                BOOST_TEST(message.find(word) != std::string::npos, "no " << word << " in " << message);
            }
            return true;
        });
    }
}

BOOST_AUTO_TEST_CASE(a_million_odd_numbers_are_one_warning)
{
    std::string text;
    for (int i = 0; i < 1000000; ++i) text += "v 0 0 1+e0\n";
    const auto [mesh, summary] = detail::parseObj("v 0 0 0\nv 1 0 0\nv 0 1 0\n" + text + "f 1 2 3\n", "a.obj");
    const std::vector<std::string> expected{on(4, signWarning, 1000000)};
    BOOST_TEST(summary.warnings == expected, boost::test_tools::per_element());
}

BOOST_AUTO_TEST_CASE(usual_files_have_no_warning)
{
    for (const Sample& each : samples()) {
        if (each.bytes.find("end_header\r\n") != std::string::npos) continue; // that is odd
        BOOST_TEST(each.parse(each.bytes, "a").summary.warnings.empty(), each.kind);
        if (each.bytes.find('\0') != std::string::npos) continue; // binary
        BOOST_TEST(each.parse(replaced(each.bytes, "\n", " \r\n"), "a").summary.warnings.empty(), each.kind);
    }
}

BOOST_AUTO_TEST_CASE(characters_of_utf16_become_those_of_utf8)
{
    const TemporaryFolder folder;
    // A name of one, two, three and four bytes a character: A, ä, €, a clef; then half of one.
    const std::string mark = "\xFF\xFE";
    const std::string name("A\0\xE4\0\xAC\x20\x34\xD8\x1E\xDD\x34\xD8 \0", 14);
    const auto ascii = [](const std::string& text) { return utf16(text, true).substr(2); };
    const std::string bytes = mark + ascii("o ") + name + ascii("\nv 0 0+e0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    writeText(folder / "a.obj", bytes);
    const std::vector<openvdb::Vec3d> points{{0, 0, 1}, {1, 0, 1}, {0, 1, 1}};
    writeMoved(folder / "a.obj", points, folder / "b.obj");
    BOOST_TEST(readText(folder / "b.obj") ==
               "o A\xC3\xA4\xE2\x82\xAC\xF0\x9D\x84\x9E\xEF\xBF\xBD \nv 0 0+e0 1\nv 1 0 1\nv 0 1 1\nf 1 2 3\n");
}

BOOST_AUTO_TEST_CASE(remarks_stay_where_points_are_moved)
{
    const TemporaryFolder folder;
    const std::string before = "$ C:\\models\\\nv ", after = "\n// v 9 9 9\nv 1 0 0\nmade by hand \\\nv 7 7 7\n"
                                                             "v 0 1 0\nf 1 2 3\n";
    writeText(folder / "a.obj", before + "0 0 0" + after);
    writeMoved(folder / "a.obj", {{0, 0, 5}, {1, 0, 0}, {0, 1, 0}}, folder / "b.obj");
    BOOST_TEST(readText(folder / "b.obj") == before + "0 0 5" + after);
}

BOOST_AUTO_TEST_CASE(binary_stl_that_begins_like_utf16_is_binary)
{
    std::string bytes = sample("binary stl").bytes;
    bytes.replace(0, 2, "\xFF\xFE");
    const auto [mesh, summary] = detail::parseStl(bytes, "a.stl");
    BOOST_TEST(mesh.triangles.size() == 6U);
    BOOST_TEST(summary.warnings.empty());
    BOOST_CHECK_EXCEPTION(detail::parseStl(bytes.substr(0, 200), "a.stl"), IoError, [](const IoError& error) {
        return std::string(error.what()).find("byte 80: the header announces 6 triangles") != std::string::npos;
    });
}

BOOST_AUTO_TEST_SUITE_END()
