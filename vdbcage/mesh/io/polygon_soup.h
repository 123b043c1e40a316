#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include <vdbcage/mesh/io/warnings.h>
#include <vdbcage/mesh/mesh.h>
#include <vdbcage/mesh/mesh_io.h>

namespace vdbcage::detail {

/// The contents of a file before polygons are split. Faces may come before the points that they use.
struct PolygonSoup {
    std::vector<openvdb::Vec3d> points;
    std::vector<openvdb::Vec3I> triangles;
    std::vector<openvdb::Index32> corners; ///< of the faces with more than three corners, one after another
    std::vector<std::size_t> ends;         ///< the end of each of these faces in `corners`
    std::size_t ignoredElements = 0;

    /// Adds a face. One of fewer than three corners is not a surface and counts as ignored.
    void addFace(const openvdb::Index32* face, std::size_t count)
    {
        if (count < 3) {
            ++ignoredElements;
        } else if (count == 3) {
            triangles.emplace_back(face[0], face[1], face[2]);
        } else {
            corners.insert(corners.end(), face, face + count);
            ends.push_back(corners.size());
        }
    }
};

/// The largest number of triangles in all alternate splits of a model's polygons, except quads. Each takes about 80
/// bytes while a cage is made: 1.3 GB in all, measured with 4200 faces of 64 corners. Without a bound 20,000 such faces
/// took 7.6 GB.
constexpr std::size_t mostAlternates = std::size_t(1) << 24U;

/// Splits the polygons, and checks that there is a face with an area.
/// \pre all indices are in range and all coordinates finite
/// \throw IoError naming `name`, which is the file's
MeshFile toMesh(PolygonSoup soup, const std::string& name, const Warnings& warnings = {});

} // namespace vdbcage::detail
