#include <tools/view/picture/averaged_canvas.h>

#include <algorithm>
#include <array>

namespace vdbcage::view {

namespace {

/// Returns the place of the i-th of `shifts` frames within a pixel, in [-1/2, 1/2]: each row and each column of a grid
/// of 16 by 16 once (Shirley, Discrepancy as a quality measure for sample distributions, 1991: n rooks).
std::array<double, 2> shiftOf(int i)
{
    return {(i + 0.5) / 16 - 0.5, (i * 7 % 16 + 0.5) / 16 - 0.5};
}

} // namespace

AveragedCanvas::AveragedCanvas(const gl::Api& api) : api_(&api)
{
    resize(1, 1);
}

bool AveragedCanvas::resize(int width, int height)
{
    if (width == width_ && height == height_) return false;
    canvas_.reset(); // frees its memory first
    canvas_.emplace(*api_, width, height, 1);
    averageFramebuffer_ = gl::Framebuffer();
    average_ = gl::makeTexture2D(*api_, GL_RGBA8, width, height);
    averageFramebuffer_ = gl::makeFramebuffer(*api_, average_, gl::Texture());
    width_ = width;
    height_ = height;
    return true;
}

void AveragedCanvas::restart()
{
    frames_ = 0;
    isDrawn_ = false;
}

void AveragedCanvas::draw(bool isMoving, const std::function<void(const draw::Target&, const draw::Crop&)>& drawFrame)
{
    if (isMoving) frames_ = 0;
    if (isRefined()) return;
    draw::Crop crop;
    if (!isMoving) {
        const auto [x, y] = shiftOf(frames_);
        crop.x = 2 * x / width_;
        crop.y = 2 * y / height_;
    }
    drawFrame(canvas_->target(), crop);
    isDrawn_ = true;
    if (isMoving) return;
    const std::vector<std::uint8_t> pixels = canvas_->pixels();
    sums_.resize(pixels.size());
    if (frames_ == 0) std::fill(sums_.begin(), sums_.end(), std::uint16_t(0));
    for (std::size_t i = 0; i < pixels.size(); ++i) sums_[i] = static_cast<std::uint16_t>(sums_[i] + pixels[i]);
    ++frames_;
    means_.resize(pixels.size());
    for (std::size_t i = 0; i < means_.size(); ++i) {
        means_[i] = static_cast<std::uint8_t>((sums_[i] + frames_ / 2) / frames_);
    }
    api_->PixelStorei(GL_UNPACK_ALIGNMENT, 1);
    api_->TextureSubImage2D(average_.name(), 0, 0, 0, width_, height_, GL_RGBA, GL_UNSIGNED_BYTE, means_.data());
}

draw::Picture AveragedCanvas::picture() const
{
    return draw::fromPixels(means_, width_, height_, false);
}

void AveragedCanvas::copyTo(GLuint framebuffer, int left, int bottom) const
{
    const GLuint from = frames_ > 0 ? averageFramebuffer_.name() : canvas_->target().framebuffer;
    api_->Disable(GL_SCISSOR_TEST);
    api_->BlitNamedFramebuffer(from, framebuffer, 0, 0, width_, height_, left, bottom, left + width_, bottom + height_,
                               GL_COLOR_BUFFER_BIT, GL_NEAREST);
}

} // namespace vdbcage::view
