#pragma once

#include <cstdint>
#include <optional>

#include <tools/draw/canvas.h>
#include <tools/draw/picture.h>
#include <tools/view/picture/pictures.h>
#include <tools/view/widgets/widget_renderer.h>
#include <tools/view/widgets/widgets.h>

namespace vdbcage::view {

/// What the window shows: the pictures, and the panels over them. A frame is drawn only when one of them changed.
///
/// Its context must be current whenever it is used, and must outlive it.
class Screen {
public:
    /// See Viewport. \throw DeviceError
    Screen(const gl::Api& api, bool isSoftware, const Widgets& widgets);

    /// Returns whether it had another size before. \pre width > 0, height > 0 \throw DeviceError
    bool resize(int width, int height);
    int width() const { return width_; }
    int height() const { return height_; }

    /// Something else than panels and pictures is to be seen in another way.
    void invalidate() { isStale_ = true; }

    /// `isMoving`, here and below: there will be another frame in a moment, so this one may be rough.
    bool needsFrame(bool isMoving) const;
    /// Draws the next frame into canvas(). \throw DeviceError
    void drawFrame(bool isMoving);
    /// The frame, after all that is left to draw. \throw DeviceError
    draw::Picture picture(bool isMoving);
    const draw::Canvas& canvas() const { return *canvas_; }
    /// How many frames were drawn.
    std::uint64_t frames() const { return frames_; }

    Pictures& pictures() { return pictures_; }
    const Pictures& pictures() const { return pictures_; }

private:
    bool leavesItRough(bool isMoving) const { return isMoving && pictures_.isDrawn(); }

    const gl::Api& api_;
    const Widgets& widgets_;
    WidgetRenderer widgetRenderer_;
    Pictures pictures_;
    std::optional<draw::Canvas> canvas_;
    int width_ = 0, height_ = 0;
    bool isStale_ = true;
    std::uint64_t drawnWidgets_ = 0; ///< their version in the last frame
    std::uint64_t frames_ = 0;
};

} // namespace vdbcage::view
