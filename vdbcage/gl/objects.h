#pragma once

#include <cstddef>
#include <utility>
#include <vector>

#include <vdbcage/gl/api.h>

namespace vdbcage::gl {

/// The owner of one OpenGL object; movable. It must be destroyed before its context, and while that is current.
template <void (*destroy)(const Api&, GLuint)>
class Object {
public:
    Object() = default;
    Object(const Api& api, GLuint name) : api_(&api), name_(name) {}
    ~Object()
    {
        if (name_ != 0) destroy(*api_, name_);
    }
    Object(Object&& other) noexcept : api_(other.api_), name_(std::exchange(other.name_, 0)) {}
    Object& operator=(Object&& other) noexcept
    {
        std::swap(api_, other.api_);
        std::swap(name_, other.name_);
        return *this;
    }
    Object(const Object&) = delete;
    Object& operator=(const Object&) = delete;

    /// Returns the object's name in OpenGL, 0 for none.
    GLuint name() const { return name_; }

private:
    const Api* api_ = nullptr;
    GLuint name_ = 0;
};

namespace detail {

void deleteBuffer(const Api& api, GLuint name);
void deleteVertexArray(const Api& api, GLuint name);
void deleteTexture(const Api& api, GLuint name);
void deleteFramebuffer(const Api& api, GLuint name);
void deleteShader(const Api& api, GLuint name);
void deleteProgram(const Api& api, GLuint name);

} // namespace detail

using Buffer = Object<detail::deleteBuffer>;
using VertexArray = Object<detail::deleteVertexArray>;
using Texture = Object<detail::deleteTexture>;
using Framebuffer = Object<detail::deleteFramebuffer>;
using ShaderObject = Object<detail::deleteShader>;
using ProgramObject = Object<detail::deleteProgram>;

/// Makes a buffer on the device with `size` bytes of `data`; null leaves the contents undefined. Shaders may write to
/// it. With GL_DYNAMIC_STORAGE_BIT in `flags` the program may, too.
/// \throw DeviceError out of memory
[[nodiscard]] Buffer makeBuffer(const Api& api, std::size_t size, const void* data, GLbitfield flags = 0);

template <typename Value>
[[nodiscard]] Buffer makeBuffer(const Api& api, const std::vector<Value>& values)
{
    return makeBuffer(api, values.size() * sizeof(Value), values.data());
}

[[nodiscard]] VertexArray makeVertexArray(const Api& api);

/// Makes a texture of `width` x `height` pixels with `samples` samples a pixel; 1 makes an ordinary texture.
/// \throw DeviceError too large, or out of memory
[[nodiscard]] Texture makeTexture2D(const Api& api, GLenum format, int width, int height, int samples = 1);

/// Makes a texture of one row from the values of `format` in `buffer`, which must outlive it.
/// \throw DeviceError
[[nodiscard]] Texture makeBufferTexture(const Api& api, GLenum format, const Buffer& buffer);

/// Makes a framebuffer that draws into `colour` and `depthStencil`, one of which may be empty. Both must outlive it.
/// \throw DeviceError
[[nodiscard]] Framebuffer makeFramebuffer(const Api& api, const Texture& colour, const Texture& depthStencil);

/// Makes a framebuffer of `width` x `height` pixels without attachments, for fragment shaders that write elsewhere.
/// \throw DeviceError
[[nodiscard]] Framebuffer makeEmptyFramebuffer(const Api& api, int width, int height);

} // namespace vdbcage::gl
