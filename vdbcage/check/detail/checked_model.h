#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <vdbcage/check/detail/box_tree.h>
#include <vdbcage/check/detail/face_triangles.h>
#include <vdbcage/core/detail/nearest_float.h>
#include <vdbcage/core/interrupter.h>
#include <vdbcage/geometry/triangle_bvh.h>

namespace vdbcage::detail {

/// \throw InputError an index is not below the number of points; a point of a face is not finite
void requireSound(const Mesh& mesh, const char* what);

/// Facts about a model, computed once: its triangles in trees, and its parts.
///
/// A part consists of faces connected by shared vertices. Vertices are shared by index. Where triangles were dropped as
/// copies of others, points in one place count as shared too.
struct CheckedModel {
    /// \throw InputError no faces; as requireSound
    /// \throw Cancelled
    CheckedModel(const Mesh& mesh, Interrupter* interrupter);

    std::size_t parts() const { return partFirst.size() - 1; }

    /// The model as it is, or with its points rounded to float.
    struct View {
        const CheckedModel& model;
        bool asFloats;

        Vec3d point(std::uint32_t i) const
        {
            const Vec3d& p = model.tree.points()[i];
            return asFloats ? nearestFloat(p) : p;
        }
        Corners corners(const BoxTree::Item& item) const
        {
            return {point(item.corners[0]), point(item.corners[1]), point(item.corners[2])};
        }
        /// Returns how far its triangles may lie from those in the trees.
        double maxDistance() const
        {
            return asFloats ? 2 * floatRounding({model.tree.box().lo, model.tree.box().hi}) : 0;
        }
    };

    // The trees hold all four triangles of a quad. They drop copies, `tree` only those that make it slow.
    BoxTree candidates;                      ///< for the verdict
    TriangleBvh tree;                        ///< for distances; it has the points
    std::size_t usedVertices = 0;            ///< points that faces use
    std::vector<std::uint32_t> loosePoints;  ///< the others
    std::vector<std::uint32_t> partOfPoint;  ///< only for these
    std::vector<std::uint32_t> partVertices; ///< the vertices of part k are partVertices[partFirst[k]] ...
    std::vector<std::size_t> partFirst;      ///< ... partVertices[partFirst[k + 1] - 1]
    double longestSide = 0, diagonal = 0;    ///< of the bounding box
    double volume = 0;                       ///< 0 if the model has no inside
    std::size_t hollows = 0;                 ///< countHollows()

private:
    void findParts(const Mesh& mesh, const FaceTriangles& faces, bool joinPlaces, Interrupter* interrupter);
};

} // namespace vdbcage::detail
