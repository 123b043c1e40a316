#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include <vdbcage/mesh/mesh_io.h>

namespace vdbcage::view {

/// The size and time of a file, by which a change is noticed.
struct FileStamp {
    std::uintmax_t bytes = 0;
    std::filesystem::file_time_type changed{};

    friend bool operator==(const FileStamp& a, const FileStamp& b)
    {
        return a.bytes == b.bytes && a.changed == b.changed;
    }
    friend bool operator!=(const FileStamp& a, const FileStamp& b) { return !(a == b); }
};

/// Returns the stamp of the file at `path`; all zero if there is none.
FileStamp stampOf(const std::filesystem::path& path);

/// Returns 16 hexadecimal digits of the file's bytes: for files that changed by chance, not by intent.
/// \throw IoError
/// Cost: one pass.
std::string digestOf(const std::filesystem::path& path);

/// A model or cage as read from a file. It never changes, so all users share it.
struct OpenedMesh {
    std::filesystem::path path; ///< absolute
    FileStamp stamp;            ///< of the file, before it was read
    Mesh mesh;
    ReadSummary summary;
};
using OpenedMeshPtr = std::shared_ptr<const OpenedMesh>;
using MeshPtr = std::shared_ptr<const Mesh>;

/// Reads the mesh at `path`. \throw IoError as readMeshFile
OpenedMeshPtr openMesh(const std::filesystem::path& path);

} // namespace vdbcage::view
