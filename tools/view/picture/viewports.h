#pragma once

#include <memory>
#include <vector>

#include <tools/view/picture/rectangle.h>
#include <tools/view/picture/viewport.h>
#include <tools/view/posing/posing.h>

namespace vdbcage::view {

/// The picture of the window, or two side by side if two families of coordinates are compared. Both have one camera.
///
/// Its context must be current in each call, and must outlive it.
class Viewports {
public:
    /// See Viewport. \throw DeviceError
    Viewports(const gl::Api& api, bool isSoftware) : api_(api), isSoftware_(isSoftware), first_(api, isSoftware) {}

    /// Takes new content for the pictures within `place`: with the model as it follows the cage, and as `compared` has
    /// it if that is not null. Returns whether anything changed. \throw DeviceError
    bool show(const Rectangle& place, PictureContent content, const Follower& follower, const Follower* compared,
              const ViewState& view);

    /// See AveragedCanvas.
    void draw(bool isMoving);
    bool isRefined() const { return first_.canvas().isRefined() && (!second_ || second_->canvas().isRefined()); }
    bool isDrawn() const { return first_.canvas().isDrawn() && (!second_ || second_->canvas().isDrawn()); }
    /// Copies the drawn pictures to a window of that height.
    void copyTo(GLuint framebuffer, int height) const;

    /// Returns the places of the one or two pictures in the window.
    const std::vector<Rectangle>& places() const { return places_; }
    /// Returns the left picture: the model as it follows the cage.
    Viewport& first() { return first_; }
    const Viewport& first() const { return first_; }

private:
    const gl::Api& api_;
    bool isSoftware_;
    Viewport first_;
    std::unique_ptr<Viewport> second_; ///< null: nothing is compared
    std::vector<Rectangle> places_{Rectangle{0, 0, 1, 1}};
};

} // namespace vdbcage::view
