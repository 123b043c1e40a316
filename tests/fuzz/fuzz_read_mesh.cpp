// Any bytes at all: a parser answers with one line or with a mesh that is usable and survives being written and read.

#include <cstddef>
#include <cstdint>
#include <cstdlib>
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

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    const std::string name = "fuzz";
    Mesh mesh;
    try {
        mesh = detail::PARSE({reinterpret_cast<const char*>(data), size}, name).mesh;
    } catch (const IoError& error) {
        const std::string_view message = error.what();
        require(message.substr(0, 6) == "fuzz: " && message.find('\n') == std::string_view::npos);
        return 0;
    }
    requireUsable(mesh, "fuzz");
    requireSurvives(mesh, detail::parseObj, detail::writeObj);
    requireSurvives(mesh, detail::parseOff, detail::writeOff);
    requireSurvives(mesh, detail::parsePly, detail::writePly);
    return 0;
}
