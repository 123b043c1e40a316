#pragma once

#include <array>
#include <vector>

#include <openvdb/math/Vec3.h>
#include <vdbcage/mesh/mesh.h>

namespace vdbcage::render {

using Vec3f = std::array<float, 3>;

/// Maps world space to a ball of radius 1 around the origin, where single precision does for pictures.
class Frame {
public:
    /// The frame of what is in `box` (not empty, finite), however small, large or far from the origin.
    explicit Frame(const openvdb::BBoxd& box);

    openvdb::Vec3d operator()(const openvdb::Vec3d& point) const;

private:
    /// Coordinates of magnitude 1 at most, so that no later step overflows or underflows.
    openvdb::Vec3d scaled(const openvdb::Vec3d& point) const;

    int exponent_ = 0;
    openvdb::Vec3d centre_{0};
    double radius_ = 1;
};

struct Corner {
    Vec3f position;
    Vec3f normal; ///< unit, or zero where a face has no area
    Vec3f colour; ///< of the point, white if it has none
};
struct Segment {
    Vec3f from, to;
};

/// What one draws of a mesh, in a frame's coordinates.
struct Geometry {
    std::vector<Corner> corners;   ///< three a triangle, two triangles a quad
    std::vector<Segment> segments; ///< each edge of the faces once
};

/// Points at the same place count as one. Normals are angle-weighted means over the faces that are joined around a
/// point by edges whose faces meet at less than `creaseDegrees`; 0: every face is flat. `pointColours` has one for each
/// point or none. O(n log n) in the faces.
Geometry makeGeometry(const Mesh& mesh, const Frame& frame, double creaseDegrees,
                      const std::vector<Vec3f>& pointColours = {});

} // namespace vdbcage::render
