#include <vdbcage/bounding/detail/loop_collapse.h>

#include <map>
#include <optional>
#include <vector>

#include <vdbcage/bounding/detail/admissible.h>

namespace vdbcage::detail {

double collapseCost(const VertexQuadrics& quadrics, const QuadLoop& loop)
{
    double sum = 0;
    for (const auto& [u, v] : loop.rungs) {
        const Quadric q = quadrics.sum(u, v);
        sum += quadrics.cost(q, quadrics.optimum(q, u, v));
    }
    return sum;
}

bool collapseLoop(GuardedMesh& surface, QuadTable& table, VertexQuadrics& quadrics, const QuadLoop& loop,
                  const std::function<bool()>& accepts)
{
    std::vector<GuardedMesh::Saved> changes;
    std::vector<std::pair<std::uint32_t, Quadric>> sums; // before the changes
    std::vector<Rung> merges;
    std::map<std::uint32_t, std::uint32_t> into; // where a loop turns a vertex is on two rungs
    const auto placeOf = [&](std::uint32_t v) {
        for (auto found = into.find(v); found != into.end(); found = into.find(v)) v = found->second;
        return v;
    };
    const auto collapseRung = [&](const Rung& rung) {
        const std::uint32_t kept = placeOf(rung[0]), removed = placeOf(rung[1]);
        StarChange star;
        if (!starOfCollapse(surface, kept, removed, star)) return false;
        const std::optional<Vec3d> place = quadrics.findPlace(star, quadrics.sum(kept, removed), true);
        if (!place) return false;
        changes.push_back(surface.saved(star));
        surface.apply(star, *place);
        sums.emplace_back(kept, quadrics.of(kept));
        quadrics.merge(kept, removed);
        into[removed] = kept;
        merges.push_back({kept, removed});
        return true;
    };
    bool isDone = true;
    for (std::size_t i = 0; isDone && i < loop.rungs.size(); ++i) isDone = collapseRung(loop.rungs[i]);
    if (isDone) {
        const QuadTable::Saved quads = table.saved(cornersOf(table, loop.quads));
        for (const std::uint32_t q : loop.quads) table.remove(q);
        for (const auto& [kept, removed] : merges) table.merge(kept, removed);
        if (accepts()) return true;
        table.restore(quads);
    }
    for (std::size_t i = changes.size(); i-- > 0;) {
        surface.restore(changes[i]);
        quadrics.set(sums[i].first, sums[i].second);
    }
    return false;
}

} // namespace vdbcage::detail
