#include <tools/view/widgets/widget_renderer.h>

#include <cstddef>
#include <initializer_list>

#include <shaders/view.h>
#include <vdbcage/gl/program.h>

namespace vdbcage::view {

namespace {

using GLenums = std::initializer_list<GLenum>; // the constants are signed

/// Returns the texture of the glyphs. They are white, so OpenGL reads their coverage in every channel, as in colours
/// that are multiplied by alpha.
gl::Texture makeGlyphTexture(const gl::Api& api, const Glyphs& glyphs)
{
    gl::Texture texture = gl::makeTexture2D(api, GL_R8, glyphs.width, glyphs.height);
    for (const GLenum channel :
         GLenums{GL_TEXTURE_SWIZZLE_R, GL_TEXTURE_SWIZZLE_G, GL_TEXTURE_SWIZZLE_B, GL_TEXTURE_SWIZZLE_A}) {
        api.TextureParameteri(texture.name(), channel, GL_RED);
    }
    for (const GLenum filter : GLenums{GL_TEXTURE_MIN_FILTER, GL_TEXTURE_MAG_FILTER}) {
        api.TextureParameteri(texture.name(), filter, GL_LINEAR);
    }
    api.PixelStorei(GL_UNPACK_ALIGNMENT, 1);
    api.TextureSubImage2D(texture.name(), 0, 0, 0, glyphs.width, glyphs.height, GL_RED, GL_UNSIGNED_BYTE,
                          glyphs.coverage.data());
    return texture;
}

/// Makes room for `needed` bytes, and for some more so that a growing panel seldom needs another buffer.
void grow(const gl::Api& api, gl::Buffer& buffer, std::size_t& capacity, std::size_t needed)
{
    if (buffer.name() != 0 && needed <= capacity) return;
    const std::size_t wanted = needed + needed / 2;
    buffer = gl::makeBuffer(api, wanted, nullptr, GL_DYNAMIC_STORAGE_BIT);
    capacity = wanted;
}

template <typename Value>
std::size_t sizeOf(const std::vector<Value>& values)
{
    return values.size() * sizeof(Value);
}

} // namespace

WidgetRenderer::WidgetRenderer(const gl::Api& api, const Glyphs& glyphs)
    : api_(api), program_(gl::makeProgram(api, {shaders::widgetVert, shaders::widgetFrag})),
      glyphs_(makeGlyphTexture(api, glyphs)), arrays_(gl::makeVertexArray(api))
{
    using Vertex = Drawing::Vertex;
    api.VertexArrayAttribFormat(arrays_.name(), 0, 2, GL_FLOAT, GL_FALSE, offsetof(Vertex, x));
    api.VertexArrayAttribFormat(arrays_.name(), 1, 2, GL_FLOAT, GL_FALSE, offsetof(Vertex, u));
    api.VertexArrayAttribFormat(arrays_.name(), 2, 4, GL_UNSIGNED_BYTE, GL_TRUE, offsetof(Vertex, rgba));
    for (GLuint attribute = 0; attribute < 3; ++attribute) {
        api.VertexArrayAttribBinding(arrays_.name(), attribute, 0);
        api.EnableVertexArrayAttrib(arrays_.name(), attribute);
    }
    gl::throwIfFailed(api, "preparing to draw widgets");
}

void WidgetRenderer::upload(const Drawing& drawing)
{
    const std::size_t vertexBytes = sizeOf(drawing.vertices);
    const std::size_t indexBytes = sizeOf(drawing.indices);
    grow(api_, vertices_, vertexCapacity_, vertexBytes);
    grow(api_, indices_, indexCapacity_, indexBytes);
    api_.NamedBufferSubData(vertices_.name(), 0, static_cast<GLsizeiptr>(vertexBytes), drawing.vertices.data());
    api_.NamedBufferSubData(indices_.name(), 0, static_cast<GLsizeiptr>(indexBytes), drawing.indices.data());
    api_.VertexArrayVertexBuffer(arrays_.name(), 0, vertices_.name(), 0, sizeof(Drawing::Vertex));
    api_.VertexArrayElementBuffer(arrays_.name(), indices_.name());
}

void WidgetRenderer::draw(const draw::Target& target, const Drawing& drawing)
{
    if (!drawing.batches.empty()) upload(drawing);
    for (const GLenum state : GLenums{GL_CULL_FACE, GL_DEPTH_TEST, GL_STENCIL_TEST, GL_CLIP_DISTANCE0})
        api_.Disable(state);
    for (const GLenum state : GLenums{GL_BLEND, GL_SCISSOR_TEST}) api_.Enable(state);
    api_.BlendFuncSeparate(GL_ONE, GL_ONE_MINUS_SRC_ALPHA, GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
    api_.ColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    api_.BindFramebuffer(GL_FRAMEBUFFER, target.framebuffer);
    api_.Viewport(target.left, target.bottom, target.width, target.height);
    api_.ProgramUniform2f(program_.name(), gl::uniformLocation(api_, program_, "size"),
                          static_cast<float>(target.width), static_cast<float>(target.height));
    api_.UseProgram(program_.name());
    api_.BindVertexArray(arrays_.name());
    for (const Drawing::Batch& batch : drawing.batches) {
        api_.Scissor(target.left + batch.left, target.bottom + target.height - batch.bottom, batch.right - batch.left,
                     batch.bottom - batch.top);
        api_.BindTextureUnit(0, batch.texture != 0 ? batch.texture : glyphs_.name());
        api_.DrawElements(GL_TRIANGLES, static_cast<GLsizei>(batch.indexCount), GL_UNSIGNED_INT,
                          reinterpret_cast<const void*>(batch.firstIndex * sizeof(std::uint32_t)));
    }
    for (const GLenum state : GLenums{GL_BLEND, GL_SCISSOR_TEST}) api_.Disable(state);
}

} // namespace vdbcage::view
