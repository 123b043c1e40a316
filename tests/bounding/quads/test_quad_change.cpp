// The local changes that are looked for, against how many there are of each kind by the numbers of corners and edges.
#include <boost/test/unit_test.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <random>
#include <set>
#include <vector>

#include <vdbcage/bounding/detail/quads/quad_change.h>

#include "bounding/support/lump.h"
#include "bounding/support/quad_surface.h"
#include "support/surface_models.h"

using namespace vdbcage;
using namespace vdbcage::detail;
using openvdb::Vec4I;

namespace {

using Ring = std::vector<std::uint32_t>;
using Kind = QuadChange::Kind;

/// The surface of a lump, some of its quads two triangles.
struct Patchwork {
    explicit Patchwork(unsigned seed) : lump(seed), surface(lump.surface, modelOf(lump.guard)), table(surface)
    {
        std::mt19937 random(seed);
        for (std::uint32_t q = 0; q < table.quads(); ++q) {
            if (random() % 5 != 0) {
                polygons.push_back({corner(q, 0), corner(q, 1), corner(q, 2), corner(q, 3)});
                continue;
            }
            for (const std::uint32_t f : {2 * q, 2 * q + 1}) {
                const Vec3I& t = surface.face(f);
                polygons.push_back({t[0], t[1], t[2]});
            }
            table.remove(q);
        }
    }
    std::uint32_t corner(std::uint32_t q, int i) const { return table.corners(q)[i]; }

    test::Lump lump;
    GuardedMesh surface;
    QuadTable table;
    std::vector<Ring> polygons;
};

std::map<std::uint32_t, std::size_t> valencesOf(const std::vector<Ring>& polygons)
{
    std::map<std::uint32_t, std::size_t> valences;
    for (const Ring& polygon : polygons) {
        for (const std::uint32_t v : polygon) ++valences[v];
    }
    return valences;
}

} // namespace

BOOST_AUTO_TEST_SUITE(quad_change)

BOOST_AUTO_TEST_CASE(there_are_as_many_changes_as_polygons_and_edges_have)
{
    const double all = -std::numeric_limits<double>::infinity();
    for (unsigned seed = 1; seed <= 5; ++seed) {
        const Patchwork now(seed);
        std::map<std::pair<std::uint32_t, std::uint32_t>, Ring> at;
        for (const Ring& polygon : now.polygons) {
            for (std::size_t i = 0; i < polygon.size(); ++i) {
                Ring from = polygon;
                std::rotate(from.begin(), from.begin() + static_cast<std::ptrdiff_t>(i), from.end());
                at[{from[0], from[1]}] = from;
            }
        }
        std::size_t rotations = 0, merges = 0, splits = 0;
        for (const auto& [edge, polygon] : at) {
            if (edge.first > edge.second) continue;
            const Ring& other = at.at({edge.second, edge.first});
            std::set<std::uint32_t> corners(polygon.begin(), polygon.end());
            corners.insert(other.begin(), other.end());
            const std::size_t n = polygon.size() + other.size() - 2;
            if (corners.size() != n) continue; // they meet elsewhere
            merges += n == 4;
            rotations += n == 5 ? 4 : n == 6 ? 2 : 0; // diagonals of a pentagon, halves of a hexagon, but the old one
        }
        for (const auto& entry : valencesOf(now.polygons)) {
            const std::size_t n = entry.second;
            if (n >= 5) splits += n * (n - 3); // between two neighbours that have two polygons between them and more
        }
        std::map<Kind, std::size_t> found;
        std::set<std::pair<Kind, std::array<std::uint32_t, 4>>> seen;
        double last = std::numeric_limits<double>::infinity();
        for (const QuadChange& change : quadChanges(now.surface, now.table, all)) {
            ++found[change.kind];
            BOOST_TEST(seen.emplace(change.kind, change.vertices).second);
            BOOST_TEST(change.gain <= last);
            last = change.gain;
        }
        BOOST_TEST(found[Kind::split] == splits);
        std::size_t bad[3] = {}; // of rotations, merges, collapses
        const auto valences = valencesOf(now.polygons);
        for (const auto& [edge, polygon] : at) {
            if (edge.first > edge.second) continue;
            const Ring& other = at.at({edge.second, edge.first});
            Ring ring(polygon.begin() + 1, polygon.end());
            ring.push_back(edge.first);
            ring.insert(ring.end(), other.begin() + 2, other.end());
            if (std::set<std::uint32_t>(ring.begin(), ring.end()).size() != ring.size()) continue;
            const bool isBadA = valences.at(edge.first) == 3, isBadB = valences.at(edge.second) == 3;
            const std::size_t n = ring.size();
            if (n == 4) bad[1] += isBadA || isBadB;
            for (std::size_t i = 0; n > 4 && i < n; ++i) {
                for (std::size_t j = i + 2; j < n && j + 1 < n + i; ++j) {
                    if (n == 6 && j != i + 3) continue;
                    const std::set<std::uint32_t> ends{ring[i], ring[j]};
                    if (ends == std::set<std::uint32_t>{edge.first, edge.second}) continue;
                    bad[0] += (isBadA && ends.count(edge.first) == 0) || (isBadB && ends.count(edge.second) == 0);
                }
            }
        }
        for (const Ring& polygon : now.polygons) {
            if (polygon.size() != 4) continue;
            for (const std::size_t i : {0U, 1U}) {
                const bool isBad = valences.at(polygon[i]) + valences.at(polygon[i + 2]) < 5 ||
                                   valences.at(polygon[i + 1]) == 3 || valences.at(polygon[(i + 3) % 4]) == 3;
                bad[2] += isBad;
            }
        }
        // Those after which a vertex would have less than three edges gain nothing that is above any number.
        BOOST_TEST(found[Kind::rotation] + bad[0] == rotations);
        BOOST_TEST(found[Kind::merge] + bad[1] == merges);
        BOOST_TEST(found[Kind::collapse] + bad[2] == 2 * now.table.count());
        BOOST_TEST(bad[0] > 0U);
        BOOST_TEST(quadChanges(now.surface, now.table, 1e9).empty());
        const auto good = quadChanges(now.surface, now.table, 0.5);
        BOOST_TEST(!good.empty());
        for (const QuadChange& change : good) BOOST_TEST(change.gain > 0.5);
    }
}

BOOST_AUTO_TEST_CASE(valences_are_numbers_of_polygons)
{
    for (unsigned seed = 1; seed <= 5; ++seed) {
        const Patchwork now(seed);
        for (const auto& [v, count] : valencesOf(now.polygons))
            BOOST_TEST(polygonValence(now.surface, now.table, v) == count);
    }
    const BoundingGuard guard = test::guardOf(test::soup(1, 10, 0.1), true);
    const GuardedMesh half(guard.symmetrized(test::ball(7), 0.03), modelOf(guard));
    const QuadTable table(half);
    for (std::uint32_t v = 0; v < half.vertices(); ++v) {
        if (half.isVertex(v)) BOOST_TEST(polygonValence(half, table, v) == valence(half, table, v));
    }
}

BOOST_AUTO_TEST_CASE(irregularity_grows_away_from_four)
{
    BOOST_TEST(irregularity(4) == 0);
    BOOST_TEST(irregularity(3) == irregularity(5));
    for (std::size_t edges = 4; edges < 20; ++edges) BOOST_TEST(irregularity(edges) < irregularity(edges + 1));
    for (std::size_t edges = 0; edges < 3; ++edges) BOOST_TEST(std::isinf(irregularity(edges)));
    BOOST_TEST(irregularity(6) > 2 * irregularity(5)); // two of five are better
}

BOOST_AUTO_TEST_SUITE_END()
