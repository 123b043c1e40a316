#include <tools/edit/carry.h>

#include <algorithm>
#include <cstddef>
#include <tuple>
#include <utility>

#include <tools/edit/elements.h>
#include <vdbcage/core/error.h>
#include <vdbcage/deform/binding.h>

namespace vdbcage::edit {

namespace {

using openvdb::Vec3d;

/// The points that faces use, to be found by their places.
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

    /// The first one at that place; `none` if there is none.
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

std::vector<Vec3d> carriedPose(const Mesh& rest, const std::vector<Vec3d>& posed, const Mesh& other,
                               Interrupter* interrupter)
{
    constexpr Coordinates family = Coordinates::meanValue;
    // So many rows at a time: of two cages of 10,000 faces all of them would be 200 MB.
    constexpr std::size_t block = 512;
    // Of this family handles are the points, and those that no face uses have the weight 0.
    std::vector<Vec3d> shifts = cageHandles(rest, posed, family);
    const std::vector<Vec3d> handles = cageHandles(rest, rest.points, family);
    for (std::size_t i = 0; i < shifts.size(); ++i) shifts[i] -= handles[i];

    const PlacedPoints places(rest);
    std::vector<Vec3d> result = other.points;
    const bool isAtRest = std::all_of(places.all().begin(), places.all().end(),
                                      [&](Index point) { return posed[point] == rest.points[point]; });
    if (isAtRest) return result;
    std::vector<Index> riding;
    for (Index i = 0; i < result.size(); ++i) {
        const Index same = places.at(result[i]);
        if (same == none) {
            riding.push_back(i);
        } else {
            result[i] = posed[same];
        }
    }
    for (std::size_t first = 0; first < riding.size(); first += block) {
        const std::size_t count = std::min(block, riding.size() - first);
        std::vector<Vec3d> points;
        for (std::size_t i = 0; i < count; ++i) points.push_back(other.points[riding[first + i]]);
        const std::vector<double> weights = computeCoordinates(rest, points, family, interrupter);
        const double* weight = weights.data();
        for (std::size_t i = 0; i < count; ++i) {
            for (const Vec3d& shift : shifts) result[riding[first + i]] += *weight++ * shift;
        }
    }
    return result;
}

} // namespace vdbcage::edit
