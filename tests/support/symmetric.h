#pragma once

#include <algorithm>
#include <cstddef>
#include <map>
#include <set>
#include <tuple>
#include <vector>

#include <vdbcage/mesh/mesh.h>
#include <vdbcage/mesh/symmetry.h>

namespace vdbcage::test {

inline openvdb::Vec3d mirrored(openvdb::Vec3d p, const SymmetryPlane& plane)
{
    p[plane.axis] = 2 * plane.offset - p[plane.axis];
    return p;
}

/// Returns the mirror image of a mesh, with its faces outward again.
inline Mesh mirrored(Mesh mesh, const SymmetryPlane& plane)
{
    for (auto& p : mesh.points) p = mirrored(p, plane);
    for (auto& t : mesh.triangles) std::swap(t[1], t[2]);
    for (auto& q : mesh.quads) std::swap(q[1], q[3]);
    return mesh;
}

/// Returns whether a mesh and its mirror image have the same points and faces: bit for bit, quads with the same first
/// diagonal.
inline bool isSymmetric(const Mesh& mesh, const SymmetryPlane& plane)
{
    using Key = std::tuple<double, double, double>;
    const auto key = [](const openvdb::Vec3d& p) { return Key(p.x(), p.y(), p.z()); };
    std::map<Key, openvdb::Index32> at;
    for (openvdb::Index32 i = 0; i < mesh.points.size(); ++i) at[key(mesh.points[i])] = i;
    if (at.size() != mesh.points.size()) return false; // two at one place
    std::vector<openvdb::Index32> image;
    for (const auto& p : mesh.points) {
        const auto found = at.find(key(mirrored(p, plane)));
        if (found == at.end()) return false;
        image.push_back(found->second);
    }
    using Face = std::vector<openvdb::Index32>;
    std::set<Face> faces, images;
    const auto fromLeast = [](Face face) {
        std::rotate(face.begin(), std::min_element(face.begin(), face.end()), face.end());
        return face;
    };
    for (const auto& t : mesh.triangles) {
        faces.insert(fromLeast({t[0], t[1], t[2]}));
        images.insert(fromLeast({image[t[0]], image[t[2]], image[t[1]]}));
    }
    for (const auto& q : mesh.quads) { // in steps of two corners: the diagonal stays
        const Face face{q[0], q[1], q[2], q[3]}, turned{q[2], q[3], q[0], q[1]};
        const Face other{image[q[0]], image[q[3]], image[q[2]], image[q[1]]},
            otherTurned{image[q[2]], image[q[1]], image[q[0]], image[q[3]]};
        faces.insert(std::min(face, turned));
        images.insert(std::min(other, otherTurned));
    }
    return faces == images;
}

} // namespace vdbcage::test
