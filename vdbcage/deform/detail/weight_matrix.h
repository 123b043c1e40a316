#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace vdbcage::detail {

/// Readers of weights that other programs made: matrices of `points` rows and `cagePoints` columns.
///
/// `bytes` are all of a file, `name` is its name in errors. They return the weights rounded to single precision, row
/// after row. Whether they can pose is left to weightsProblem().
/// \throw IoError "NAME: PROBLEM": no such matrix; of another size, or transposed; of other numbers; truncated; bytes
/// behind it

/// NumPy's .npy of the versions 1.0, 2.0 and 3.0: a two-dimensional array of '<f4' or '<f8' in C or Fortran order.
std::vector<float> parseNpy(std::string_view bytes, const std::string& name, std::size_t points,
                            std::size_t cagePoints);

/// libigl's .dmat, as text or binary. A text has a line end behind its last number, else it counts as truncated.
std::vector<float> parseDmat(std::string_view bytes, const std::string& name, std::size_t points,
                             std::size_t cagePoints);

/// Why weights that were made elsewhere, rows of `columns`, cannot pose; empty if they can. One is not finite, or a
/// row's sum is not 1 within 1e-3.
std::string weightsProblem(const std::vector<float>& weights, std::size_t columns);

} // namespace vdbcage::detail
