#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include <tools/draw/canvas.h>
#include <tools/draw/picture.h>

namespace vdbcage::view {

/// A canvas for a picture that moves or stands still. While it moves a frame has one sample a pixel. When it stands
/// still, frames shifted by parts of a pixel are averaged, one in each call.
///
/// Its context must be current in each call, and must outlive it.
class AveragedCanvas {
public:
    /// \throw DeviceError
    explicit AveragedCanvas(const gl::Api& api);

    /// Sets the size. Returns whether it changed. \pre width > 0, height > 0 \throw DeviceError
    bool resize(int width, int height);
    int width() const { return width_; }
    int height() const { return height_; }

    /// Notes that the content changed, so all frames must be drawn again.
    void restart();
    /// Returns whether nothing is left to draw until the next change.
    bool isRefined() const { return frames_ == shifts; }
    /// Returns whether the present content was drawn at least once, if only roughly, as during motion.
    bool isDrawn() const { return isDrawn_; }

    /// Draws a frame by `drawFrame`, if any is left to draw. It gets a target and the part of the panel that fills it.
    /// \throw DeviceError
    void draw(bool isMoving, const std::function<void(const draw::Target&, const draw::Crop&)>& drawFrame);

    /// Returns the mean of all frames. \pre isRefined()
    draw::Picture picture() const;
    /// Copies the drawn picture to a framebuffer, its lower left corner to (left, bottom).
    void copyTo(GLuint framebuffer, int left, int bottom) const;

private:
    static constexpr int shifts = 16; ///< number of averaged frames

    const gl::Api* api_;
    int width_ = 0, height_ = 0;
    std::optional<draw::Canvas> canvas_;
    gl::Texture average_;
    gl::Framebuffer averageFramebuffer_;
    std::vector<std::uint16_t> sums_; ///< of each channel of the frames so far
    std::vector<std::uint8_t> means_;
    int frames_ = 0;
    bool isDrawn_ = false;
};

} // namespace vdbcage::view
