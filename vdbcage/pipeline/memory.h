#pragma once

#include <cstddef>
#include <limits>

#include <vdbcage/core/error.h>
#include <vdbcage/core/export.h>
#include <vdbcage/core/interrupter.h>
#include <vdbcage/mesh/mesh.h>
#include <vdbcage/pipeline/options.h>

namespace vdbcage {

/// The memory limit that allows any number of bytes.
constexpr std::size_t unlimitedMemory = std::numeric_limits<std::size_t>::max();

/// The error that making a cage would take more memory than is allowed. It is thrown before surfaces are made, which
/// take most of it.
class VDBCAGE_API MemoryError : public Error {
public:
    using Error::Error;
    ~MemoryError() override;
};

/// Returns about the most bytes that a process holds which makes a cage: `vdbcage make`, with nothing else in it.
///
/// It is meant as an upper bound; docs/user/OPTIONS.md tells how near the peak came. The surface of the closing takes
/// most, and is counted in coarse voxels. Grids of fields are not counted, nor are things that a program makes of the
/// result, such as pictures.
/// \param model as for Pipeline
/// \param options as for requireValid()
/// \param interrupter asked whether to stop, but told of no stage; may be null
/// \throw InputError as Pipeline::run()
/// \throw Cancelled when asked to stop
/// Cost: that of voxels, their closing and its surface, at a resolution of up to 512 if it is not given and many faces
/// are asked for, and at up to 64. Where specks take most of the longest side: several times, and at up to 1024.
VDBCAGE_API std::size_t predictedMemory(const Mesh& model, const CageOptions& options = {},
                                        Interrupter* interrupter = nullptr);

/// Checks that predictedMemory() is at most a limit.
/// \param model as for Pipeline
/// \param options as for requireValid()
/// \param limit bytes
/// \param interrupter as for predictedMemory()
/// \throw MemoryError when it is more; names the finest resolution with which it is not, if there is one
/// \throw InputError as predictedMemory()
/// \throw Cancelled when asked to stop
VDBCAGE_API void requireMemory(const Mesh& model, const CageOptions& options, std::size_t limit,
                               Interrupter* interrupter = nullptr);

} // namespace vdbcage
