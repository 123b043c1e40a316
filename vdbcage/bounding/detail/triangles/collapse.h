#pragma once

#include <cstddef>
#include <memory>

#include <vdbcage/bounding/detail/guard/guarded_mesh.h>
#include <vdbcage/core/interrupter.h>

/// Edge collapses under the guard, by quadric error. The result is the same for any number of threads.
namespace vdbcage::detail {

/// Collapses the edges that cost least, until `faces` are left or nothing more is allowed.
///
/// The cost is that of the place where the guard allows the vertex.
/// \throw Cancelled
/// Cost: O(n log n log m) for n faces and m of the model.
/// Based on: Garland and Heckbert, Surface Simplification Using Quadric Error Metrics, 1997.
void collapseByQuadrics(GuardedMesh& surface, std::size_t faces, Interrupter* interrupter);

/// Collapses batches of edges that cost least, until one leaves at most `faces`, or where no collapse is allowed any
/// more. A batch may leave a few faces less.
/// \throw Cancelled
/// Cost: as collapseByQuadrics().
void collapseInBatches(GuardedMesh& surface, std::size_t faces, Interrupter* interrupter);

/// The collapses of collapseInBatches(), recorded: each surface on the way can be had again. It takes the memory of two
/// surfaces.
///
/// The batches of collapses do not depend on what is asked for. So the answer does not depend on what was asked for
/// before.
/// Based on: Hoppe, Progressive Meshes, 1996.
class CollapseSequence {
public:
    explicit CollapseSequence(GuardedMesh start);
    ~CollapseSequence();
    CollapseSequence(CollapseSequence&&) noexcept;
    CollapseSequence& operator=(CollapseSequence&&) noexcept;

    /// Returns what collapseInBatches() makes of the start.
    /// \throw Cancelled; it can go on then
    /// Cost: as collapseByQuadrics(), but some microseconds for each collapse that was recorded.
    GuardedMesh at(std::size_t faces, Interrupter* interrupter);

private:
    class Recorder;
    std::unique_ptr<Recorder> recorder_;
};

} // namespace vdbcage::detail
