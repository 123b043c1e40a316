#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include <vdbcage/bounding/detail/guard/guarded_mesh.h>
#include <vdbcage/core/interrupter.h>

/// The places that a surface has to move to before it bounds a model.
namespace vdbcage::detail {

/// A half-space in which a point of a surface has to be. The point is a mean of corners of a face.
struct Demand {
    Vec3I corners;      ///< vertices
    Vec3d weights;      ///< of the corners: 0 to 1, of sum 1
    Vec3d normal;       ///< of length 1, outward
    double offset;      ///< normal . point must be at least this
    std::uint32_t face; ///< that the point is on, or alternate

    /// Returns the point, with corners at these places.
    Vec3d point(const std::vector<Vec3d>& places) const
    {
        return weights[0] * places[corners[0]] + weights[1] * places[corners[1]] + weights[2] * places[corners[2]];
    }
    /// Returns the distance that the point is short of its half-space; negative inside.
    double lack(const GuardedMesh& surface) const
    {
        double sum = offset;
        for (const int i : {0, 1, 2}) sum -= weights[i] * normal.dot(surface.point(corners[i]));
        return sum;
    }
};

/// Finds the demands of a model on a surface that may cut it, again and again while it moves. The surface must not
/// cross itself.
class DemandFinder {
public:
    /// Samples the model: a point of each connected part, and one in each cell of a grid that the model meets.
    DemandFinder(const GuardModel& model, Interrupter* interrupter);

    /// Returns the demands of samples that are outside: that the surface is beyond each by a margin, where it is
    /// nearest, under the split of its quads that is worse.
    std::vector<Demand> ofSamples(const GuardedMesh& surface);
    /// Returns the same of a surface of triangles. `face` of demands is a number of these.
    std::vector<Demand> ofSamples(const std::vector<Vec3d>& points, const std::vector<Vec3I>& triangles);
    /// Returns the demands of faces and alternates that may cut the model and do: that all of it is beneath them.
    std::vector<Demand> ofContacts(const GuardedMesh& surface) const;
    std::size_t samples() const { return samples_.size(); }
    /// Returns the plane of symmetry. Samples are of the model's half beyond it.
    const std::optional<SymmetryPlane>& symmetry() const { return model_.symmetry(); }
    double distanceToModel(const Vec3d& p) const;

private:
    class SplitSurface;
    std::vector<Demand> ofSamples(const std::vector<Vec3d>& points, const SplitSurface& first,
                                  const SplitSurface* second);

    bool isBehind(const Vec3d& p) const;

    const GuardModel& model_;
    double margin_;
    std::vector<Vec3d> samples_;
    std::vector<double> safeUntil_; // by sample: it is inside as long as no vertex has moved farther in all
    std::vector<Vec3d> before_;     // the vertices of the surface at the last call
    double moved_ = 0;              // since the first call: the farthest that a vertex may have moved
    std::uint32_t faces_ = 0;       // of the surface at the last call: with more of them, quads have new splits
};

} // namespace vdbcage::detail
