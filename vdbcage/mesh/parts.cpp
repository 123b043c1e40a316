#include <vdbcage/mesh/parts.h>

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <unordered_map>
#include <vector>

#include <openvdb/math/BBox.h>
#include <vdbcage/core/detail/longest_side.h>
#include <vdbcage/geometry/union_find.h>

namespace vdbcage {

namespace {

using openvdb::Index32;

/// The parts of a mesh, each by the root of its points.
class Parts {
public:
    explicit Parts(const Mesh& mesh) : sets_(mesh.points.size())
    {
        const auto unite = [&](const auto& faces) {
            for (const auto& face : faces) {
                for (int i = 1; i < face.size; ++i) sets_.unite(face[0], face[i]);
            }
        };
        unite(mesh.triangles);
        unite(mesh.quads);
        unite(mesh.alternatives);
        unitePlaces(mesh);
        const auto expand = [&](const auto& faces) {
            for (const auto& face : faces) {
                openvdb::BBoxd& box = boxes_[sets_.find(face[0])];
                for (int i = 0; i < face.size; ++i) box.expand(mesh.points[face[i]]);
            }
        };
        expand(mesh.triangles);
        expand(mesh.quads);
        expand(mesh.alternatives);
    }

    std::uint32_t of(Index32 point) { return sets_.find(point); }
    /// Returns the longest side of a part that has faces.
    double side(std::uint32_t part) const { return detail::longestSide(boxes_.at(part)); }
    double largest() const
    {
        double side = 0;
        for (const auto& part : boxes_) side = std::max(side, detail::longestSide(part.second));
        return side;
    }

private:
    void unitePlaces(const Mesh& mesh)
    {
        std::vector<Index32> order;
        order.reserve(mesh.points.size());
        const std::vector<Index32> loose = loosePoints(mesh);
        auto next = loose.begin();
        for (Index32 i = 0; i < mesh.points.size(); ++i) {
            if (next != loose.end() && *next == i) {
                ++next;
            } else {
                order.push_back(i);
            }
        }
        const auto& points = mesh.points;
        std::sort(order.begin(), order.end(), [&](Index32 a, Index32 b) { return points[a] < points[b]; });
        for (std::size_t i = 1; i < order.size(); ++i) {
            if (points[order[i]] == points[order[i - 1]]) sets_.unite(order[i - 1], order[i]);
        }
    }

    detail::UnionFind sets_;
    std::unordered_map<std::uint32_t, openvdb::BBoxd> boxes_; // by their roots; only looked up, never iterated
};

LargeParts withoutSmall(const Mesh& mesh, Parts& parts, double side)
{
    LargeParts kept;
    kept.leastSide = side;
    std::vector<std::uint32_t> leftOut; // parts, maybe several times
    std::vector<bool> isKept(mesh.points.size(), true);
    const auto keep = [&](const auto& from, auto& to, bool isCounted) {
        for (const auto& face : from) {
            const std::uint32_t part = parts.of(face[0]);
            if (parts.side(part) >= side) {
                to.push_back(face);
                continue;
            }
            for (int i = 0; i < face.size; ++i) isKept[face[i]] = false;
            if (!isCounted) continue;
            leftOut.push_back(part);
            ++kept.facesLeftOut;
        }
    };
    keep(mesh.triangles, kept.mesh.triangles, true);
    keep(mesh.quads, kept.mesh.quads, true);
    keep(mesh.alternatives, kept.mesh.alternatives, false);
    std::sort(leftOut.begin(), leftOut.end());
    kept.partsLeftOut = static_cast<std::size_t>(std::unique(leftOut.begin(), leftOut.end()) - leftOut.begin());

    std::vector<Index32> numbers(mesh.points.size());
    for (std::size_t i = 0; i < mesh.points.size(); ++i) {
        numbers[i] = static_cast<Index32>(kept.mesh.points.size());
        if (isKept[i]) kept.mesh.points.push_back(mesh.points[i]);
    }
    const auto renumber = [&](auto& faces) {
        for (auto& face : faces) {
            for (int i = 0; i < face.size; ++i) face[i] = numbers[face[i]];
        }
    };
    renumber(kept.mesh.triangles);
    renumber(kept.mesh.quads);
    renumber(kept.mesh.alternatives);
    return kept;
}

} // namespace

double largestPart(const Mesh& mesh)
{
    return Parts(mesh).largest();
}

LargeParts largeParts(const Mesh& mesh, double leastPart)
{
    Parts parts(mesh);
    return withoutSmall(mesh, parts, leastPart * parts.largest());
}

LargeParts partsFrom(const Mesh& mesh, double leastSide)
{
    Parts parts(mesh);
    return withoutSmall(mesh, parts, leastSide);
}

} // namespace vdbcage
