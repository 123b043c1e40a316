#include <vdbcage/mesh/mesh.h>

#include <cmath>
#include <sstream>
#include <string>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <vdbcage/core/error.h>

namespace vdbcage {

namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;

template <typename Visit>
void forEachCorner(const Mesh& mesh, const Visit& visit)
{
    for (const openvdb::Vec3I& triangle : mesh.triangles) {
        for (int i = 0; i < 3; ++i) visit(triangle[i]);
    }
    for (const openvdb::Vec4I& quad : mesh.quads) {
        for (int i = 0; i < 4; ++i) visit(quad[i]);
    }
}

bool isDegenerate(const Mesh& mesh, const openvdb::Vec3I& triangle)
{
    const auto point = [&](int i) {
        const openvdb::Vec3d& p = mesh.points[triangle[i]];
        return Kernel::Point_3(p.x(), p.y(), p.z());
    };
    return CGAL::collinear(point(0), point(1), point(2));
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

openvdb::BBoxd boundingBox(const Mesh& mesh)
{
    openvdb::BBoxd box;
    forEachCorner(mesh, [&](openvdb::Index32 corner) { box.expand(mesh.points[corner]); });
    return box;
}

void requireUsable(const Mesh& mesh, const char* what)
{
    const auto fail = [&](const std::string& problem) { throw InputError(std::string(what) + ": " + problem); };
    if (faceCount(mesh) == 0) fail("it has no faces; at least one is needed");
    forEachCorner(mesh, [&](openvdb::Index32 corner) {
        if (corner >= mesh.points.size()) {
            fail("a face uses point " + std::to_string(corner) + "; there are " + std::to_string(mesh.points.size()) +
                 " points, counted from 0");
        }
        const openvdb::Vec3d& p = mesh.points[corner];
        if (!std::isfinite(p.x()) || !std::isfinite(p.y()) || !std::isfinite(p.z())) {
            std::ostringstream text;
            text << "point " << corner << " is (" << p.x() << ", " << p.y() << ", " << p.z()
                 << "); coordinates must be finite";
            fail(text.str());
        }
    });
    for (const openvdb::Vec3I& triangle : mesh.triangles) {
        if (!isDegenerate(mesh, triangle)) return;
    }
    for (const openvdb::Vec4I& quad : mesh.quads) {
        for (const openvdb::Vec3I& half :
             {openvdb::Vec3I(quad[0], quad[1], quad[2]), openvdb::Vec3I(quad[0], quad[2], quad[3])}) {
            if (!isDegenerate(mesh, half)) return;
        }
    }
    fail("every face is degenerate (its corners are on a line); at least one must have an area");
}

} // namespace vdbcage
