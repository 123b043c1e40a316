#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace vdbcage::detail {

/// Readers of weights that other programs made: matrices of `points` rows and `cagePoints` columns.
///
/// `bytes` are all of a file, `name` is its name in errors. The readers return the weights rounded to single precision,
/// row after row. They do not check whether the weights can pose; weightsProblem() does.
/// \throw IoError "NAME: PROBLEM": no such matrix; of another size, or transposed; of other numbers; truncated; bytes
/// behind it

/// Reads NumPy's .npy, versions 1.0, 2.0 and 3.0: a two-dimensional array of '<f4' or '<f8' in C or Fortran order.
std::vector<float> parseNpy(std::string_view bytes, const std::string& name, std::size_t points,
                            std::size_t cagePoints);

/// Reads libigl's .dmat, as text or binary. A text without a line end after its last number counts as truncated.
std::vector<float> parseDmat(std::string_view bytes, const std::string& name, std::size_t points,
                             std::size_t cagePoints);

/// Returns why weights made elsewhere, rows of `columns`, cannot pose: one is not finite, or a row's sum is not 1
/// within 1e-3. Returns an empty text if they can.
std::string weightsProblem(const std::vector<float>& weights, std::size_t columns);

} // namespace vdbcage::detail
