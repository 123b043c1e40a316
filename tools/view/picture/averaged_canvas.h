#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include <tools/draw/canvas.h>
#include <tools/draw/picture.h>

namespace vdbcage::view {

/// A canvas for a picture that moves or stands still. While it moves a frame has one sample a pixel. When it stands
/// still, frames shifted by parts of a pixel are averaged, one a call.
///
/// Its context must be current whenever it is used, and must outlive it.
class AveragedCanvas {
public:
    /// \throw DeviceError
    explicit AveragedCanvas(const gl::Api& api);

    /// Returns whether it had another size before. \pre width > 0, height > 0 \throw DeviceError
    bool resize(int width, int height);
    int width() const { return width_; }
    int height() const { return height_; }

    /// Something changed: what was drawn is no longer what is to be seen.
    void restart();
    /// Nothing is left to draw until something changes.
    bool isRefined() const { return frames_ == shifts; }
    /// What is to be seen was drawn once at least, if only as it is while something moves.
    bool isDrawn() const { return isDrawn_; }

    /// Draws a frame by `drawFrame`, which gets a target and the part of the panel that fills it, if there is any left
    /// to draw. \throw DeviceError
    void draw(bool isMoving, const std::function<void(const draw::Target&, const draw::Crop&)>& drawFrame);

    /// The mean of all frames. \pre isRefined()
    draw::Picture picture() const;
    /// Copies what was drawn to a framebuffer, its lower left corner to (left, bottom).
    void copyTo(GLuint framebuffer, int left, int bottom) const;

private:
    static constexpr int shifts = 16; ///< frames that are averaged

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
