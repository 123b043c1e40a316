#include <vdbcage/mesh/mesh_io.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cmath>
#include <new>
#include <string_view>
#include <system_error>
#include <utility>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <vdbcage/core/atomic_file.h>
#include <vdbcage/core/error.h>
#include <vdbcage/mesh/detail/formats.h>
#include <vdbcage/mesh/detail/moved_obj.h>

namespace vdbcage {

namespace {

struct Format {
    const char* extension;
    Mesh (*parse)(std::string_view, const std::string&, ReadSummary*);
    void (*write)(const Mesh&, const std::string&, std::ostream&);
};

constexpr std::array<Format, 4> formats{{{".obj", detail::parseObj, detail::writeObj},
                                         {".off", detail::parseOff, detail::writeOff},
                                         {".ply", detail::parsePly, detail::writePly},
                                         {".stl", detail::parseStl, detail::writeStl}}};

const Format& formatOf(const std::filesystem::path& path)
{
    const std::string extension = path.extension().string();
    std::string lower = extension;
    std::transform(lower.begin(), lower.end(), lower.begin(),
                   [](char c) { return c >= 'A' && c <= 'Z' ? char(c - 'A' + 'a') : c; });
    std::string known;
    for (const Format& format : formats) {
        if (lower == format.extension) return format;
        known += (known.empty() ? "" : ", ") + std::string(format.extension);
    }
    throw IoError(path.string() + ": the file name " +
                  (extension.empty() ? "has no extension" : "ends in \"" + extension + "\"") +
                  "; the formats are known by " + known);
}

/// An open file, closed when the scope is left.
class File {
public:
    explicit File(const std::filesystem::path& path)
        : path_(path), descriptor_(::open(path.c_str(), O_RDONLY | O_CLOEXEC))
    {
        if (descriptor_ < 0) fail(errno);
    }
    ~File() { ::close(descriptor_); }
    File(const File&) = delete;
    File& operator=(const File&) = delete;

    std::string readAll() const
    {
        struct stat status {};
        if (::fstat(descriptor_, &status) != 0) fail(errno);
        std::string bytes(static_cast<std::size_t>(status.st_size), '\0');
        std::size_t got = 0;
        while (got < bytes.size()) {
            const ssize_t count = ::read(descriptor_, bytes.data() + got, bytes.size() - got);
            if (count < 0 && errno != EINTR) fail(errno);
            if (count == 0) break; // it became shorter meanwhile
            if (count > 0) got += static_cast<std::size_t>(count);
        }
        bytes.resize(got);
        return bytes;
    }

private:
    [[noreturn]] void fail(int error) const
    {
        throw IoError(path_.string() + ": cannot be read: " + std::generic_category().message(error));
    }

    const std::filesystem::path& path_;
    int descriptor_;
};

/// All of a model file. \throw IoError
std::string readFile(const std::filesystem::path& path)
{
    const std::string name = path.string();
    std::error_code error;
    const std::filesystem::file_status status = std::filesystem::status(path, error);
    if (std::filesystem::is_directory(status)) throw IoError(name + ": is a directory; a file is needed");
    formatOf(path);
    // Pipes and devices have no size and may never end.
    if (std::filesystem::exists(status) && !std::filesystem::is_regular_file(status)) {
        throw IoError(name + ": is not a regular file");
    }
    std::string bytes = File(path).readAll();
    if (bytes.empty()) throw IoError(name + ": the file is empty");
    return bytes;
}

/// \param text may be null; else gets all of the file
Mesh readMesh(const std::filesystem::path& path, ReadSummary* summary, std::string* text)
{
    try {
        std::string bytes = readFile(path);
        Mesh mesh = formatOf(path).parse(bytes, path.string(), summary);
        if (text) *text = std::move(bytes);
        return mesh;
    } catch (const std::bad_alloc&) {
        throw IoError(path.string() + ": there is not enough memory to read it");
    }
}

void requireFinitePoints(const std::vector<openvdb::Vec3d>& points, const std::string& name)
{
    for (std::size_t i = 0; i < points.size(); ++i) {
        const openvdb::Vec3d& p = points[i];
        if (!std::isfinite(p.x()) || !std::isfinite(p.y()) || !std::isfinite(p.z())) {
            throw InputError(name + ": point " + std::to_string(i) + " is not finite");
        }
    }
}

} // namespace

void requireMeshExtension(const std::filesystem::path& path)
{
    formatOf(path);
}

Mesh readMesh(const std::filesystem::path& path, ReadSummary* summary)
{
    return readMesh(path, summary, nullptr);
}

void writeMesh(const Mesh& mesh, const std::filesystem::path& path)
{
    requireMeshExtension(path);
    writeFileAtomically(path, [&](std::ostream& out) { writeMesh(mesh, out, path); });
}

void writeMesh(const Mesh& mesh, std::ostream& out, const std::filesystem::path& path)
{
    const std::string name = path.string();
    const Format& format = formatOf(path);
    requireUsable(mesh, name.c_str());
    requireFinitePoints(mesh.points, name);
    format.write(mesh, name, out);
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
    const bool isObj = formatOf(original).parse == detail::parseObj && formatOf(path).parse == detail::parseObj;
    requireFinitePoints(points, name);
    std::string text;
    Mesh mesh = readMesh(original, nullptr, &text);
    if (mesh.points.size() != points.size()) {
        throw InputError(name + ": " + std::to_string(points.size()) + " positions were given; " + original.string() +
                         " has " + std::to_string(mesh.points.size()) + " points");
    }
    if (isObj) {
        out << detail::movedObj(text, original.string(), points);
    } else {
        mesh.points = points;
        writeMesh(mesh, out, path);
    }
}

} // namespace vdbcage
