#pragma once

#include <tools/draw/renderer.h>
#include <tools/view/widgets/drawing.h>
#include <vdbcage/gl/objects.h>

namespace vdbcage::view {

/// A renderer of widgets by OpenGL 4.5. Its context must be current in each call, and must outlive it.
class WidgetRenderer {
public:
    /// \throw DeviceError
    WidgetRenderer(const gl::Api& api, const Glyphs& glyphs);

    /// Draws over the target's content. The target's colours are multiplied by their alpha, as must be those of
    /// textures that the drawing names.
    /// It assumes no state of the context. After it, blending and all tests are off; bound are the target's
    /// framebuffer, its own program and arrays, and at texture unit 0 any texture.
    /// \pre the drawing has the size of the target, in pixels of the framebuffer
    /// \pre one sample a pixel: with several, Mesa's software cuts rectangles off in the middle of pixels
    /// \throw DeviceError out of memory. The caller must ask for other failures (gl::throwIfFailed).
    void draw(const draw::Target& target, const Drawing& drawing);

private:
    void upload(const Drawing& drawing);

    const gl::Api& api_;
    gl::ProgramObject program_;
    gl::Texture glyphs_;
    std::size_t vertexCapacity_ = 0, indexCapacity_ = 0; ///< bytes
    gl::Buffer vertices_, indices_;
    gl::VertexArray arrays_;
};

} // namespace vdbcage::view
