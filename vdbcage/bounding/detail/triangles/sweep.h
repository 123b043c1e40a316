#pragma once

#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <optional>
#include <vector>

#include <vdbcage/bounding/detail/guard/admissible.h>
#include <vdbcage/bounding/detail/guard/vertex_placement.h>
#include <vdbcage/core/detail/parallel.h>
#include <vdbcage/core/interrupter.h>

/// Sweeps over the vertices of a surface, the same for any number of threads.
namespace vdbcage::detail {

/// Returns the vertices in groups without neighbours among each other, by greedy colouring in index order.
std::vector<std::vector<std::uint32_t>> independentGroups(const GuardedMesh& surface,
                                                          const std::vector<std::uint32_t>& vertices);

std::vector<std::uint32_t> allVertices(const GuardedMesh& surface);

/// Returns the first allowed place on the way to `goal`, by `steps` in parts of it, at which `shape`, if given, keeps
/// quads fit.
std::optional<Vec3d> towards(const GuardedMesh& surface, const StarChange& star, const Vec3d& goal,
                             std::initializer_list<double> steps, const ShapeTerm* shape = nullptr);

/// Moves each vertex to the allowed place that propose(v, star) returns, if any; then calls moved(v, star, done).
/// propose() may run on any thread.
template <typename Propose, typename Moved>
void sweep(GuardedMesh& surface, const std::vector<std::uint32_t>& vertices, Interrupter* interrupter,
           const Propose& propose, const Moved& moved)
{
    constexpr std::size_t batch = 128;
    struct Proposal {
        StarChange star;
        std::optional<Vec3d> place;
    };
    std::vector<Proposal> proposals;
    for (const auto& group : independentGroups(surface, vertices)) {
        // Numbers mostly follow the place, so a batch takes vertices spread over the group: its changes are far apart.
        const std::size_t batches = (group.size() + batch - 1) / batch;
        for (std::size_t first = 0; first < batches; ++first) {
            const std::size_t count = (group.size() - first + batches - 1) / batches;
            proposals.assign(count, {});
            parallelFor(std::size_t(0), count, [&](std::size_t i) {
                throwIfInterrupted(interrupter); // each time: a place may take a millisecond
                const std::uint32_t v = group[first + i * batches];
                proposals[i].star = starOf(surface, v);
                proposals[i].place = propose(v, proposals[i].star);
            });
            Batch changes(surface);
            for (std::size_t i = 0; i < count; ++i) {
                const bool done = proposals[i].place && changes.apply(proposals[i].star, *proposals[i].place);
                moved(group[first + i * batches], proposals[i].star, done);
            }
        }
    }
}

/// Moves each vertex to the allowed place that propose(v, star) returns, if any.
template <typename Propose>
void sweep(GuardedMesh& surface, const std::vector<std::uint32_t>& vertices, Interrupter* interrupter,
           const Propose& propose)
{
    sweep(surface, vertices, interrupter, propose, [](std::uint32_t, const StarChange&, bool) {});
}

} // namespace vdbcage::detail
