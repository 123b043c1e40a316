// The table of quads, against a list of their corners that is searched each time.
#include <boost/test/unit_test.hpp>

#include <algorithm>
#include <map>
#include <random>
#include <set>
#include <vector>

#include <vdbcage/bounding/detail/quads/quad_table.h>
#include <vdbcage/core/error.h>

#include "bounding/support/guarded_surface.h"
#include "bounding/support/lump.h"
#include "support/shapes.h"
#include "support/surface_models.h"

using namespace vdbcage;
using namespace vdbcage::detail;
using openvdb::Vec4I;

namespace {

using Numbers = std::vector<std::uint32_t>;
using Quads = std::map<std::uint32_t, Vec4I>; // by number

bool has(const Vec4I& ids, std::uint32_t v)
{
    return ids[0] == v || ids[1] == v || ids[2] == v || ids[3] == v;
}

Numbers sorted(const QuadTable::Quads& list)
{
    Numbers numbers(list.begin(), list.end());
    std::sort(numbers.begin(), numbers.end());
    return numbers;
}

/// Whether a table holds these quads and no others, however it is asked.
void requireSame(const QuadTable& table, const Quads& quads, std::uint32_t vertices)
{
    BOOST_TEST(table.count() == quads.size());
    for (std::uint32_t q = 0; q < table.quads(); ++q) {
        const auto found = quads.find(q);
        BOOST_REQUIRE(table.isQuad(q) == (found != quads.end()));
        if (found != quads.end()) BOOST_TEST((table.corners(q) == found->second));
    }
    std::map<std::uint32_t, Numbers> around;
    std::map<Rung, std::uint32_t> at;
    for (const auto& [q, ids] : quads) {
        for (int i = 0; i < 4; ++i) {
            around[ids[i]].push_back(q);
            at[{ids[i], ids[(i + 1) % 4]}] = q;
            BOOST_TEST(table.sideOf(q, ids[i], ids[(i + 1) % 4]) == i);
            BOOST_TEST(table.sideOf(q, ids[i], ids[(i + 2) % 4]) == 4);
        }
    }
    for (std::uint32_t v = 0; v < vertices; ++v) BOOST_TEST(sorted(table.quadsOf(v)) == around[v]);
    for (const auto& [side, q] : at) {
        BOOST_TEST(table.quadAt(side[0], side[1]) == q);
        const auto back = at.find({side[1], side[0]});
        BOOST_TEST(table.quadAt(side[1], side[0]) == (back == at.end() ? QuadTable::none : back->second));
    }
}

Quads quadsOf(const QuadTable& table)
{
    Quads quads;
    for (std::uint32_t q = 0; q < table.quads(); ++q) {
        if (table.isQuad(q)) quads[q] = table.corners(q);
    }
    return quads;
}

} // namespace

BOOST_AUTO_TEST_SUITE(quad_table)

BOOST_AUTO_TEST_CASE(a_table_is_that_of_the_mesh_of_quads)
{
    for (unsigned seed = 1; seed <= 5; ++seed) {
        const test::Lump lump(seed);
        const GuardedMesh surface(lump.surface, modelOf(lump.guard));
        Quads quads;
        for (std::uint32_t q = 0; q < lump.surface.quads.size(); ++q) quads[q] = lump.surface.quads[q];
        requireSame(QuadTable(surface), quads, surface.vertices());
        std::map<std::uint32_t, std::set<std::uint32_t>> joined; // edges of quads
        for (const Vec4I& q : lump.surface.quads) {
            for (int i = 0; i < 4; ++i) {
                joined[q[i]].insert(q[(i + 1) % 4]);
                joined[q[(i + 1) % 4]].insert(q[i]);
            }
        }
        for (std::uint32_t v = 0; v < surface.vertices(); ++v)
            BOOST_TEST(valence(surface, QuadTable(surface), v) == joined[v].size());
    }
}

BOOST_AUTO_TEST_CASE(on_the_plane_the_edges_of_both_halves_count)
{
    const BoundingGuard guard = test::guardOf(test::soup(1, 10, 0.1), true);
    const Mesh whole = guard.symmetrized(test::ball(6), 0.04);
    const GuardedMesh half(whole, modelOf(guard));
    const QuadTable table(half);
    const Mesh both = half.mesh(); // its first points are the half's, in order
    std::map<std::uint32_t, std::set<std::uint32_t>> joined;
    for (const Vec3I& t : both.triangles) { // each edge that is not a diagonal, below
        for (int i = 0; i < 3; ++i) joined[t[i]].insert(t[(i + 1) % 3]);
        for (int i = 0; i < 3; ++i) joined[t[(i + 1) % 3]].insert(t[i]);
    }
    std::uint32_t number = 0;
    int onPlane = 0;
    for (std::uint32_t v = 0; v < half.vertices(); ++v) {
        if (!half.isVertex(v)) continue;
        std::size_t diagonals = 0;
        for (const std::uint32_t q : table.quadsOf(v)) {
            const Vec4I& ids = table.corners(q);
            diagonals += ids[0] == v || ids[2] == v; // as a new surface splits them
        }
        onPlane += half.isOnPlane(v);
        if (half.isOnPlane(v)) diagonals *= 2;
        BOOST_TEST(valence(half, table, v) == joined[number++].size() - diagonals);
    }
    BOOST_TEST(onPlane > 4);
}

BOOST_AUTO_TEST_CASE(pairs_that_the_guard_holds_are_the_quads_of_a_table)
{
    const test::Lump lump(3);
    GuardedMesh surface(lump.surface, modelOf(lump.guard));
    std::mt19937 random(3);
    for (int round = 0; round < 3; ++round) {
        test::makeSomeQuads(surface, random, 3);
        for (std::uint32_t f = 0; f < surface.faces(); ++f) {
            if (surface.isFace(f) && surface.isInQuad(f) && random() % 3 == 0) surface.flipQuad(f);
        }
        const QuadTable table = QuadTable::ofPairs(surface);
        BOOST_TEST(table.count() == surface.quads());
        requireSame(table, quadsOf(table), surface.vertices());
        for (std::uint32_t f = 0; f < surface.faces(); ++f) {
            if (!surface.isFace(f)) continue;
            const Vec3I& t = surface.face(f);
            std::size_t with = 0; // quads with all three corners
            for (const auto& entry : quadsOf(table))
                with += has(entry.second, t[0]) && has(entry.second, t[1]) && has(entry.second, t[2]);
            BOOST_TEST(with == (surface.isInQuad(f) ? 1U : 0U));
        }
    }
    BOOST_TEST(surface.quads() > 10U);
}

BOOST_AUTO_TEST_CASE(any_row_of_changes_is_that_of_a_list)
{
    for (unsigned seed = 1; seed <= 5; ++seed) {
        const test::Lump lump(seed);
        const GuardedMesh surface(lump.surface, modelOf(lump.guard));
        QuadTable table(surface);
        Quads quads = quadsOf(table);
        std::mt19937 random(seed);
        std::uint32_t vertices = surface.vertices();
        const auto anyQuad = [&] {
            auto found = quads.lower_bound(static_cast<std::uint32_t>(random() % table.quads()));
            return found == quads.end() ? quads.begin() : found;
        };
        const auto newCorners = [&] {
            Vec4I ids;
            for (int i = 0; i < 4; ++i) {
                do {
                    ids[i] = static_cast<std::uint32_t>(random() % (vertices + 1)); // perhaps a new one
                } while (std::find(&ids[0], &ids[0] + i, ids[i]) != &ids[0] + i);
                vertices = std::max(vertices, ids[i] + 1);
            }
            return ids;
        };
        const auto isFree = [&](const Vec4I& ids) { // no side is another quad's already
            return std::none_of(quads.begin(), quads.end(), [&](const auto& entry) {
                int shared = 0;
                for (int i = 0; i < 4; ++i) shared += has(entry.second, ids[i]);
                return shared > 1;
            });
        };
        int merged = 0;
        for (int step = 0; step < 120; ++step) {
            const auto kind = random() % 4;
            if (kind == 0 && quads.size() > 5) {
                const auto gone = anyQuad();
                table.remove(gone->first);
                quads.erase(gone);
            } else if (kind == 1) {
                const auto kept = static_cast<std::uint32_t>(random() % vertices),
                           removed = static_cast<std::uint32_t>(random() % vertices);
                // None may have both, nor may two come to have one side.
                Quads after = quads;
                bool may = kept != removed;
                std::set<Rung> sides;
                for (auto& [q, ids] : after) {
                    may = may && !(has(ids, kept) && has(ids, removed));
                    for (int i = 0; i < 4; ++i) ids[i] = ids[i] == removed ? kept : ids[i];
                    for (int i = 0; i < 4; ++i) may = may && sides.insert({ids[i], ids[(i + 1) % 4]}).second;
                }
                if (!may) continue;
                table.merge(kept, removed);
                quads = std::move(after);
                ++merged;
            } else if (kind == 2) {
                const std::uint32_t before = vertices;
                const Vec4I ids = newCorners();
                if (!isFree(ids)) {
                    vertices = before;
                    continue;
                }
                quads[table.quads()] = ids;
                table.add(ids);
            } else {
                const auto changed = anyQuad();
                const Vec4I ids = changed->second;
                const Vec4I turned(ids[1], ids[2], ids[3], ids[0]);
                table.replace(changed->first, turned);
                changed->second = turned;
            }
            std::uint32_t known = surface.vertices();
            for (const auto& entry : quads) {
                for (int i = 0; i < 4; ++i) known = std::max(known, entry.second[i] + 1);
            }
            if (step % 5 == 0) requireSame(table, quads, known);
        }
        BOOST_TEST(merged > 5);
    }
}

BOOST_AUTO_TEST_CASE(what_was_saved_comes_back_to_the_bit)
{
    for (unsigned seed = 1; seed <= 6; ++seed) {
        const test::Lump lump(seed);
        const GuardedMesh surface(lump.surface, modelOf(lump.guard));
        QuadTable table(surface);
        std::mt19937 random(seed);
        for (int round = 0; round < 20; ++round) {
            const QuadTable before = table;
            const auto q = static_cast<std::uint32_t>(random() % table.quads());
            const Vec4I ids = table.corners(q);
            const Numbers corners = cornersOf(table, {q});
            Numbers around; // of all quads that a merge of its corners changes
            for (const std::uint32_t v : corners) {
                for (const std::uint32_t other : table.quadsOf(v)) {
                    for (int i = 0; i < 4; ++i) around.push_back(table.corners(other)[i]);
                }
            }
            std::sort(around.begin(), around.end());
            around.erase(std::unique(around.begin(), around.end()), around.end());
            const QuadTable::Saved saved = table.saved(around);
            const std::uint32_t made = surface.vertices();
            table.remove(q);
            table.merge(ids[0], ids[2]);
            table.add({ids[0], ids[1], made, ids[3]});
            const std::uint32_t other = table.quadsOf(ids[1])[0];
            const Vec4I turned = table.corners(other);
            table.replace(other, {turned[1], turned[2], turned[3], turned[0]});
            BOOST_TEST(table.count() == before.count());
            table.restore(saved);
            BOOST_TEST(table.count() == before.count());
            BOOST_TEST(table.quads() == before.quads());
            BOOST_TEST((quadsOf(table) == quadsOf(before)));
            for (std::uint32_t v = 0; v < surface.vertices(); ++v)
                BOOST_CHECK(table.quadsOf(v) == before.quadsOf(v)); // in the same order
        }
    }
}

BOOST_AUTO_TEST_CASE(corners_are_listed_once_ascending)
{
    const test::Lump lump(2);
    const GuardedMesh surface(lump.surface, modelOf(lump.guard));
    const QuadTable table(surface);
    std::mt19937 random(2);
    for (int round = 0; round < 20; ++round) {
        Numbers quads;
        std::set<std::uint32_t> expected;
        for (int i = 0; i < round; ++i) {
            quads.push_back(static_cast<std::uint32_t>(random() % table.quads()));
            for (int k = 0; k < 4; ++k) expected.insert(lump.surface.quads[quads.back()][k]);
        }
        BOOST_TEST(cornersOf(table, quads) == Numbers(expected.begin(), expected.end()));
    }
}

BOOST_AUTO_TEST_CASE(triangles_are_refused)
{
    const test::Lump lump(1);
    Mesh mixed = lump.surface;
    const Vec4I q = mixed.quads.back();
    mixed.quads.pop_back();
    mixed.triangles = {{q[0], q[1], q[2]}, {q[0], q[2], q[3]}};
    const GuardedMesh fits(mixed, modelOf(lump.guard)); // its triangles might be a quad's halves
    BOOST_CHECK_NO_THROW(QuadTable{fits});
    std::swap(mixed.triangles[0], mixed.triangles[1]);
    BOOST_CHECK_THROW(QuadTable{GuardedMesh(mixed, modelOf(lump.guard))}, InputError);
    const Mesh sphere = test::sphere({0.5, 0.5, 0.5}, 0.4, 5);
    BOOST_CHECK_THROW(QuadTable{GuardedMesh(sphere, modelOf(lump.guard))}, InputError);
}

BOOST_AUTO_TEST_SUITE_END()
