#pragma once

#include <cstddef>
#include <limits>

#include <vdbcage/core/error.h>
#include <vdbcage/core/export.h>
#include <vdbcage/core/interrupter.h>
#include <vdbcage/mesh/mesh.h>
#include <vdbcage/pipeline/options.h>

namespace vdbcage {

/// As many bytes as there may be.
constexpr std::size_t unlimitedMemory = std::numeric_limits<std::size_t>::max();

/// Making a cage would take more memory than is allowed. Thrown before surfaces are made, which take most of it.
class VDBCAGE_API MemoryError : public Error {
public:
    using Error::Error;
    ~MemoryError() override;
};

/// About how many bytes a process holds at most that makes a cage: `vdbcage make`, with nothing else in it.
///
/// It is meant as an upper bound: docs/user/OPTIONS.md has how near the peak came. The surface of the closing takes
/// most; it is counted in coarse voxels. Grids of fields are not counted, nor is what a program makes of the result, as
/// pictures.
/// \throw InputError as Pipeline::run
/// \throw Cancelled
/// Cost: that of voxels and their closing at resolution 64, once.
VDBCAGE_API std::size_t predictedMemory(const Mesh& model, const CageOptions& options = {},
                                        Interrupter* interrupter = nullptr);

/// Does nothing where predictedMemory() is at most `limit` bytes.
/// \throw MemoryError it is more; names the finest resolution with which it is not, if there is one
/// \throw InputError as predictedMemory
/// \throw Cancelled
VDBCAGE_API void requireMemory(const Mesh& model, const CageOptions& options, std::size_t limit,
                               Interrupter* interrupter = nullptr);

} // namespace vdbcage
