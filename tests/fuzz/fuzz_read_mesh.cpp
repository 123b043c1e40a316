// Any bytes at all: a parser answers with one line or with a mesh that is usable and survives being written and read.
// The points of the file can then be moved, too.

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <limits>
#include <string>
#include <string_view>

#include <mesh/mesh_samples.h>
#include <vdbcage/core/error.h>
#include <vdbcage/mesh/io/formats.h>

using namespace vdbcage;

namespace {

void require(bool holds)
{
    if (!holds) std::abort();
}

/// Quads may come back as triangles: what is convex is decided again, from the same corners and so with the same
/// answer.
void requireSurvives(const Mesh& mesh, test::Parse parse, test::Write writer)
{
    require(test::sameBits(parse(test::write(writer, mesh), "again").mesh, mesh));
}

/// Points that stay leave the bytes; others are where they went. They are mirrored, which keeps floats and areas.
void requireMoves(std::string_view bytes, const std::string& name, const Mesh& mesh)
{
    const std::string_view mark = bytes.substr(0, 2);
    const bool isUtf16 = mark == "\xFF\xFE" || mark == "\xFE\xFF"; // becomes UTF-8
    require(isUtf16 || detail::MOVED(bytes, name, mesh.points) == bytes);
    const test::Parse parse = detail::PARSE;
    if (parse == detail::parsePly && !detail::plyPrecision(bytes, name)) return;
    Mesh mirrored = mesh;
    for (openvdb::Vec3d& p : mirrored.points) {
        for (int axis = 0; axis < 3; ++axis) {
            if (std::abs(p[axis]) > double(std::numeric_limits<float>::max())) return;
            if (double(float(p[axis])) != p[axis]) return;
        }
        p = -p;
    }
    Mesh moved = parse(detail::MOVED(bytes, name, mirrored.points), name).mesh;
    moved.triangles = mirrored.triangles; // polygons may be split otherwise
    moved.quads = mirrored.quads;
    require(test::sameBits(moved, mirrored));
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    const std::string name = "fuzz";
    const std::string_view bytes(reinterpret_cast<const char*>(data), size);
    Mesh mesh;
    try {
        mesh = detail::PARSE(bytes, name).mesh;
    } catch (const IoError& error) {
        const std::string_view message = error.what();
        require(message.substr(0, 6) == "fuzz: " && message.find('\n') == std::string_view::npos);
        return 0;
    }
    requireUsable(mesh, "fuzz");
    requireSurvives(mesh, detail::parseObj, detail::writeObj);
    requireSurvives(mesh, detail::parseOff, detail::writeOff);
    requireSurvives(mesh, detail::parsePly, detail::writePly);
    requireMoves(bytes, name, mesh);
    return 0;
}
