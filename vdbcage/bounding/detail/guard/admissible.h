#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <vdbcage/bounding/detail/guard/contact_planes.h>
#include <vdbcage/bounding/detail/guard/star_change.h>

/// Tests and makes changes of a surface under a guard.
///
/// The guard allows a change if the new star
/// - keeps clear of the model,
/// - is well shaped,
/// - keeps off the rest of the surface,
/// - sweeps over no part of the model.
namespace vdbcage::detail {

/// The part of the model that was in a star's way.
struct Obstacle {
    std::uint32_t item = TriangleBvh::none; ///< of the model: the last in the way, the first to try next time
    std::size_t clear = 0;                  ///< the number of the star's first triangles that kept clear
};

/// Returns whether the star may have its centre at `p`.
/// \pre `p` is rounded as the guard asks
bool allows(const GuardedMesh& mesh, const StarChange& star, const Vec3d& p, Obstacle* obstacle = nullptr);

/// Makes the change at the first allowed place: `place`, raised by each of `heights` times `length`. Returns whether.
bool applyNear(GuardedMesh& mesh, const StarChange& star, const Vec3d& place, double length,
               const std::array<double, 4>& heights);

/// Adds the half-spaces that keep the star's centre, allowed at `from`, off the obstacles at `to`.
/// \pre allows() set `obstacle` at `to`
void contacts(const GuardedMesh& mesh, const StarChange& star, const Vec3d& from, const Vec3d& to, Obstacle obstacle,
              std::vector<HalfSpace>& halfSpaces);

/// Makes a quad of two triangles that share an edge, if that is allowed. Returns whether.
///
/// The quad must be convex, its alternate diagonal must not join two vertices that an edge joins already, and the guard
/// must allow its alternates.
bool makeQuad(GuardedMesh& mesh, std::uint32_t f, std::uint32_t g);

/// Changes made one after the other, each of them allowed on the surface as it was when the batch began.
///
/// Moves and collapses only: splits and flips change faces without a corner at a vertex that moved.
/// \pre allows() is not called before the batch ends
class Batch {
public:
    explicit Batch(GuardedMesh& mesh) : mesh_(mesh) {}
    Batch(const Batch&) = delete;
    Batch& operator=(const Batch&) = delete;
    ~Batch();

    /// Makes the change, unless an earlier one of the batch moved a vertex of its star or is in its way. Returns
    /// whether.
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
