#pragma once

#include <filesystem>
#include <iosfwd>
#include <vector>

#include <vdbcage/core/export.h>
#include <vdbcage/deform/binding.h>

namespace vdbcage {

/// Writes weights of computeWeights as a NumPy file (.npy, version 1.0, little endian).
///
/// It holds nothing but one record, whose fields `numpy.load(path)[NAME]` gives:
/// - `family` (S8, or S16 where the name has more than 8 letters): coordinatesName()
/// - `cage_hash` (uint64): of the cage's points and faces
/// - `points_hash` (uint64): of the points
/// - `weights` (float32, points x handles): see cageHandles for what the columns belong to
///
/// The hashes are FNV-1a of the counts, doubles and indices as bytes. The file appears whole or not at all.
/// \throw InputError their number is not points times handles; the file would have 2 GiB or more, which NumPy does not
/// take
/// \throw IoError naming the path
VDBCAGE_API void writeWeights(const Mesh& cage, const std::vector<openvdb::Vec3d>& points, Coordinates family,
                              const std::vector<float>& weights, const std::filesystem::path& path);

/// writeWeights() to a stream, whose state tells whether it took all. `path` is the name in errors.
VDBCAGE_API void writeWeights(const Mesh& cage, const std::vector<openvdb::Vec3d>& points, Coordinates family,
                              const std::vector<float>& weights, std::ostream& out, const std::filesystem::path& path);

/// Reads what writeWeights wrote, for the same cage and points; or weights that were made elsewhere, of any family, as
/// `Coordinates::given`.
///
/// The latter are a matrix with a row a point and a column a point of the cage. Files named .dmat are libigl's, as text
/// or binary. Others are NumPy's (.npy, version 1.0, 2.0 or 3.0): an array of two dimensions, `<f4` or `<f8`, in C or
/// Fortran order. A matrix does not tell for which cage and model it was made: its size and the sums of its rows are
/// all that is checked. Reading one takes the memory of its file beside that of the weights.
/// \throw IoError naming the path: it cannot be read, is truncated or no such file, or was made for another cage or
/// other points; a matrix of another size or transposed, of other numbers, with a weight not finite or a row whose sum
/// is not 1 within 1e-3
VDBCAGE_API Binding readWeights(const std::filesystem::path& path, const Mesh& cage,
                                std::vector<openvdb::Vec3d> points);

} // namespace vdbcage
