// Based on: Edmonds, "Paths, Trees, and Flowers", 1965 (paths that alternate between pairs and none).
// Differs: a pair must also pass the guard, so paths are short and found by trying. On them a quad is split along
// either diagonal, and a path may end in a collapse.

#include <vdbcage/bounding/detail/quads/pairing/alternating_path.h>

#include <algorithm>
#include <vector>

#include <vdbcage/bounding/detail/guard/face_queries.h>
#include <vdbcage/bounding/detail/quads/pairing/collapse_triangles.h>
#include <vdbcage/bounding/detail/quads/pairing/limited_growth.h>
#include <vdbcage/bounding/detail/quads/pairing/merge_triangles.h>
#include <vdbcage/bounding/detail/quads/pairing/quad_candidates.h>

namespace vdbcage::detail {

namespace {

/// A path of a triangle, two faces for each quad on the way, and a triangle. The first face of a quad is the face or
/// alternate that is paired with the face before it, the second the one left over.
class AlternatingPath {
public:
    AlternatingPath(GuardedMesh& surface, std::uint32_t triangle, const PathOptions& options)
        : surface_(surface), options_(options), path_{triangle}
    {
    }

    /// Looks for faces that continue the path to another triangle, and takes the first allowed path. Returns whether
    /// the search is over.
    bool extend()
    {
        constexpr int mostTries = 40;
        const std::uint32_t end = path_.back();
        const bool isFull = path_.size() + 1 >= 2 * options_.maxPairs; // with a triangle; shorter paths were tried
        for (int i = 0; i < 3; ++i) {
            const std::uint32_t next = faceAcross(surface_, end, i);
            if (next == end || contains(next)) continue;
            if (!surface_.isInQuad(next)) {
                if (!isFull || (options_.end == PathEnd::quad && !mayMerge(end, next))) continue;
                path_.push_back(next);
                if (augment() || ++tries_ >= mostTries) return true;
                path_.pop_back();
                continue;
            }
            if (isFull) continue;
            for (const std::uint32_t half : {next, alternateAcross(end, i, next)}) {
                if (!mayMerge(end, half)) continue;
                path_.push_back(half);
                path_.push_back(surface_.partnerOf(half));
                if (extend()) return true;
                path_.resize(path_.size() - 2);
            }
        }
        return false;
    }

private:
    bool mayMerge(std::uint32_t f, std::uint32_t g) const
    {
        return shapeError(surface_, f, g, options_.mergeAngleDegrees).has_value();
    }

    /// Returns the alternate across side i of f, across which `next` is the face.
    std::uint32_t alternateAcross(std::uint32_t f, int i, std::uint32_t next) const
    {
        const std::uint32_t a = surface_.face(f)[i], b = surface_.face(f)[(i + 1) % 3];
        const auto& alternates = surface_.alternatesIn(next);
        return alternates[sideOf(surface_, alternates[0], b, a) >= 0 ? 0 : 1];
    }

    /// Returns whether a face or its quad is on the path.
    bool contains(std::uint32_t f) const
    {
        const bool isFree = !surface_.isInQuad(f);
        return std::any_of(path_.begin(), path_.end(), [&](std::uint32_t g) {
            if (g == f) return true;
            if (isFree || !surface_.isInQuad(g)) return false;
            const auto& alternates = surface_.alternatesIn(f);
            return g == surface_.partnerOf(f) || g == alternates[0] || g == alternates[1];
        });
    }

    /// Pairs the faces of a path between two triangles. Returns whether that is allowed; if not, nothing changes.
    bool augment()
    {
        return changeWithin(surface_, options_.maxGrowth, [&] {
            for (std::size_t i = 1; i + 1 < path_.size(); i += 2) {
                if (!surface_.isFace(path_[i])) surface_.flipQuad(path_[i]);
                surface_.splitQuad(path_[i]);
            }
            for (std::size_t i = 0; i < path_.size(); i += 2) {
                const bool isCollapse = i + 2 == path_.size() && options_.end == PathEnd::collapse;
                const auto pair = isCollapse ? collapseTriangles : mergeTriangles;
                if (!pair(surface_, path_[i], path_[i + 1])) return false;
            }
            return true;
        });
    }

    GuardedMesh& surface_;
    const PathOptions& options_;
    std::vector<std::uint32_t> path_;
    int tries_ = 0;
};

} // namespace

void pairAlongPath(GuardedMesh& surface, std::uint32_t triangle, const PathOptions& options)
{
    AlternatingPath(surface, triangle, options).extend();
}

} // namespace vdbcage::detail
