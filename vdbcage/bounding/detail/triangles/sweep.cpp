#include <vdbcage/bounding/detail/triangles/sweep.h>

namespace vdbcage::detail {

std::vector<std::vector<std::uint32_t>> independentGroups(const GuardedMesh& surface,
                                                          const std::vector<std::uint32_t>& vertices)
{
    constexpr std::uint32_t uncoloured = ~std::uint32_t(0);
    std::vector<std::uint32_t> colour(surface.vertices(), uncoloured);
    std::vector<std::vector<std::uint32_t>> groups;
    std::vector<std::uint32_t> takenBy; // for each colour the last vertex with a neighbour of it
    for (const std::uint32_t v : vertices) {
        for (const std::uint32_t w : surface.neighbours(v)) {
            if (colour[w] != uncoloured) takenBy[colour[w]] = v;
        }
        std::uint32_t free = 0;
        while (free < groups.size() && takenBy[free] == v) ++free;
        if (free == groups.size()) {
            groups.emplace_back();
            takenBy.push_back(uncoloured);
        }
        colour[v] = free;
        groups[free].push_back(v);
    }
    return groups;
}

std::vector<std::uint32_t> allVertices(const GuardedMesh& surface)
{
    std::vector<std::uint32_t> list;
    for (std::uint32_t v = 0; v < surface.vertices(); ++v) {
        if (surface.isVertex(v)) list.push_back(v);
    }
    return list;
}

std::optional<Vec3d> towards(const GuardedMesh& surface, const StarChange& star, const Vec3d& goal,
                             std::initializer_list<double> steps, const ShapeTerm* shape)
{
    const Vec3d& p = surface.point(star.centre);
    Obstacle obstacle;
    for (const double step : steps) {
        const Vec3d target = rounded(surface, star, p + step * (goal - p));
        if (shape && !shape->keepsFit(surface, star, target)) continue;
        if (allows(surface, star, target, &obstacle)) return target;
    }
    return std::nullopt;
}

} // namespace vdbcage::detail
