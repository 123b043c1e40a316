// Based on: Daniels, Silva, Shepherd, Cohen, "Quadrilateral Mesh Simplification", 2008 (polychords and their collapse).

#include <vdbcage/bounding/detail/quads/quad_loop.h>

#include <algorithm>
#include <array>
#include <map>
#include <utility>

namespace vdbcage::detail {

namespace {

constexpr std::uint32_t none = QuadTable::none;

/// A quad and the side across which it is entered.
struct Entry {
    std::uint32_t quad;
    int side;
};

Rung sideOf(const QuadTable& table, const Entry& at)
{
    const Vec4I& ids = table.corners(at.quad);
    return {ids[at.side], ids[(at.side + 1) % 4]};
}

/// Returns whether a loop passes no quad twice.
bool isSimple(const QuadLoop& loop)
{
    std::vector<std::uint32_t> sorted = loop.quads;
    std::sort(sorted.begin(), sorted.end());
    return std::adjacent_find(sorted.begin(), sorted.end()) == sorted.end();
}

/// Goes straight on.
Entry next(const QuadTable& table, const Entry& at)
{
    const auto [a, b] = sideOf(table, {at.quad, (at.side + 2) % 4});
    const std::uint32_t quad = table.quadAt(b, a);
    return {quad, quad == none ? 0 : table.sideOf(quad, b, a)};
}

} // namespace

std::vector<QuadLoop> straightLoops(const QuadTable& table)
{
    std::vector<std::array<bool, 2>> isSeen(table.quads(), {false, false}); // by direction
    const auto seen = [&](const Entry& at) -> bool& { return isSeen[at.quad][std::size_t(at.side % 2)]; };
    std::vector<QuadLoop> loops;
    for (std::uint32_t q = 0; q < table.quads(); ++q) {
        if (!table.isQuad(q)) continue;
        for (const int side : {0, 1}) {
            Entry at{q, side};
            if (seen(at)) continue;
            // Goes back to the plane, if there is one on the way.
            Entry first = at;
            for (Entry back{q, (side + 2) % 4};;) {
                first = {back.quad, (back.side + 2) % 4};
                back = next(table, back);
                if (back.quad == none) break;
                if (back.quad == q && back.side % 2 == side) {
                    first = at;
                    break;
                }
            }
            QuadLoop loop;
            for (at = first; at.quad != none && !seen(at);) {
                seen(at) = true;
                loop.rungs.push_back(sideOf(table, at));
                loop.quads.push_back(at.quad);
                const Entry on = next(table, at);
                if (on.quad == none) {
                    const auto [a, b] = sideOf(table, {at.quad, (at.side + 2) % 4});
                    loop.rungs.push_back({b, a}); // as the quad beyond would be entered
                }
                at = on;
            }
            if (isSimple(loop)) loops.push_back(std::move(loop));
        }
    }
    return loops;
}

namespace {

/// A part of a closed loop: from quad `first` to quad `last`, forward.
struct Arc {
    const QuadLoop* loop;
    std::size_t first, last;

    std::size_t length() const { return (last + loop->quads.size() - first) % loop->quads.size(); }
    std::size_t at(std::size_t i) const { return (first + i) % loop->quads.size(); }
    /// Return the rungs at its ends.
    const Rung& firstRung() const { return loop->rungs[at(1)]; }
    const Rung& lastRung() const { return loop->rungs[last]; }
};

/// Returns the growth of the irregularity |valence - 4| of a quad's corners where a loop turns in it; `one` and `other`
/// are its rungs.
int turnGrowth(const GuardedMesh& surface, const QuadTable& table, std::uint32_t q, const Rung& one, const Rung& other)
{
    const auto irregularity = [](int edges) { return std::abs(edges - 4); };
    const std::uint32_t inner = one[0] == other[0] || one[0] == other[1] ? one[0] : one[1];
    int merged = -7, growth = 0; // of three vertices whose edges fall together
    for (int i = 0; i < 4; ++i) {
        const std::uint32_t v = table.corners(q)[i];
        const auto edges = static_cast<int>(valence(surface, table, v));
        growth -= irregularity(edges);
        if (table.corners(q)[(i + 2) % 4] == inner) {
            growth += irregularity(edges - 1);
        } else {
            merged += edges;
        }
    }
    return growth + irregularity(merged);
}

/// Returns the loop along one arc and back along another, from its beginning or, if `isBackward`, from its end.
QuadLoop joined(const Arc& a, const Arc& b, bool isBackward)
{
    QuadLoop loop;
    for (std::size_t i = 0; i <= a.length(); ++i) {
        loop.quads.push_back(a.loop->quads[a.at(i)]);
        if (i > 0) loop.rungs.push_back(a.loop->rungs[a.at(i)]);
    }
    for (std::size_t i = 1; i <= b.length(); ++i) {
        const std::size_t rung = isBackward ? b.length() + 1 - i : i, quad = isBackward ? b.length() - i : i;
        loop.rungs.push_back(b.loop->rungs[b.at(rung)]);
        if (i < b.length()) loop.quads.push_back(b.loop->quads[b.at(quad)]);
    }
    return loop;
}

} // namespace

std::vector<QuadLoop> turningLoops(const GuardedMesh& surface, const QuadTable& table)
{
    struct Place {
        std::size_t loop, at;
    };
    const std::vector<QuadLoop> straight = straightLoops(table);
    std::vector<std::vector<Place>> placesOf(table.quads());
    for (std::size_t l = 0; l < straight.size(); ++l) {
        if (!straight[l].isClosed()) continue;
        for (std::size_t i = 0; i < straight[l].quads.size(); ++i) placesOf[straight[l].quads[i]].push_back({l, i});
    }
    std::vector<QuadLoop> loops;
    const auto addIfSimple = [&](const Arc& a, const Arc& b, bool isBackward) {
        const std::uint32_t begin = a.loop->quads[a.first], end = a.loop->quads[a.last];
        const Rung &atBegin = isBackward ? b.firstRung() : b.lastRung(),
                   &atEnd = isBackward ? b.lastRung() : b.firstRung();
        if (turnGrowth(surface, table, begin, a.firstRung(), atBegin) +
                turnGrowth(surface, table, end, a.lastRung(), atEnd) >
            0)
            return;
        QuadLoop loop = joined(a, b, isBackward);
        if (isSimple(loop)) loops.push_back(std::move(loop));
    };
    for (std::size_t l = 0; l < straight.size(); ++l) {
        if (!straight[l].isClosed()) continue;
        std::map<std::size_t, std::vector<std::array<std::size_t, 2>>> crossings; // by the other loop: places on both
        for (std::size_t i = 0; i < straight[l].quads.size(); ++i) {
            for (const Place& place : placesOf[straight[l].quads[i]]) {
                if (place.loop > l) crossings[place.loop].push_back({i, place.at});
            }
        }
        for (const auto& [other, at] : crossings) {
            const QuadLoop *a = &straight[l], *b = &straight[other];
            for (std::size_t i = 0; i < at.size(); ++i) {
                for (std::size_t j = i + 1; j < at.size(); ++j) {
                    for (const auto& [from, to] : {std::pair(at[i], at[j]), std::pair(at[j], at[i])}) {
                        addIfSimple({a, from[0], to[0]}, {b, to[1], from[1]}, false);
                        addIfSimple({a, from[0], to[0]}, {b, from[1], to[1]}, true);
                    }
                }
            }
        }
    }
    return loops;
}

bool leavesQuads(const GuardedMesh& surface, const QuadTable& table, const QuadLoop& loop)
{
    constexpr std::size_t mostValence = 8, mostMerged = 3;
    // The vertices that become one: few, in lists by the first of them.
    std::map<std::uint32_t, std::uint32_t> into;
    std::map<std::uint32_t, std::vector<std::uint32_t>> merged;
    const auto placeOf = [&](std::uint32_t v) {
        const auto found = into.find(v);
        return found == into.end() ? v : found->second;
    };
    for (const std::uint32_t q : loop.quads) {
        for (int i = 0; i < 4; ++i) {
            const std::uint32_t v = table.corners(q)[i];
            if (into.emplace(v, v).second) merged[v] = {v};
        }
    }
    for (const auto& [a, b] : loop.rungs) {
        const std::uint32_t to = into.at(a), from = into.at(b);
        if (to == from) return false; // a ring of rungs would close a hole
        for (const std::uint32_t v : merged.at(from)) {
            into[v] = to;
            merged[to].push_back(v);
        }
        merged.erase(from);
        if (merged[to].size() > mostMerged) return false;
    }
    std::map<Rung, std::vector<std::uint32_t>> quadsAt; // by the ends of a side, the lesser first
    std::vector<std::uint32_t> around;                  // the quads that are left
    std::vector<std::uint32_t> gone = loop.quads;
    std::sort(gone.begin(), gone.end());
    for (const auto& [place, members] : merged) {
        bool onPlane = false;
        std::size_t count = 0;
        std::vector<std::uint32_t> beside, opposite; // ends of the edges; corners opposite to the place
        for (const std::uint32_t v : members) {
            onPlane = onPlane || surface.isOnPlane(v);
            for (const std::uint32_t q : table.quadsOf(v)) {
                if (std::binary_search(gone.begin(), gone.end(), q)) continue;
                const Vec4I& ids = table.corners(q);
                int i = 0;
                while (ids[i] != v) ++i;
                ++count;
                around.push_back(q);
                beside.push_back(placeOf(ids[(i + 1) % 4]));
                beside.push_back(placeOf(ids[(i + 3) % 4]));
                opposite.push_back(placeOf(ids[(i + 2) % 4]));
            }
        }
        const std::size_t valence = onPlane ? 2 * count : count;
        if (valence < 3 || valence > mostValence) return false;
        std::sort(beside.begin(), beside.end());
        std::sort(opposite.begin(), opposite.end());
        std::size_t ends = 0; // edges with one quad
        for (std::size_t i = 0; i < beside.size();) {
            if (beside[i] == place) return false;
            if (std::binary_search(opposite.begin(), opposite.end(), beside[i])) return false;
            std::size_t same = 1;
            while (i + same < beside.size() && beside[i + same] == beside[i]) ++same;
            if (same > 2) return false;
            ends += same == 1 ? 1 : 0;
            i += same;
        }
        if (ends != (onPlane ? 2U : 0U)) return false;
        if (std::adjacent_find(opposite.begin(), opposite.end()) != opposite.end()) return false;
        if (std::binary_search(opposite.begin(), opposite.end(), place)) return false;
    }
    // A limb needs at least three quads around it: two would share two sides.
    std::sort(around.begin(), around.end());
    around.erase(std::unique(around.begin(), around.end()), around.end());
    for (const std::uint32_t q : around) {
        const Vec4I& ids = table.corners(q);
        for (int i = 0; i < 4; ++i) {
            const auto [a, b] = std::minmax({placeOf(ids[i]), placeOf(ids[(i + 1) % 4])});
            quadsAt[{a, b}].push_back(q);
        }
    }
    std::vector<Rung> neighbours;
    for (const auto& side : quadsAt) {
        if (side.second.size() == 2) neighbours.push_back({side.second[0], side.second[1]}); // ascending
    }
    std::sort(neighbours.begin(), neighbours.end());
    return std::adjacent_find(neighbours.begin(), neighbours.end()) == neighbours.end();
}

} // namespace vdbcage::detail
