#include <vdbcage/pipeline/detail/stages/mesh_tools.h>

#include <algorithm>

namespace vdbcage::detail {

Mesh turned(Mesh mesh, const openvdb::Mat3d& rows)
{
    for (openvdb::Vec3d& point : mesh.points) point = rows * point;
    return mesh;
}

Mesh triangulated(Mesh mesh)
{
    mesh.triangles = triangulate(mesh);
    mesh.quads.clear();
    return mesh;
}

openvdb::BBoxd boxWithMirrorImage(const openvdb::BBoxd& box, const SymmetryPlane& plane)
{
    openvdb::Vec3d low = box.min(), high = box.max();
    const double farther = std::max(high[plane.axis] - plane.offset, plane.offset - low[plane.axis]);
    low[plane.axis] = plane.offset - farther;
    high[plane.axis] = plane.offset + farther;
    openvdb::BBoxd both = box; // rounding must not make it smaller
    both.expand(openvdb::BBoxd(low, high));
    return both;
}

} // namespace vdbcage::detail
