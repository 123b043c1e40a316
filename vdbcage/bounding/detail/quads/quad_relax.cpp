#include <vdbcage/bounding/detail/quads/quad_relax.h>

#include <vdbcage/bounding/detail/guard/face_queries.h>
#include <vdbcage/bounding/detail/quads/joint_rings.h>
#include <vdbcage/bounding/detail/triangles/relax.h>
#include <vdbcage/bounding/detail/triangles/sweep.h>

namespace vdbcage::detail {

ShapeWeights scaled(const ShapeWeights& weights, double distance)
{
    return {weights.corners * distance, weights.free,           weights.bad * distance, weights.flat * distance,
            weights.unfit * distance,   weights.hold * distance};
}

double areaPerSample(const GuardedMesh& surface)
{
    constexpr int samplesPerTriangle = 2;
    return areaPerSample(surface, surface.liveFaces(), samplesPerTriangle);
}

double distancePerPolygon(const GuardedMesh& surface, const QuadTable& table, double areaPerSample,
                          Interrupter* interrupter)
{
    return integratedDistance(surface, areaPerSample, interrupter) /
           static_cast<double>(surface.liveFaces() - table.count());
}

QuadShapeTerm shapeTerm(const GuardedMesh& surface, const QuadTable& table, const ShapeWeights& weights,
                        double areaPerSample, Interrupter* interrupter)
{
    return {table, scaled(weights, distancePerPolygon(surface, table, areaPerSample, interrupter)),
            weights.hold > 0 ? JointRings(surface, table).holds() : std::vector<PlaneHold>()};
}

namespace {

void relaxSome(GuardedMesh& surface, const QuadTable& table, const std::vector<std::uint32_t>& vertices,
               const ShapeWeights& weights, int sweeps, Interrupter* interrupter)
{
    const double sample = areaPerSample(surface);
    const QuadShapeTerm term = shapeTerm(surface, table, weights, sample, interrupter);
    tighten(surface, vertices, sweeps, sample, interrupter, &term);
}

} // namespace

void relaxQuads(GuardedMesh& surface, const QuadTable& table, const ShapeWeights& weights, int sweeps,
                Interrupter* interrupter)
{
    relaxSome(surface, table, allVertices(surface), weights, sweeps, interrupter);
}

void relaxQuads(GuardedMesh& surface, const QuadTable& table, int sweeps, Interrupter* interrupter)
{
    relaxQuads(surface, table, usualShape, sweeps, interrupter);
}

void relaxQuads(GuardedMesh& surface, const QuadTable& table, const std::vector<std::uint32_t>& vertices, int sweeps,
                Interrupter* interrupter)
{
    relaxSome(surface, table, vertices, usualShape, sweeps, interrupter);
}

void straighten(GuardedMesh& surface, const QuadTable& table, const std::vector<std::uint32_t>& vertices,
                Interrupter* interrupter)
{
    sweep(surface, vertices, interrupter, [&](std::uint32_t v, const StarChange& star) -> std::optional<Vec3d> {
        const auto& quads = table.quadsOf(v);
        if (quads.empty()) return std::nullopt;
        Vec3d by(0.0);
        for (const std::uint32_t q : quads) {
            const Vec4I& ids = table.corners(q);
            int i = 0;
            while (ids[i] != v) ++i;
            const auto corner = [&](int k) { return surface.point(ids[(i + k) % 4]); };
            by += corner(1) - corner(2) + corner(3) - corner(0);
        }
        by /= static_cast<double>(quads.size());
        const Vec3d up = outward(surface, star);
        by -= by.dot(up) * up;
        return towards(surface, star, surface.point(v) + by, {0.5, 0.25, 0.1});
    });
}

std::size_t countUnfit(const GuardedMesh& surface, const QuadTable& table)
{
    std::size_t count = 0;
    for (std::uint32_t q = 0; q < table.quads(); ++q)
        count += table.isQuad(q) && !isFit(surface, pointsOf(surface, table.corners(q)));
    return count;
}

} // namespace vdbcage::detail
