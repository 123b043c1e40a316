#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

/// Weights that other programs made: matrices of `points` rows and `cagePoints` columns.
namespace vdbcage::detail {

/// Reads NumPy's .npy, versions 1.0, 2.0 and 3.0: a two-dimensional array of '<f4' or '<f8' in C or Fortran order.
///
/// `bytes` are all of a file, `name` is its name in errors. The weights are returned rounded to single precision, row
/// after row. weightsProblem() tells whether they can pose; this does not.
/// \throw IoError "NAME: PROBLEM": no such matrix; of another size, or transposed; of other numbers; truncated; bytes
/// behind it
std::vector<float> parseNpy(std::string_view bytes, const std::string& name, std::size_t points,
                            std::size_t cagePoints);

/// Reads libigl's .dmat, as text or binary, in the same way. A text without a line end after its last number counts as
/// truncated.
/// \throw IoError as parseNpy()
std::vector<float> parseDmat(std::string_view bytes, const std::string& name, std::size_t points,
                             std::size_t cagePoints);

/// Returns why weights made elsewhere, rows of `columns`, cannot pose: one is not finite, or a row's sum is not 1
/// within 1e-3. Returns an empty text if they can.
std::string weightsProblem(const std::vector<float>& weights, std::size_t columns);

} // namespace vdbcage::detail
