#include <vdbcage/surface/detail/pull_apart.h>

#include <algorithm>
#include <limits>
#include <map>
#include <set>
#include <utility>
#include <vector>

#include <vdbcage/geometry/union_find.h>
#include <vdbcage/mesh/topology.h>
#include <vdbcage/surface/detail/meetings.h>

namespace vdbcage::detail {

namespace {

using Index = std::uint32_t;

/// The steps of a point towards the mean of its neighbours: first a tiny one, for points that only touch; then all the
/// way, for points that were pulled through. Steps between would leave dents.
constexpr double steps[] = {0x1p-10, 1.0};
constexpr int sweeps = 8;
/// The number of times that points that went all the way are set to the mean again, since their neighbours moved too.
constexpr int rounds = 10;

class PullingApart {
public:
    PullingApart(Mesh& mesh, bool withinParts, Interrupter* interrupter)
        : mesh_(mesh), interrupter_(interrupter), meetings_(mesh), neighbours_(mesh.points.size()),
          part_(withinParts ? analyzeTopology(mesh, interrupter).faceComponent : std::vector<Index>(faceCount(mesh)))
    {
        const auto add = [&](const auto& corners, int size) {
            for (int i = 0; i < size; ++i) {
                neighbours_[corners[i]].insert(corners[(i + 1) % size]);
                neighbours_[corners[(i + 1) % size]].insert(corners[i]);
            }
        };
        for (const Vec3I& t : mesh.triangles) add(t, 3);
        for (const openvdb::Vec4I& q : mesh.quads) add(q, 4);
    }

    std::size_t run()
    {
        const std::vector<Meetings::Pair> before = pairs();
        if (before.empty() || before.size() >= Meetings::most) return 0;
        const std::vector<Vec3d> given = mesh_.points;
        UnionFind clusters(given.size()); // of points whose faces meet
        forEachCorner(before, [&](Index point, const Meetings::Pair& pair) {
            clusters.unite(meetings_.triangles()[pair[0]].corners[0], point);
        });

        std::vector<Index> moved = sweep();
        // Moves points back, the last one first, where that does no harm.
        std::set<Index> away;
        for (auto point = moved.rbegin(); point != moved.rend(); ++point) {
            if (mesh_.points[*point] != given[*point] && !goes(*point, given[*point])) away.insert(*point);
        }
        for (int round = 0; round < rounds; ++round) {
            for (const Index point : away) {
                const double far = (mean(point) - given[point]).length();
                if ((mesh_.points[point] - given[point]).length() > 2 * steps[0] * far) goes(point, mean(point));
            }
        }

        std::set<Index> failed;
        forEachCorner(pairs(), [&](Index point, const Meetings::Pair&) { failed.insert(clusters.find(point)); });
        std::size_t result = 0;
        for (const Index point : away) {
            if (failed.count(clusters.find(point)) == 0) {
                ++result;
            } else {
                meetings_.move(point, given[point]);
            }
        }
        return result;
    }

private:
    bool counts(Index a, Index b) const
    {
        return part_[meetings_.triangles()[a].face] == part_[meetings_.triangles()[b].face];
    }

    std::vector<Meetings::Pair> pairs() const
    {
        std::vector<Meetings::Pair> all = meetings_.pairs(interrupter_);
        all.erase(std::remove_if(all.begin(), all.end(),
                                 [&](const Meetings::Pair& pair) { return !counts(pair[0], pair[1]); }),
                  all.end());
        return all;
    }

    template <typename Visit>
    void forEachCorner(const std::vector<Meetings::Pair>& pairs, const Visit& visit) const
    {
        for (const Meetings::Pair& pair : pairs) {
            for (const Index triangle : pair) {
                for (int i = 0; i < 3; ++i) visit(meetings_.triangles()[triangle].corners[i], pair);
            }
        }
    }

    /// Moves points until no sweep helps any more. Returns those that moved, in that order.
    std::vector<Index> sweep()
    {
        std::vector<Index> moved;
        for (int sweep = 0; sweep < sweeps; ++sweep) {
            std::map<Index, std::size_t> scores;
            forEachCorner(pairs(), [&](Index point, const Meetings::Pair&) { scores[point] = 0; });
            std::vector<std::pair<std::size_t, Index>> order;
            for (const auto& score : scores) order.emplace_back(meetingsAround(score.first), score.first);
            std::sort(order.begin(), order.end(), [](const auto& a, const auto& b) {
                return a.first != b.first ? a.first > b.first : a.second < b.second;
            });
            bool helped = false;
            for (const auto& entry : order) {
                if (!improve(entry.second)) continue;
                moved.push_back(entry.second);
                helped = true;
            }
            if (!helped) break;
        }
        return moved;
    }

    /// Takes the step that leaves the fewest meetings, if these are fewer than now. Returns whether.
    bool improve(Index point)
    {
        throwIfInterrupted(interrupter_);
        std::size_t least = meetingsAround(point);
        const Vec3d from = mesh_.points[point], to = mean(point);
        Vec3d best = from;
        for (const double step : steps) {
            if (least == 0) break;
            meetings_.move(point, from + step * (to - from));
            const std::size_t left = meetingsAround(point);
            if (left < least) {
                least = left;
                best = mesh_.points[point];
            }
        }
        meetings_.move(point, best);
        return best != from;
    }

    /// Moves a point unless there are more meetings then. Returns whether.
    bool goes(Index point, const Vec3d& to)
    {
        throwIfInterrupted(interrupter_);
        const Vec3d from = mesh_.points[point];
        const std::size_t before = meetingsAround(point);
        meetings_.move(point, to);
        if (meetingsAround(point) <= before) return true;
        meetings_.move(point, from);
        return false;
    }

    /// Returns the number of pairs of triangles that meet and of which one has a corner there; the largest number if
    /// one has no area.
    std::size_t meetingsAround(Index point) const
    {
        std::size_t result = 0;
        for (const Index triangle : meetings_.around(point)) {
            if (meetings_.isDegenerate(triangle)) return std::numeric_limits<std::size_t>::max();
            meetings_.forEachMeeting(triangle, [&](Index other) {
                const bool isSeenTwice = other < triangle && meetings_.triangles()[other].has(point);
                if (!isSeenTwice && counts(triangle, other)) ++result;
            });
        }
        return result;
    }

    Vec3d mean(Index point) const
    {
        Vec3d sum(0.0);
        for (const Index neighbour : neighbours_[point]) sum += mesh_.points[neighbour];
        return sum / static_cast<double>(neighbours_[point].size());
    }

    Mesh& mesh_;
    Interrupter* interrupter_;
    Meetings meetings_;
    std::vector<std::set<Index>> neighbours_;
    std::vector<Index> part_; ///< by face; all 0 if every meeting counts
};

} // namespace

std::size_t pullApart(Mesh& mesh, bool withinParts, Interrupter* interrupter)
{
    return PullingApart(mesh, withinParts, interrupter).run();
}

} // namespace vdbcage::detail
