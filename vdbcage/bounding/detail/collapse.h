#pragma once

#include <cstddef>
#include <memory>

#include <vdbcage/bounding/detail/guarded_mesh.h>
#include <vdbcage/core/interrupter.h>

/// Edge collapses under the guard. Costs are found side by side; the result is the same for any number of threads.
namespace vdbcage::detail {

/// Collapses edges by their quadric error, as it is where the guard allows the vertex, until `faces` are left or
/// nothing more is allowed. O(n log n) and fast.
void collapseByQuadrics(GuardedMesh& surface, std::size_t faces, Interrupter* interrupter);

/// Collapses by quadric error that are recorded: each surface on the way can be had again. They are made in batches
/// that do not depend on what is asked for, so neither does the answer depend on what was asked for before.
class CollapseSequence {
public:
    explicit CollapseSequence(GuardedMesh start);
    ~CollapseSequence();
    CollapseSequence(CollapseSequence&&) noexcept;
    CollapseSequence& operator=(CollapseSequence&&) noexcept;

    /// The surface after the first batch that leaves at most `faces` (a few less, then), or where no collapse is
    /// allowed any more. Collapses that were recorded take some microseconds each. After Cancelled it can go on.
    GuardedMesh at(std::size_t faces, Interrupter* interrupter);

private:
    class Recorder;
    std::unique_ptr<Recorder> recorder_;
};

} // namespace vdbcage::detail
