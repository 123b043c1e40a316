#include <vdbcage/bounding/detail/quads/quad_relax.h>

#include <vdbcage/bounding/detail/guard/face_queries.h>
#include <vdbcage/bounding/detail/loops/joint_rings.h>
#include <vdbcage/bounding/detail/triangles/relax.h>

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
            weights.hold > 0 ? JointRings(surface, table).holds() : std::vector<JointRings::Hold>()};
}

void relaxQuads(GuardedMesh& surface, const QuadTable& table, const ShapeWeights& weights, int sweeps,
                Interrupter* interrupter)
{
    const double sample = areaPerSample(surface);
    const QuadShapeTerm term = shapeTerm(surface, table, weights, sample, interrupter);
    tighten(surface, sweeps, sample, interrupter, &term);
}

void relaxQuads(GuardedMesh& surface, const QuadTable& table, int sweeps, Interrupter* interrupter)
{
    relaxQuads(surface, table, usualShape, sweeps, interrupter);
}

void relaxQuads(GuardedMesh& surface, const QuadTable& table, const std::vector<std::uint32_t>& vertices, int sweeps,
                Interrupter* interrupter)
{
    const double sample = areaPerSample(surface);
    const QuadShapeTerm term = shapeTerm(surface, table, usualShape, sample, interrupter);
    tighten(surface, vertices, sweeps, sample, interrupter, &term);
}

std::size_t countUnfit(const GuardedMesh& surface, const QuadTable& table)
{
    std::size_t count = 0;
    for (std::uint32_t q = 0; q < table.quads(); ++q)
        count += table.isQuad(q) && !isFit(surface, pointsOf(surface, table.corners(q)));
    return count;
}

} // namespace vdbcage::detail
