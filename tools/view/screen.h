#pragma once

#include <cstdint>
#include <optional>

#include <tools/draw/canvas.h>
#include <tools/draw/picture.h>
#include <tools/view/picture/viewports.h>
#include <tools/view/widgets/widget_renderer.h>
#include <tools/view/widgets/widgets.h>

namespace vdbcage::view {

/// The content of the window: the pictures, and the panels over them. A frame is drawn only when one of them changed.
///
/// Its context must be current in each call, and must outlive it.
class Screen {
public:
    /// See Viewport. \throw DeviceError
    Screen(const gl::Api& api, bool isSoftware, const Widgets& widgets);

    /// Sets the size. Returns whether it changed. \pre width > 0, height > 0 \throw DeviceError
    bool resize(int width, int height);
    int width() const { return width_; }
    int height() const { return height_; }

    /// Notes that something other than panels and pictures changed.
    void invalidate() { isStale_ = true; }

    /// Returns whether there is something to draw. `isMoving`, here and below: another frame will follow in a moment,
    /// so this one may be rough.
    bool needsFrame(bool isMoving) const;
    /// Draws the next frame into canvas(). \throw DeviceError
    void drawFrame(bool isMoving);
    /// Returns the frame, after all that is left to draw. \throw DeviceError
    draw::Picture picture(bool isMoving);
    const draw::Canvas& canvas() const { return *canvas_; }
    /// Returns the number of frames drawn.
    std::uint64_t frames() const { return frames_; }

    Viewports& viewports() { return viewports_; }
    const Viewports& viewports() const { return viewports_; }

private:
    bool leavesItRough(bool isMoving) const { return isMoving && viewports_.isDrawn(); }

    const gl::Api& api_;
    const Widgets& widgets_;
    WidgetRenderer widgetRenderer_;
    Viewports viewports_;
    std::optional<draw::Canvas> canvas_;
    int width_ = 0, height_ = 0;
    bool isStale_ = true;
    std::uint64_t drawnWidgets_ = 0; ///< their version in the last frame
    std::uint64_t frames_ = 0;
};

} // namespace vdbcage::view
