#include <tools/view/state/opened_mesh.h>

#include <system_error>
#include <utility>

#include <vdbcage/core/detail/hash.h>
#include <vdbcage/core/detail/read_file.h>

namespace vdbcage::view {

namespace fs = std::filesystem;

FileStamp stampOf(const fs::path& path)
{
    std::error_code error;
    FileStamp stamp;
    stamp.bytes = fs::file_size(path, error);
    if (error) return {};
    stamp.changed = fs::last_write_time(path, error);
    return error ? FileStamp{} : stamp;
}

std::string digestOf(const fs::path& path)
{
    detail::Hash hash;
    hash.add(detail::readFile(path));
    return hash.digits();
}

OpenedMeshPtr openMesh(const fs::path& given)
{
    std::error_code error;
    fs::path path = fs::absolute(given, error).lexically_normal();
    if (error) path = given;
    const FileStamp stamp = stampOf(path);
    MeshFile file = readMeshFile(path);
    return std::make_shared<const OpenedMesh>(OpenedMesh{std::move(path), stamp, std::move(file.mesh), file.summary});
}

} // namespace vdbcage::view
