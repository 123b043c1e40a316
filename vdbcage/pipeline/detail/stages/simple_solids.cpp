#include <vdbcage/pipeline/detail/stages/simple_solids.h>

namespace vdbcage::detail {

Mesh boxMesh(const openvdb::BBoxd& box)
{
    Mesh mesh;
    for (int corner = 0; corner < 8; ++corner) {
        mesh.points.emplace_back((corner & 1 ? box.max() : box.min()).x(), (corner & 2 ? box.max() : box.min()).y(),
                                 (corner & 4 ? box.max() : box.min()).z());
    }
    mesh.quads = {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}};
    return mesh;
}

Mesh tetrahedronMesh(const openvdb::BBoxd& box)
{
    const openvdb::Vec3d low = box.min(), size = 3 * box.extents();
    Mesh mesh;
    mesh.points.push_back(low);
    for (const int axis : {0, 1, 2}) {
        mesh.points.push_back(low);
        mesh.points.back()[axis] += size[axis];
    }
    mesh.triangles = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};
    return mesh;
}

} // namespace vdbcage::detail
