#include <tools/edit/carry.h>

#include <algorithm>
#include <cstddef>
#include <tuple>
#include <utility>

#include <tools/edit/elements.h>
#include <vdbcage/deform/binding.h>

namespace vdbcage::edit {

namespace {

using openvdb::Vec3d;

/// The points that faces use, sorted by their places.
class PlacedPoints {
public:
    explicit PlacedPoints(const Mesh& mesh) : points_(mesh.points)
    {
        const auto use = [&](const auto& face, int size) {
            for (int i = 0; i < size; ++i) sorted_.push_back(face[i]);
        };
        for (const openvdb::Vec3I& triangle : mesh.triangles) use(triangle, 3);
        for (const openvdb::Vec4I& quad : mesh.quads) use(quad, 4);
        std::sort(sorted_.begin(), sorted_.end(), [&](Index a, Index b) {
            return std::make_pair(key(points_[a]), a) < std::make_pair(key(points_[b]), b);
        });
        sorted_.erase(std::unique(sorted_.begin(), sorted_.end()), sorted_.end());
    }

    const std::vector<Index>& all() const { return sorted_; }

    /// Returns the first one at that place; `none` if there is none.
    Index at(const Vec3d& place) const
    {
        const auto found = std::lower_bound(sorted_.begin(), sorted_.end(), place,
                                            [&](Index a, const Vec3d& b) { return key(points_[a]) < key(b); });
        return found != sorted_.end() && key(points_[*found]) == key(place) ? *found : none;
    }

private:
    static std::tuple<double, double, double> key(const Vec3d& p) { return {p.x(), p.y(), p.z()}; }

    const std::vector<Vec3d>& points_;
    std::vector<Index> sorted_;
};

} // namespace

std::vector<std::vector<Vec3d>> carriedPoses(const Mesh& rest, const std::vector<std::vector<Vec3d>>& poses,
                                             const Mesh& other, Interrupter* interrupter)
{
    constexpr Coordinates family = Coordinates::meanValue;
    // Rows at a time: for two cages of 10,000 faces all rows would be 200 MB.
    constexpr std::size_t block = 512;
    const PlacedPoints places(rest);
    std::vector<std::vector<Vec3d>> results(poses.size(), other.points);
    // The handles of this family are the points; those that no face uses have the weight 0.
    const std::vector<Vec3d> handles = cageHandles(rest, rest.points, family);
    std::vector<std::pair<std::size_t, std::vector<Vec3d>>> moved; // poses and their displacements
    for (std::size_t k = 0; k < poses.size(); ++k) {
        std::vector<Vec3d> shifts = cageHandles(rest, poses[k], family);
        const bool isAtRest = std::all_of(places.all().begin(), places.all().end(),
                                          [&](Index point) { return shifts[point] == rest.points[point]; });
        for (std::size_t i = 0; i < shifts.size(); ++i) shifts[i] -= handles[i];
        if (!isAtRest) moved.emplace_back(k, std::move(shifts));
    }
    if (moved.empty()) return results;

    std::vector<Index> riding;
    for (Index i = 0; i < other.points.size(); ++i) {
        const Index same = places.at(other.points[i]);
        if (same == none) riding.push_back(i);
        for (const auto& entry : moved) {
            if (same != none) results[entry.first][i] = poses[entry.first][same];
        }
    }
    for (std::size_t first = 0; first < riding.size(); first += block) {
        const std::size_t count = std::min(block, riding.size() - first);
        std::vector<Vec3d> points;
        for (std::size_t i = 0; i < count; ++i) points.push_back(other.points[riding[first + i]]);
        const std::vector<double> weights = computeCoordinates(rest, points, family, interrupter);
        for (const auto& [pose, shifts] : moved) {
            const double* weight = weights.data();
            for (std::size_t i = 0; i < count; ++i) {
                for (const Vec3d& shift : shifts) results[pose][riding[first + i]] += *weight++ * shift;
            }
        }
    }
    return results;
}

} // namespace vdbcage::edit
