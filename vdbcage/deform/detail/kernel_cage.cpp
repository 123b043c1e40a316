#include <vdbcage/deform/detail/kernels/kernel_cage.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include <vdbcage/deform/detail/gauss.h>
#include <vdbcage/deform/detail/triangle_potentials.h>
#include <vdbcage/deform/detail/unit_cage.h>

namespace vdbcage::detail {

using openvdb::Vec3d;

namespace {

void copy(const Vec3d& from, double (&to)[3])
{
    for (int a = 0; a < 3; ++a) to[a] = from[a];
}

KernelRules kernelRules()
{
    // Digits of the tolerance, see samplePatch(): one digit less than there keeps weights to 3e-9, and takes a fifth
    // less time.
    constexpr double digits = 8 * 2.302585092994046;
    static_assert(KernelRules::most == mostGaussPoints);
    KernelRules rules{};
    for (int n = 1; n <= KernelRules::most; ++n) {
        const GaussRule& rule = gaussRule(n);
        std::copy(rule.at.begin(), rule.at.end(), rules.at[n]);
        std::copy(rule.weight.begin(), rule.weight.end(), rules.weight[n]);
        rules.leastDistance[n] = std::sinh(digits / (2 * n));
    }
    return rules;
}

KernelQuad kernelQuad(const UnitCage::Face& face, const PatchCorners& c)
{
    KernelQuad quad{};
    std::copy(face.at.begin(), face.at.end(), quad.corner);
    const Vec3d middle = 0.25 * (c[0] + c[1] + c[2] + c[3]);
    copy(middle, quad.extent.middle);
    for (const Vec3d& corner : c) quad.extent.radius = std::max(quad.extent.radius, (corner - middle).length());
    quad.extent.halfU = 0.5 * std::max((c[1] - c[0]).length(), (c[2] - c[3]).length());
    quad.extent.halfV = 0.5 * std::max((c[3] - c[0]).length(), (c[2] - c[1]).length());
    return quad;
}

struct Place {
    double at[3];
};

/// A KernelCage and the arrays that it points to.
struct Arrays {
    explicit Arrays(const UnitCage& unitCage);
    Arrays(const Arrays&) = delete;
    Arrays& operator=(const Arrays&) = delete;

    std::vector<Place> points, restoring, normals;
    std::vector<KernelEdge> edges;
    std::vector<KernelTriangle> triangles;
    std::vector<KernelQuad> quads;
    KernelRules rules;
    KernelCage cage;
};

Arrays::Arrays(const UnitCage& unitCage) : rules(kernelRules())
{
    const auto places = [](const std::vector<Vec3d>& from) {
        std::vector<Place> to(from.size());
        for (std::size_t i = 0; i < from.size(); ++i) copy(from[i], to[i].at);
        return to;
    };
    points = places(unitCage.points());
    restoring = places(unitCage.restoring());
    std::vector<Vec3d> faceNormals;
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> edgeOf;
    for (const UnitCage::Face& face : unitCage.faces()) {
        const auto corner = [&](std::size_t k) { return unitCage.points()[face.at[k]]; };
        if (face.quad) {
            quads.push_back(kernelQuad(face, {corner(0), corner(1), corner(2), corner(3)}));
            for (std::size_t k = 0; k < 4; ++k) {
                faceNormals.push_back((corner((k + 1) % 4) - corner(k)).cross(corner((k + 3) % 4) - corner(k)));
            }
            continue;
        }
        KernelTriangle t{};
        const Vec3d areaNormal = (corner(1) - corner(0)).cross(corner(2) - corner(0));
        t.area = areaNormal.length();
        const Vec3d normal = t.area > 0 ? areaNormal / t.area : Vec3d(0);
        double longest = 0;
        Vec3d sides[3], along[3];
        for (std::size_t k = 0; k < 3; ++k) {
            const std::uint32_t from = face.at[(k + 1) % 3], to = face.at[(k + 2) % 3];
            sides[k] = corner((k + 2) % 3) - corner((k + 1) % 3);
            const double length = sides[k].length();
            along[k] = length > 0 ? sides[k] / length : Vec3d(0);
            longest = std::max(longest, length);
            const auto [edge, isNew] =
                edgeOf.try_emplace(std::minmax(from, to), static_cast<std::uint32_t>(edges.size()));
            if (isNew) edges.push_back({edge->first.first, edge->first.second, length});
            t.corner[k] = face.at[k];
            t.edge[k] = edge->second;
            t.sign[k] = from < to ? 1 : -1;
            copy(along[k].cross(normal), t.outward[k]);
        }
        const Vec3d flat[2] = {along[2], normal.cross(along[2])}; // the edge from corner 0
        for (std::size_t k = 0; k < 3; ++k) {
            for (std::size_t axis = 0; axis < 2; ++axis) t.flat[k][axis] = flat[axis].dot(Vec3d(t.outward[k]));
        }
        for (std::size_t i = 0; i < 3; ++i) {
            for (std::size_t k = 0; k < 3; ++k) t.along[i][k] = along[k].dot(sides[i]) / t.area;
        }
        copy(normal, t.normal);
        t.sliver = !(t.area > sliverWidth * longest * longest);
        triangles.push_back(t);
        faceNormals.push_back(areaNormal);
    }
    normals = places(faceNormals);
    const auto rows = [](const std::vector<Place>& from) { return from.empty() ? nullptr : &from.front().at; };
    cage = {points.size(),    edges.size(), triangles.size(), quads.size(),  rows(points), edges.data(),
            triangles.data(), quads.data(), rows(restoring),  rows(normals), &rules,       &unitCage};
}

} // namespace

std::shared_ptr<const KernelCage> kernelCage(const UnitCage& cage)
{
    const auto arrays = std::make_shared<const Arrays>(cage);
    return {arrays, &arrays->cage};
}

} // namespace vdbcage::detail
