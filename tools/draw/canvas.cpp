#include <tools/draw/canvas.h>

namespace vdbcage::draw {

Canvas::Canvas(const gl::Api& api, int width, int height, int samples)
    : api_(&api), width_(width), height_(height), samples_(samples),
      colour_(gl::makeTexture2D(api, GL_RGBA8, width, height, samples)),
      depth_(gl::makeTexture2D(api, GL_DEPTH24_STENCIL8, width, height, samples)),
      flatColour_(gl::makeTexture2D(api, GL_RGBA8, width, height)), drawing_(gl::makeFramebuffer(api, colour_, depth_)),
      flat_(gl::makeFramebuffer(api, flatColour_, gl::Texture()))
{
}

Target Canvas::target() const
{
    Target target;
    target.framebuffer = drawing_.name();
    target.width = width_;
    target.height = height_;
    target.samples = samples_;
    return target;
}

std::vector<std::uint8_t> Canvas::pixels() const
{
    api_->BlitNamedFramebuffer(drawing_.name(), flat_.name(), 0, 0, width_, height_, 0, 0, width_, height_,
                               GL_COLOR_BUFFER_BIT, GL_NEAREST);
    api_->BindFramebuffer(GL_FRAMEBUFFER, flat_.name());
    api_->PixelStorei(GL_PACK_ALIGNMENT, 1);
    std::vector<std::uint8_t> pixels(4 * static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_));
    api_->ReadPixels(0, 0, width_, height_, GL_RGBA, GL_UNSIGNED_BYTE, pixels.data());
    gl::throwIfFailed(*api_, "drawing a picture");
    return pixels;
}

} // namespace vdbcage::draw
