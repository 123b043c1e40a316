#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <vdbcage/bounding/detail/guard/contact_planes.h>
#include <vdbcage/bounding/detail/guard/star_change.h>

/// Decides the changes of a surface under a guard.
///
/// A change is allowed if the new star
/// - keeps clear of the model,
/// - is well shaped,
/// - keeps off the rest of the surface,
/// - sweeps over no part of the model.
namespace vdbcage::detail {

/// The findings of allows() about the model.
struct Obstacle {
    std::uint32_t item = TriangleBvh::none; ///< of the model: the last that was in the way, the first to try
    std::size_t clear = 0;                  ///< how many of the star's first triangles keep clear at the last place
};

/// Whether the star may have its centre at `p`.
/// \pre `p` is rounded as the guard asks
bool allows(const GuardedMesh& mesh, const StarChange& star, const Vec3d& p, Obstacle* obstacle = nullptr);

/// Makes the change at the first place that is allowed: `place`, raised by each of these heights, in parts of `length`.
bool applyNear(GuardedMesh& mesh, const StarChange& star, const Vec3d& place, double length,
               const std::array<double, 4>& heights);

/// The half-spaces that keep the star's centre, allowed at `from`, off what forbids it at `to`.
/// \pre `obstacle` is what allows() gave at `to`
void contacts(const GuardedMesh& mesh, const StarChange& star, const Vec3d& from, const Vec3d& to, Obstacle obstacle,
              std::vector<HalfSpace>& halfSpaces);

/// Makes a quad of two triangles that share an edge, if that is allowed. Returns whether.
///
/// The quad has to be convex. Its alternate diagonal joins no two vertices that are joined already. The guard allows
/// its alternates.
bool makeQuad(GuardedMesh& mesh, std::uint32_t f, std::uint32_t g);

/// Changes that were each allowed on the surface as it was when the batch began, made one after the other.
///
/// Moves and collapses only: splits and flips change faces that no vertex which moved is a corner of.
/// \pre allows() is not asked before the batch ends
class Batch {
public:
    explicit Batch(GuardedMesh& mesh) : mesh_(mesh) {}
    Batch(const Batch&) = delete;
    Batch& operator=(const Batch&) = delete;
    ~Batch();

    /// Makes the change, unless one made before it in the batch moved a vertex of its star or came into its way.
    bool apply(const StarChange& star, const Vec3d& p);

private:
    struct Made {
        Box box; // of the star
        std::uint32_t centre;
    };

    GuardedMesh& mesh_;
    std::vector<std::uint32_t> moved_; // vertices, ascending
    std::vector<Made> made_;
};

} // namespace vdbcage::detail
