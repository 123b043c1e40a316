#include <vdbcage/bounding/detail/loops/loop_collapse.h>

#include <algorithm>
#include <map>
#include <optional>
#include <vector>

#include <vdbcage/bounding/detail/guard/admissible.h>

namespace vdbcage::detail {

namespace {

/// Returns a place for a rung's vertex: as for any edge, or farther out. A rung of a limb is short compared with the
/// limb that its vertex must clear.
std::optional<Vec3d> placeFor(const GuardedMesh& surface, const StarChange& star, const VertexQuadrics& quadrics)
{
    std::optional<Vec3d> place = quadrics.findPlace(star, quadrics.sum(star.centre, star.removed), true);
    const Vec3d a = surface.point(star.centre), b = surface.point(star.removed);
    const Vec3d up = outward(surface, star) * (a - b).length();
    for (const double height : {1.5, 3.0}) {
        if (place) break;
        const Vec3d target = rounded(surface, star, 0.5 * (a + b) + height * up);
        if (allows(surface, star, target)) place = target;
    }
    return place;
}

} // namespace

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
                  const std::function<bool(const std::vector<std::uint32_t>& kept)>& settle)
{
    std::vector<GuardedMesh::Saved> changes;
    std::vector<std::pair<std::uint32_t, Quadric>> sums; // before the changes
    std::vector<Rung> merges;
    std::map<std::uint32_t, std::uint32_t> into; // where a loop turns, a vertex is on two rungs
    const auto placeOf = [&](std::uint32_t v) {
        for (auto found = into.find(v); found != into.end(); found = into.find(v)) v = found->second;
        return v;
    };
    const auto collapseRung = [&](const Rung& rung) {
        const std::uint32_t kept = placeOf(rung[0]), removed = placeOf(rung[1]);
        StarChange star;
        if (!starOfCollapse(surface, kept, removed, star)) return false;
        const std::optional<Vec3d> place = placeFor(surface, star, quadrics);
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
        std::vector<std::uint32_t> kept;
        for (const auto& merge : merges) {
            if (surface.isVertex(merge[0])) kept.push_back(merge[0]);
        }
        std::sort(kept.begin(), kept.end());
        kept.erase(std::unique(kept.begin(), kept.end()), kept.end());
        std::vector<GuardedMesh::Saved> places;
        for (const std::uint32_t v : kept) places.push_back(surface.saved(starOf(surface, v)));
        if (settle(kept)) return true;
        for (const GuardedMesh::Saved& place : places) surface.restore(place);
        table.restore(quads);
    }
    for (std::size_t i = changes.size(); i-- > 0;) {
        surface.restore(changes[i]);
        quadrics.set(sums[i].first, sums[i].second);
    }
    return false;
}

} // namespace vdbcage::detail
