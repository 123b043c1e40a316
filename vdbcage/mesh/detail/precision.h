#pragma once

#include <openvdb/math/BBox.h>
#include <vdbcage/core/export.h>
#include <vdbcage/core/precision.h>
#include <vdbcage/mesh/mesh.h>

namespace vdbcage::detail {

/// Returns whether the coordinates of cages around a model in `box` are rounded to float.
VDBCAGE_API bool areFloats(Precision precision, const openvdb::BBoxd& box);

/// Checks that float, if `precision` asks for it, can hold cages around a model in `box`: cages keep a distance of four
/// times its rounding.
/// \throw InputError beginning with "model: ", with the rounding, the allowed one, and the shift that would help
VDBCAGE_API void requireHeld(Precision precision, const openvdb::BBoxd& box);

/// Returns the mesh with its points rounded to float.
VDBCAGE_API Mesh asFloats(Mesh mesh);

} // namespace vdbcage::detail
