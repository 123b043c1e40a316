#pragma once

#include <optional>

#include <tools/draw/camera.h>
#include <tools/draw/shape.h>

namespace vdbcage::view {

/// A grid of lines below the model, at multiples of a round step, so that coordinates can be read.
class GroundGrid {
public:
    /// Makes the grid below a box. \throw DeviceError
    void fill(const gl::Api& api, const draw::Frame& frame, const openvdb::BBoxd& box, draw::UpAxis up);

    /// Returns the shape; none: it was not filled yet.
    const std::optional<draw::Shape>& shape() const { return shape_; }
    /// Returns the distance between two lines, in world space: 1, 2 or 5 times a power of ten.
    double step() const { return step_; }

private:
    std::optional<draw::Shape> shape_;
    double step_ = 0;
};

} // namespace vdbcage::view
