#pragma once

#include <cstddef>
#include <memory>

#include <vdbcage/bounding/detail/guard/guarded_mesh.h>
#include <vdbcage/core/interrupter.h>

/// Edge collapses under the guard, by quadric error. The result is the same for any number of threads.
namespace vdbcage::detail {

/// Collapses the edges that cost least, until `faces` are left or no collapse is allowed.
///
/// The cost is that of the place where the guard allows the vertex.
/// \throw Cancelled
/// Cost: O(n log n log m) for n faces and m of the model.
/// Based on: Garland and Heckbert, Surface Simplification Using Quadric Error Metrics, 1997.
void collapseByQuadrics(GuardedMesh& surface, std::size_t faces, Interrupter* interrupter);

/// Collapses batches of the edges that cost least, until one leaves at most `faces` or no collapse is allowed. The last
/// batch may leave a few faces less.
/// \throw Cancelled
/// Cost: as collapseByQuadrics().
void collapseInBatches(GuardedMesh& surface, std::size_t faces, Interrupter* interrupter);

/// A record of the collapses of collapseInBatches(), from which at() makes each surface on the way again. It takes the
/// memory of two surfaces.
///
/// The batches do not depend on the number of faces asked for, so results do not depend on earlier calls.
/// Based on: Hoppe, Progressive Meshes, 1996.
class CollapseSequence {
public:
    explicit CollapseSequence(GuardedMesh start);
    ~CollapseSequence();
    CollapseSequence(CollapseSequence&&) noexcept;
    CollapseSequence& operator=(CollapseSequence&&) noexcept;

    /// Returns the start after collapseInBatches().
    /// \throw Cancelled; it can go on then
    /// Cost: as collapseByQuadrics(), but some microseconds for each collapse that was recorded.
    GuardedMesh at(std::size_t faces, Interrupter* interrupter);

private:
    class Recorder;
    std::unique_ptr<Recorder> recorder_;
};

} // namespace vdbcage::detail
