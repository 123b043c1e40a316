#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <vector>

#include <vdbcage/check/detail/box_tree.h>
#include <vdbcage/check/detail/face_triangles.h>
#include <vdbcage/check/detail/predicates.h>
#include <vdbcage/core/detail/asker.h>
#include <vdbcage/core/interrupter.h>

namespace vdbcage::detail {

/// Flags that any thread may set and none clears.
using Flags = std::vector<std::atomic<bool>>;

inline void set(std::atomic<bool>& flag)
{
    flag.store(true, std::memory_order_relaxed);
}

inline bool isSet(const std::atomic<bool>& flag)
{
    return flag.load(std::memory_order_relaxed);
}

/// The cage in the form that its examinations need.
struct CageFaces {
    /// `cage` must outlive this.
    /// \pre `cage` has passed requireSound
    /// \throw Cancelled
    CageFaces(const Mesh& cage, Interrupter* interrupter)
        : mesh(cage), faces(cage), tree(mesh.points, faces.triangles(), BoxTree::Copies::keep, interrupter),
          degenerate(faces.size()), bad(faces.faces())
    {
        Asker ask(interrupter);
        for (std::size_t t = 0; t < faces.size(); ++t) {
            ask();
            degenerate[t] = isDegenerate(corners(t)) ? 1 : 0;
        }
    }

    Corners corners(std::size_t triangle) const
    {
        const Vec3I& t = faces[triangle];
        return {mesh.points[t[0]], mesh.points[t[1]], mesh.points[t[2]]};
    }

    const Mesh& mesh;
    FaceTriangles faces;
    BoxTree tree;
    std::vector<char> degenerate; ///< by triangle
    Flags bad;                    ///< by face
};

/// Counts the pairs of faces that meet in more than the corners and edges they share, and folded quads, up to
/// `mostSelfIntersections`. Marks all of these faces bad.
/// \throw Cancelled
/// Cost: O(n log n + candidates), in parallel.
std::size_t countSelfIntersections(CageFaces& cage, Interrupter* interrupter);

} // namespace vdbcage::detail
