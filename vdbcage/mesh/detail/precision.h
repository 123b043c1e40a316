#pragma once

#include <openvdb/math/BBox.h>
#include <vdbcage/core/export.h>
#include <vdbcage/core/precision.h>
#include <vdbcage/mesh/mesh.h>

namespace vdbcage::detail {

/// Whether the coordinates of cages around a model in `box` are rounded to float.
VDBCAGE_API bool areFloats(Precision precision, const openvdb::BBoxd& box);

/// Checks that float can hold cages around a model in `box`, where it is asked for: cages keep a distance of four times
/// its rounding.
/// \throw InputError beginning with "model: ", with the rounding, what is allowed, and the shift that would help
VDBCAGE_API void requireHeld(Precision precision, const openvdb::BBoxd& box);

/// The mesh with its points rounded to float.
VDBCAGE_API Mesh asFloats(Mesh mesh);

} // namespace vdbcage::detail
