#pragma once

#include <memory>
#include <string>

#include <vdbcage/gl/api.h>

namespace vdbcage::gl {

/// An OpenGL 4.5 core context that needs no display. It has no usable default framebuffer: the caller draws into its
/// own. Any number may exist. Any thread may use one, but only one thread at a time.
class OffscreenContext {
    struct State;

public:
    enum class Debug { off, on };
    enum class Source {
        any,      ///< hardware by EGL if there is any, else software by EGL, else OSMesa
        hardware, ///< hardware by EGL only; if there is none, it takes a few ms to find out
        egl,      ///< EGL only: hardware if there is any, else software
        osmesa    ///< OSMesa only: Mesa's software rasterizer, which needs only its library
    };

    /// With `Debug::on` errors have the driver's messages (see throwIfFailed()).
    /// \throw DeviceError there is no such context here, with the reason for each way that was tried
    /// Cost: about 10 ms; the first of a process loads the driver too.
    explicit OffscreenContext(Debug debug = Debug::off, Source source = Source::any);
    ~OffscreenContext();
    OffscreenContext(const OffscreenContext&) = delete;
    OffscreenContext& operator=(const OffscreenContext&) = delete;

    /// A scope in which the context is current on a thread; that thread must destroy it.
    class Current {
    public:
        ~Current();
        Current(const Current&) = delete;
        Current& operator=(const Current&) = delete;

    private:
        friend class OffscreenContext;
        explicit Current(State& state);
        State& state_;
    };

    /// Makes the context current: `const auto current = context.makeCurrent();`. This is needed before any call through
    /// api(), and before GL objects of this context are destroyed.
    /// \throw DeviceError a context is current on this thread already, or this one elsewhere
    [[nodiscard]] Current makeCurrent() const;

    /// Returns the entry points, valid as long as this object.
    const Api& api() const;

    /// Returns the context's source and the driver's name and version, for reports.
    const std::string& description() const;

    /// Returns whether a program on the CPU draws, rather than a device.
    bool isSoftware() const;

private:
    std::unique_ptr<State> state_;
};

} // namespace vdbcage::gl
