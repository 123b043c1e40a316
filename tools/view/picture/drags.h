#pragma once

#include <array>
#include <vector>

#include <tools/draw/camera.h>
#include <tools/view/input/key_map.h>
#include <tools/view/picture/gizmo.h>
#include <tools/view/picture/rectangle.h>

/// What a drag in the picture does: it moves the camera, or draws a border around what it selects.
namespace vdbcage::view {

/// A pixel's place in the panel, [-1, 1] both ways, y up.
std::array<double, 2> inPanel(const Rectangle& picture, const Pixel& at);
/// Width by height.
double aspectOf(const Rectangle& picture);

/// A drag that turns, moves or zooms the view.
struct CameraDrag {
    DragAction action{};
    Pixel from{};            ///< where it began
    openvdb::Vec3d pivot{0}; ///< that the view turns around; drawing coordinates
    double pixel = 1;        ///< pixels that a length of 1 has on an ordinary screen

    /// The camera after (dx, dy) pixels more, right and down.
    draw::Camera moved(const draw::Camera& camera, const Rectangle& picture, double dx, double dy) const;
};

/// The border of a box or lasso that is drawn.
class Band {
public:
    Band() = default;
    Band(bool isBox, const Pixel& from) : isBox_(isBox), places_{from} {}

    /// It was begun.
    bool isThere() const { return !places_.empty(); }
    /// It goes round something.
    bool hasInside() const { return places_.size() > 1; }
    /// Of a lasso two corners are `step` pixels apart at least.
    void moveTo(const Pixel& at, double step);
    std::vector<Pixel> border() const;

private:
    bool isBox_ = false;
    std::vector<Pixel> places_; ///< two corners of a box, or a lasso
};

} // namespace vdbcage::view
