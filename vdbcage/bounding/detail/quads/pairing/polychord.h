#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include <vdbcage/bounding/detail/guard/guarded_mesh.h>

namespace vdbcage::detail {

/// Quads in a row from a triangle to another, or to the plane of symmetry; each is left across the side opposite to the
/// one that it is entered across.
struct Polychord {
    std::vector<std::array<std::uint32_t, 2>> sides; ///< those crossed, in the direction of the face before them
    std::vector<std::array<std::uint32_t, 2>> quads; ///< the faces of each
};

/// Returns the polychord that begins across side i of a triangle; none if it has more than `maxQuads` or meets itself.
std::optional<Polychord> polychordFrom(const GuardedMesh& surface, std::uint32_t triangle, int i, std::size_t maxQuads);

/// Splits a polychord lengthwise by a vertex on every side that it crosses, under the guard. Returns whether.
///
/// Each quad becomes two. The triangles at the ends become quads, with a corner pushed out. New vertices have no other
/// edges yet, so connectivity never forbids a quad. If the guard forbids the split, or the enclosed volume would grow
/// by more than `maxGrowth`, nothing changes.
/// Cost: O(faces), for copies to go back to.
bool splitPolychord(GuardedMesh& surface, const Polychord& polychord, double maxGrowth);

} // namespace vdbcage::detail
