#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include <vdbcage/bounding/detail/guard/star_change.h>
#include <vdbcage/geometry/quadric.h>

namespace vdbcage::detail {

/// A quadric for each vertex of a surface: of the faces around it when this was made, and of those around the vertices
/// merged into it since. Quadrics determine the cost of a collapse and the place of its vertex.
/// Based on: Garland and Heckbert, Surface Simplification Using Quadric Error Metrics, 1997.
class VertexQuadrics {
public:
    static constexpr double stiffness = 1e-3; ///< below this the planes leave a direction open

    /// `surface` must outlive this.
    explicit VertexQuadrics(const GuardedMesh& surface);

    /// Returns the quadric of the vertex that the ends of an edge are merged into.
    Quadric sum(std::uint32_t u, std::uint32_t v) const;
    const Quadric& of(std::uint32_t v) const { return quadrics_[v]; }
    void set(std::uint32_t v, const Quadric& q) { quadrics_[v] = q; }
    void merge(std::uint32_t u, std::uint32_t v) { quadrics_[u] += quadrics_[v]; }
    double cost(const Quadric& q, const Vec3d& p) const;
    /// Returns the place where `q` is least, or the middle of the edge if that is too far away.
    Vec3d optimum(const Quadric& q, std::uint32_t u, std::uint32_t v) const;
    /// Returns the same from `found` and `best` of Quadric::bestPlace().
    Vec3d optimum(bool found, const Vec3d& best, std::uint32_t u, std::uint32_t v) const;
    /// Returns an allowed place for a collapse: the best one, pushed outward until it is allowed. If `slides`, it is
    /// then moved back along the planes of its contacts.
    std::optional<Vec3d> findPlace(const StarChange& star, const Quadric& q, bool slides) const;

private:
    void slide(const StarChange& star, const Quadric& q, const Vec3d& best, Vec3d& place) const;

    const GuardedMesh& surface_;
    Vec3d origin_{0.0};
    std::vector<Quadric> quadrics_;
};

} // namespace vdbcage::detail
