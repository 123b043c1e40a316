#include <vdbcage/mesh/mesh.h>

#include <cmath>
#include <string>

#include <vdbcage/core/detail/number_text.h>
#include <vdbcage/core/error.h>
#include <vdbcage/mesh/detail/degenerate.h>

namespace vdbcage {

namespace {

template <typename Visit>
void forEachIndex(const Mesh& mesh, const Visit& visit)
{
    for (const openvdb::Vec3I& triangle : mesh.triangles) {
        for (int i = 0; i < 3; ++i) visit(triangle[i]);
    }
    for (const openvdb::Vec4I& quad : mesh.quads) {
        for (int i = 0; i < 4; ++i) visit(quad[i]);
    }
    for (const openvdb::Vec3I& triangle : mesh.alternatives) {
        for (int i = 0; i < 3; ++i) visit(triangle[i]);
    }
}

} // namespace

std::vector<openvdb::Vec3I> triangulate(const Mesh& mesh)
{
    std::vector<openvdb::Vec3I> triangles = mesh.triangles;
    triangles.reserve(mesh.triangles.size() + 2 * mesh.quads.size());
    for (const openvdb::Vec4I& quad : mesh.quads) {
        triangles.emplace_back(quad[0], quad[1], quad[2]);
        triangles.emplace_back(quad[0], quad[2], quad[3]);
    }
    return triangles;
}

std::vector<openvdb::Vec3I> everySplit(const Mesh& mesh)
{
    std::vector<openvdb::Vec3I> triangles = triangulate(mesh);
    triangles.reserve(triangles.size() + 2 * mesh.quads.size() + mesh.alternatives.size());
    for (const openvdb::Vec4I& quad : mesh.quads) {
        triangles.emplace_back(quad[0], quad[1], quad[3]);
        triangles.emplace_back(quad[1], quad[2], quad[3]);
    }
    triangles.insert(triangles.end(), mesh.alternatives.begin(), mesh.alternatives.end());
    return triangles;
}

std::vector<openvdb::Index32> loosePoints(const Mesh& mesh)
{
    std::vector<bool> isUsed(mesh.points.size(), false);
    forEachIndex(mesh, [&](openvdb::Index32 corner) { isUsed[corner] = true; });
    std::vector<openvdb::Index32> loose;
    for (openvdb::Index32 i = 0; i < isUsed.size(); ++i) {
        if (!isUsed[i]) loose.push_back(i);
    }
    return loose;
}

openvdb::BBoxd boundingBox(const Mesh& mesh)
{
    openvdb::BBoxd box;
    forEachIndex(mesh, [&](openvdb::Index32 corner) { box.expand(mesh.points[corner]); });
    return box;
}

void requireUsable(const Mesh& mesh, const char* what)
{
    const auto fail = [&](const std::string& problem) { throw InputError(what, problem); };
    if (faceCount(mesh) == 0) fail("it has no faces; at least one is needed");
    forEachIndex(mesh, [&](openvdb::Index32 corner) {
        if (corner >= mesh.points.size()) {
            fail("a face uses point " + std::to_string(corner) + "; there are " + std::to_string(mesh.points.size()) +
                 " points, counted from 0");
        }
        const openvdb::Vec3d& p = mesh.points[corner];
        if (!std::isfinite(p.x()) || !std::isfinite(p.y()) || !std::isfinite(p.z())) {
            fail("point " + std::to_string(corner) + " is (" + detail::numberText(p.x()) + ", " +
                 detail::numberText(p.y()) + ", " + detail::numberText(p.z()) + "); coordinates must be finite");
        }
    });
    for (const openvdb::Vec3I& triangle : mesh.triangles) {
        if (!detail::isDegenerate(mesh, triangle)) return;
    }
    for (const openvdb::Vec4I& quad : mesh.quads) {
        for (const openvdb::Vec3I& half :
             {openvdb::Vec3I(quad[0], quad[1], quad[2]), openvdb::Vec3I(quad[0], quad[2], quad[3])}) {
            if (!detail::isDegenerate(mesh, half)) return;
        }
    }
    fail("every face is degenerate (its corners are on a line); at least one must have an area");
}

} // namespace vdbcage
