#pragma once

#include <memory>
#include <string>

#include <vdbcage/gl/api.h>

namespace vdbcage::gl {

/// An OpenGL 4.5 core context that needs no display. It has no usable default framebuffer: draw into framebuffers of
/// your own. Any number may exist; one may be used from any thread, by one thread at a time.
class OffscreenContext {
public:
    enum class Debug { off, on };

    /// With `Debug::on` errors carry the driver's own words (see `throwIfFailed`). Takes some 10 ms.
    /// \throw DeviceError if no such context can be had here
    explicit OffscreenContext(Debug debug = Debug::off);
    ~OffscreenContext();
    OffscreenContext(const OffscreenContext&) = delete;
    OffscreenContext& operator=(const OffscreenContext&) = delete;

    /// Keeps the context current on the calling thread, until it is destroyed by that same thread.
    class Current {
    public:
        ~Current();
        Current(const Current&) = delete;
        Current& operator=(const Current&) = delete;

    private:
        friend class OffscreenContext;
        explicit Current(const OffscreenContext& context);
        const OffscreenContext& context_;
    };

    /// `const auto current = context.makeCurrent();` before any call through `api()`, also before GL objects of this
    /// context are destroyed. \throw DeviceError if a context is current on this thread already, or this one elsewhere
    [[nodiscard]] Current makeCurrent() const { return Current(*this); }

    /// The entry points; valid as long as this object is.
    const Api& api() const;

    /// The driver's name and version, for reports.
    const std::string& description() const;

private:
    struct Platform;
    std::unique_ptr<Platform> platform_;
};

} // namespace vdbcage::gl
