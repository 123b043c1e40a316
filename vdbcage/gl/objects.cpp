#include <vdbcage/gl/objects.h>

#include <string>

#include <vdbcage/core/error.h>

namespace vdbcage::gl {

namespace detail {

void deleteBuffer(const Api& api, GLuint name)
{
    api.DeleteBuffers(1, &name);
}

void deleteVertexArray(const Api& api, GLuint name)
{
    api.DeleteVertexArrays(1, &name);
}

void deleteTexture(const Api& api, GLuint name)
{
    api.DeleteTextures(1, &name);
}

void deleteFramebuffer(const Api& api, GLuint name)
{
    api.DeleteFramebuffers(1, &name);
}

void deleteShader(const Api& api, GLuint name)
{
    api.DeleteShader(name);
}

void deleteProgram(const Api& api, GLuint name)
{
    api.DeleteProgram(name);
}

} // namespace detail

Buffer makeBuffer(const Api& api, std::size_t size, const void* data, GLbitfield flags)
{
    GLuint name = 0;
    api.CreateBuffers(1, &name);
    Buffer buffer(api, name);
    // OpenGL has no buffers of size 0.
    api.NamedBufferStorage(name, static_cast<GLsizeiptr>(size > 0 ? size : 1), size > 0 ? data : nullptr, flags);
    throwIfFailed(api, "allocating a buffer");
    return buffer;
}

VertexArray makeVertexArray(const Api& api)
{
    GLuint name = 0;
    api.CreateVertexArrays(1, &name);
    return {api, name};
}

Texture makeTexture2D(const Api& api, GLenum format, int width, int height, int samples)
{
    GLuint name = 0;
    api.CreateTextures(samples > 1 ? GL_TEXTURE_2D_MULTISAMPLE : GL_TEXTURE_2D, 1, &name);
    Texture texture(api, name);
    if (samples > 1) {
        api.TextureStorage2DMultisample(name, samples, format, width, height, GL_TRUE);
    } else {
        api.TextureStorage2D(name, 1, format, width, height);
    }
    throwIfFailed(api, "allocating a texture");
    return texture;
}

Texture makeBufferTexture(const Api& api, GLenum format, const Buffer& buffer)
{
    GLuint name = 0;
    api.CreateTextures(GL_TEXTURE_BUFFER, 1, &name);
    Texture texture(api, name);
    api.TextureBuffer(name, format, buffer.name());
    throwIfFailed(api, "making a texture of a buffer");
    return texture;
}

namespace {

void requireComplete(const Api& api, const Framebuffer& framebuffer)
{
    throwIfFailed(api, "making a framebuffer");
    const GLenum status = api.CheckNamedFramebufferStatus(framebuffer.name(), GL_DRAW_FRAMEBUFFER);
    if (status != GL_FRAMEBUFFER_COMPLETE) {
        throw DeviceError("OpenGL: this framebuffer cannot be drawn into (status " + std::to_string(status) + ")");
    }
}

} // namespace

Framebuffer makeFramebuffer(const Api& api, const Texture& colour, const Texture& depthStencil)
{
    GLuint name = 0;
    api.CreateFramebuffers(1, &name);
    Framebuffer framebuffer(api, name);
    if (colour.name() != 0) api.NamedFramebufferTexture(name, GL_COLOR_ATTACHMENT0, colour.name(), 0);
    if (depthStencil.name() != 0) {
        api.NamedFramebufferTexture(name, GL_DEPTH_STENCIL_ATTACHMENT, depthStencil.name(), 0);
    }
    requireComplete(api, framebuffer);
    return framebuffer;
}

Framebuffer makeEmptyFramebuffer(const Api& api, int width, int height)
{
    GLuint name = 0;
    api.CreateFramebuffers(1, &name);
    Framebuffer framebuffer(api, name);
    api.NamedFramebufferParameteri(name, GL_FRAMEBUFFER_DEFAULT_WIDTH, width);
    api.NamedFramebufferParameteri(name, GL_FRAMEBUFFER_DEFAULT_HEIGHT, height);
    requireComplete(api, framebuffer);
    return framebuffer;
}

} // namespace vdbcage::gl
