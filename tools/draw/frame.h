#pragma once

#include <array>

#include <openvdb/Types.h>
#include <openvdb/math/BBox.h>

namespace vdbcage::draw {

using Vec3f = std::array<float, 3>;

/// A map from world space to drawing coordinates: a ball of radius 1 around the origin, where single precision is
/// enough for pictures. Everything that is drawn together, and the camera, is in the coordinates of one frame. A frame
/// scales all axes equally and does not turn, so directions and angles are those of world space.
class Frame {
public:
    /// Makes the frame for the content of `box` (not empty, finite), however small, large or far from the origin.
    explicit Frame(const openvdb::BBoxd& box);

    openvdb::Vec3d toDrawing(const openvdb::Vec3d& worldPoint) const;
    openvdb::Vec3d toWorld(const openvdb::Vec3d& drawnPoint) const;
    /// Returns the length in world space of a length of 1.
    double unit() const;

private:
    int exponent_ = 0; ///< of the power of two that divides world coordinates first
    openvdb::Vec3d centre_{0};
    double radius_ = 1;
};

} // namespace vdbcage::draw
