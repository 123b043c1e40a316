#pragma once

#include <array>
#include <vector>

#include <tools/draw/camera.h>
#include <tools/view/input/key_map.h>
#include <tools/view/picture/gizmo.h>
#include <tools/view/picture/rectangle.h>

/// The drags in the picture: they move the camera, or draw a border for a selection.
namespace vdbcage::view {

/// Returns a pixel's place in the panel, [-1, 1] both ways, y up.
std::array<double, 2> inPanel(const Rectangle& picture, const Pixel& at);
/// Returns width / height.
double aspectOf(const Rectangle& picture);

/// A drag that turns, moves or zooms the view.
struct CameraDrag {
    DragAction action{};
    Pixel from{};            ///< the pixel where it began
    openvdb::Vec3d pivot{0}; ///< the point that the view turns around, drawing coordinates
    double pixel = 1;        ///< pixels per pixel of an ordinary screen

    /// Returns the camera after (dx, dy) pixels more, right and down.
    draw::Camera moved(const draw::Camera& camera, const Rectangle& picture, double dx, double dy) const;
};

/// The border of a box or lasso that is being drawn.
class Band {
public:
    Band() = default;
    Band(bool isBox, const Pixel& from) : isBox_(isBox), places_{from} {}

    /// Returns whether it was begun.
    bool isThere() const { return !places_.empty(); }
    /// Returns whether it has more than one corner.
    bool hasInside() const { return places_.size() > 1; }
    /// Moves the end. Corners of a lasso are at least `step` pixels apart.
    void moveTo(const Pixel& at, double step);
    std::vector<Pixel> border() const;

private:
    bool isBox_ = false;
    std::vector<Pixel> places_; ///< two corners of a box, or those of a lasso
};

} // namespace vdbcage::view
