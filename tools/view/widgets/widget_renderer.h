#pragma once

#include <tools/draw/renderer.h>
#include <tools/view/widgets/drawing.h>
#include <vdbcage/gl/objects.h>

namespace vdbcage::view {

/// Draws widgets by OpenGL 4.5. Its context must be current whenever it is used, and must outlive it.
class WidgetRenderer {
public:
    /// \throw DeviceError
    WidgetRenderer(const gl::Api& api, const Glyphs& glyphs);

    /// Draws over what the target has. Colours in it are times their alpha, and so are those of textures that the
    /// drawing names.
    /// It takes no state of the context for granted. After it, blending and all tests are off; bound are the target's
    /// framebuffer, its own program and arrays, and at texture unit 0 any texture.
    /// \pre the drawing has the size of the target, in pixels of the framebuffer
    /// \pre one sample a pixel: of several, Mesa's software cuts rectangles off in the middle of pixels
    /// \throw DeviceError out of memory. Other failures are for the caller to ask for (gl::throwIfFailed).
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
