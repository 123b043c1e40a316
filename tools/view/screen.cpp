#include <tools/view/screen.h>

namespace vdbcage::view {

Screen::Screen(const gl::Api& api, bool isSoftware, const Widgets& widgets)
    : api_(api), widgets_(widgets), widgetRenderer_(api, widgets.glyphs()), viewports_(api, isSoftware)
{
}

bool Screen::resize(int width, int height)
{
    if (canvas_ && width == width_ && height == height_) return false;
    canvas_.reset(); // frees its memory first
    canvas_.emplace(api_, width, height, 1);
    width_ = width;
    height_ = height;
    invalidate();
    return true;
}

bool Screen::needsFrame(bool isMoving) const
{
    return isStale_ || widgets_.version() != drawnWidgets_ || (!viewports_.isRefined() && !leavesItRough(isMoving));
}

void Screen::drawFrame(bool isMoving)
{
    if (!leavesItRough(isMoving)) viewports_.draw(isMoving);
    draw::Target target = canvas_->target();
    viewports_.copyTo(target.framebuffer, height_);
    widgetRenderer_.draw(target, widgets_.drawing());
    gl::throwIfFailed(api_, "drawing the window");
    isStale_ = false;
    drawnWidgets_ = widgets_.version();
    ++frames_;
}

draw::Picture Screen::picture(bool isMoving)
{
    while (!viewports_.isRefined() && !isMoving) viewports_.draw(false);
    drawFrame(isMoving);
    return draw::fromPixels(canvas_->pixels(), width_, height_, false);
}

} // namespace vdbcage::view
