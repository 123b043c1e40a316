#pragma once

#include <functional>

#include <vdbcage/core/export.h>
#include <vdbcage/mesh/mesh.h>

namespace vdbcage {

struct TriquadOptions {
    double mergeAngleDegrees = 10; ///< largest dihedral angle between two triangles that become a quad, 0 to 180
};

/// Merges pairs of triangles into quads, flattest and squarest pairs first; concave and folded quads are never made,
/// and no two faces come to share two edges. `accept`, if set, has the last word on each pair: it is given the quad's
/// corners (the merged edge runs from corner 0 to corner 2). Points keep their order. O(n log n).
/// \throw InputError
VDBCAGE_API Mesh triquad(const Mesh& triangles, const TriquadOptions& options = {},
                         const std::function<bool(const openvdb::Vec4I&)>& accept = {});

} // namespace vdbcage
