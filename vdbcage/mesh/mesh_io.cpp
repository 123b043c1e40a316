#include <vdbcage/mesh/mesh_io.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <new>
#include <optional>
#include <string_view>
#include <system_error>
#include <utility>

#include <vdbcage/core/detail/atomic_file.h>
#include <vdbcage/core/detail/io_failure.h>
#include <vdbcage/core/detail/joined.h>
#include <vdbcage/core/detail/number_text.h>
#include <vdbcage/core/detail/read_file.h>
#include <vdbcage/core/error.h>
#include <vdbcage/mesh/detail/precision.h>
#include <vdbcage/mesh/io/formats.h>
#include <vdbcage/mesh/io/moved_bytes.h>

namespace vdbcage {

namespace {

struct Format {
    const char* extension;
    Precision precision; ///< of the written numbers
    MeshFile (*parse)(std::string_view, const std::string&);
    void (*write)(const Mesh&, const std::string&, std::ostream&); ///< writes points that have this precision
    std::string (*moved)(std::string_view, const std::string&, const std::vector<openvdb::Vec3d>&);
};

constexpr std::array<Format, 4> formats{
    {{".obj", Precision::float64, detail::parseObj, detail::writeObj, detail::movedObj},
     {".off", Precision::float64, detail::parseOff, detail::writeOff, detail::movedOff},
     {".ply", Precision::float64, detail::parsePly, detail::writePly, detail::movedPly},
     {".stl", Precision::float32, detail::parseStl, detail::writeStl, detail::movedStl}}};

const Format& formatOf(const std::filesystem::path& path)
{
    const std::string extension = path.extension().string();
    std::string lower = extension;
    std::transform(lower.begin(), lower.end(), lower.begin(),
                   [](char c) { return c >= 'A' && c <= 'Z' ? char(c - 'A' + 'a') : c; });
    for (const Format& format : formats) {
        if (lower == format.extension) return format;
    }
    throw IoError(path.string() + ": the file name " +
                  (extension.empty() ? "has no extension" : "ends in \"" + extension + "\"") +
                  "; the formats are known by " + detail::joined(meshExtensions(), ", "));
}

void requireFinitePoints(const std::vector<openvdb::Vec3d>& points, const std::string& name)
{
    for (std::size_t i = 0; i < points.size(); ++i) {
        const openvdb::Vec3d& p = points[i];
        if (!std::isfinite(p.x()) || !std::isfinite(p.y()) || !std::isfinite(p.z())) {
            throw InputError(name, "point " + std::to_string(i) + " is not finite");
        }
    }
}

void requireFitFloats(const std::vector<openvdb::Vec3d>& points, const std::string& name)
{
    constexpr const char* coordinateNames[3] = {"the x coordinate", "the y coordinate", "the z coordinate"};
    constexpr double largest = double(std::numeric_limits<float>::max());
    for (std::size_t i = 0; i < points.size(); ++i) {
        for (int axis = 0; axis < 3; ++axis) {
            const double value = points[i][axis];
            if (!(std::abs(value) > largest)) continue;
            throw IoError(name + ": " + coordinateNames[axis] + " of point " + std::to_string(i) + " is " +
                          detail::numberText(value) + ", which does not fit the floats of the file");
        }
    }
}

/// Does the same as asWritten().
Mesh rounded(Mesh mesh, const Format& format, const std::string& name)
{
    if (format.precision == Precision::float64) return mesh;
    requireFitFloats(mesh.points, name);
    return detail::asFloats(std::move(mesh));
}

/// Returns the precision of the coordinates in a file, which stays when its points are moved; nothing if they are
/// integers, which cannot hold other positions.
std::optional<Precision> movablePrecision(const Format& format, std::string_view bytes, const std::string& name)
{
    if (format.parse == detail::parsePly) return detail::plyPrecision(bytes, name);
    return format.precision;
}

} // namespace

const std::vector<std::string>& meshExtensions()
{
    static const std::vector<std::string> extensions = [] {
        std::vector<std::string> list;
        for (const Format& format : formats) list.emplace_back(format.extension);
        return list;
    }();
    return extensions;
}

Precision precisionOf(const std::filesystem::path& path)
{
    return formatOf(path).precision;
}

Mesh asWritten(Mesh mesh, const std::filesystem::path& path)
{
    return rounded(std::move(mesh), formatOf(path), path.string());
}

void detail::requireMeshExtension(const std::filesystem::path& path)
{
    formatOf(path);
}

std::string detail::readMeshBytes(const std::filesystem::path& path)
{
    std::error_code ignored;
    if (!std::filesystem::is_directory(path, ignored)) formatOf(path);
    return withMemoryToRead(path, [&] { return readFile(path); });
}

MeshFile detail::parseMesh(const std::string& bytes, const std::filesystem::path& path)
{
    return withMemoryToRead(path, [&] { return formatOf(path).parse(bytes, path.string()); });
}

MeshFile readMeshFile(const std::filesystem::path& path)
{
    return detail::parseMesh(detail::readMeshBytes(path), path);
}

Mesh readMesh(const std::filesystem::path& path)
{
    return readMeshFile(path).mesh;
}

void writeMesh(const Mesh& mesh, const std::filesystem::path& path)
{
    detail::requireMeshExtension(path);
    writeFileAtomically(path, [&](std::ostream& out) { writeMesh(mesh, out, path); });
}

void writeMesh(const Mesh& mesh, std::ostream& out, const std::filesystem::path& path)
{
    const std::string name = path.string();
    const Format& format = formatOf(path);
    requireUsable(mesh, name.c_str());
    requireFinitePoints(mesh.points, name);
    if (format.precision == Precision::float64) {
        format.write(mesh, name, out);
    } else {
        format.write(rounded(mesh, format, name), name, out);
    }
}

void writeColouredPly(const Mesh& mesh, const std::vector<PointColour>& colours, std::ostream& out,
                      const std::filesystem::path& path)
{
    const std::string name = path.string();
    requireUsable(mesh, name.c_str());
    requireFinitePoints(mesh.points, name);
    if (colours.size() != mesh.points.size()) {
        throw InputError(name, std::to_string(colours.size()) + " colours were given; the mesh has " +
                                   std::to_string(mesh.points.size()) + " points");
    }
    detail::writePly(mesh, &colours, out);
}

Precision movedPrecision(const std::filesystem::path& original, const std::filesystem::path& path)
{
    const Format& format = formatOf(path);
    if (&format != &formatOf(original) || format.parse != detail::parsePly) return format.precision;
    return movablePrecision(format, detail::readMeshBytes(original), original.string()).value_or(format.precision);
}

void writeMoved(const std::filesystem::path& original, const std::vector<openvdb::Vec3d>& points,
                const std::filesystem::path& path)
{
    writeFileAtomically(path, [&](std::ostream& out) { writeMoved(original, points, out, path); });
}

void writeMoved(const std::filesystem::path& original, const std::vector<openvdb::Vec3d>& points, std::ostream& out,
                const std::filesystem::path& path)
{
    const std::string name = path.string();
    const Format& format = formatOf(path);
    const bool keepsFormat = &format == &formatOf(original);
    requireFinitePoints(points, name);
    const std::string bytes = detail::readMeshBytes(original);
    Mesh mesh = detail::parseMesh(bytes, original).mesh;
    if (mesh.points.size() != points.size()) {
        throw InputError(name, std::to_string(points.size()) + " positions were given; " + original.string() + " has " +
                                   std::to_string(mesh.points.size()) + " points");
    }
    const auto stays = [](const openvdb::Vec3d& a, const openvdb::Vec3d& b) { return detail::sameBits(a, b); };
    if (keepsFormat && std::equal(points.begin(), points.end(), mesh.points.begin(), stays)) {
        out << bytes;
        return;
    }
    const std::optional<Precision> precision =
        keepsFormat ? movablePrecision(format, bytes, original.string()) : std::nullopt;
    if (!precision) {
        mesh.points = points;
        writeMesh(mesh, out, path);
        return;
    }
    if (*precision == Precision::float32) requireFitFloats(points, name);
    out << format.moved(bytes, original.string(), points);
}

} // namespace vdbcage
