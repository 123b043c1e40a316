#pragma once

#include <filesystem>
#include <iosfwd>
#include <vector>

#include <vdbcage/core/export.h>
#include <vdbcage/deform/binding.h>

namespace vdbcage {

/// Writes weights as a NumPy file, which \ref deform describes. It appears whole or not at all.
/// \param cage the one that the weights were made for
/// \param points those that the weights were made for
/// \param family of the weights
/// \param weights points x handles, row after row, as computeWeights() returns them
/// \param path of the file to write, whatever its extension
/// \throw InputError when the number of weights is not points times handles; when the file would have 2 GiB or more,
/// which NumPy does not take
/// \throw IoError when it cannot be written; names the path
VDBCAGE_API void writeWeights(const Mesh& cage, const std::vector<openvdb::Vec3d>& points, Coordinates family,
                              const std::vector<float>& weights, const std::filesystem::path& path);

/// As writeWeights() above, to a stream, whose state tells whether it took all. `path` is only the name in errors.
VDBCAGE_API void writeWeights(const Mesh& cage, const std::vector<openvdb::Vec3d>& points, Coordinates family,
                              const std::vector<float>& weights, std::ostream& out, const std::filesystem::path& path);

/// Reads a file of writeWeights(), or a matrix that was made elsewhere, as `Coordinates::given`. \ref deform describes
/// both.
/// \param path a file of writeWeights(); a NumPy file (.npy); or libigl's, which is named .dmat
/// \param cage the one that the weights were made for
/// \param points at rest, those that the weights were made for
/// \throw IoError when the file cannot be read, is truncated, is no weights file, or was made for another cage or other
/// points; when a matrix has another size, is transposed, has other numbers, a weight that is not finite, or a row
/// whose sum is not 1 within 1e-3; names the path
VDBCAGE_API Binding readWeights(const std::filesystem::path& path, const Mesh& cage,
                                std::vector<openvdb::Vec3d> points);

} // namespace vdbcage
