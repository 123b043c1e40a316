#include <vdbcage/bounding/detail/loops/add_rings.h>

#include <utility>
#include <vector>

#include <vdbcage/bounding/detail/loops/loop_split.h>
#include <vdbcage/bounding/detail/quads/joint_rings.h>
#include <vdbcage/bounding/detail/quads/quad_relax.h>

namespace vdbcage::detail {

namespace {

/// Splits the first of some loops whose split the guard allows. Returns the new vertices; none if there is no such
/// loop.
std::vector<std::uint32_t> splitOneOf(const std::vector<QuadLoop>& loops, GuardedMesh& surface, QuadTable& table)
{
    for (const QuadLoop& loop : loops) {
        GuardedMesh changed = surface;
        QuadTable changedTable = table;
        std::vector<std::uint32_t> middle = splitLoop(changed, changedTable, loop);
        if (middle.empty()) continue;
        surface = std::move(changed);
        table = std::move(changedTable);
        return middle;
    }
    return {};
}

} // namespace

void addRings(GuardedMesh& surface, QuadTable& table, Interrupter* interrupter)
{
    constexpr int mostSplits = 4, sweeps = 2; // of one joint
    for (const Limb& limb : surface.wishes().limbs()) {
        for (int i = 0; i < mostSplits; ++i) {
            throwIfInterrupted(interrupter);
            const auto middle = splitOneOf(JointRings(surface, table).toSplit(limb), surface, table);
            if (middle.empty()) break;
            relaxQuads(surface, table, middle, sweeps, interrupter);
        }
    }
}

} // namespace vdbcage::detail
