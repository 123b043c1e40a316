#pragma once

#include <vector>

#include <vdbcage/bounding/detail/guard/vertex_placement.h>
#include <vdbcage/core/interrupter.h>

/// Keeps a surface as it was drawn, as far as its guard allows.
namespace vdbcage::detail {

/// Moves vertices back to their places as drawn, all the way where that is allowed, else as near as their contacts let
/// them.
/// \param drawn the places, by vertex
/// \throw Cancelled
void moveBack(GuardedMesh& surface, const std::vector<Vec3d>& drawn, Interrupter* interrupter);

/// The deviation of a surface from its shape as drawn, as a term added to the integral of the distance: the ways of its
/// vertices, and by how much those of neighbours differ.
class DrawnShapeTerm final : public ShapeTerm {
public:
    /// \param drawn the places of the vertices; it must outlive this
    /// \param weight of a vertex whose way is as long as a mean edge, over that of the distance by as much
    DrawnShapeTerm(const GuardedMesh& surface, const std::vector<Vec3d>& drawn, double weight);

    double add(const GuardedMesh& surface, const StarChange& star, const Vec3d& centre,
               Quadratic& change) const override;
    bool keepsFit(const GuardedMesh&, const StarChange&, const Vec3d&) const override { return true; }

private:
    const std::vector<Vec3d>& drawn_;
    double ofWay_, ofDifference_; // weights of squares of lengths
};

} // namespace vdbcage::detail
