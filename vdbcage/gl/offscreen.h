#pragma once

#include <memory>
#include <string>

#include <vdbcage/gl/api.h>

namespace vdbcage::gl {

/// An OpenGL 4.5 core context that needs no display. It has no usable default framebuffer: draw into framebuffers of
/// your own. Any number may exist. One may be used from any thread, by one thread at a time.
class OffscreenContext {
    struct State;

public:
    enum class Debug { off, on };
    enum class Source {
        any,      ///< hardware by EGL if there is any, else software by EGL, else OSMesa
        hardware, ///< hardware by EGL only; where there is none, that takes a few ms
        egl,      ///< EGL only: hardware if there is any, else software
        osmesa    ///< OSMesa only: Mesa's rasterizer in software, which needs nothing but its library
    };

    /// With `Debug::on` errors carry the driver's own words (see `throwIfFailed`).
    /// \throw DeviceError no such context can be had here, and why not, for each way that was tried
    /// Cost: some 10 ms; the first of a process loads the driver too.
    explicit OffscreenContext(Debug debug = Debug::off, Source source = Source::any);
    ~OffscreenContext();
    OffscreenContext(const OffscreenContext&) = delete;
    OffscreenContext& operator=(const OffscreenContext&) = delete;

    /// Keeps the context current on the calling thread until it is destroyed by that same thread.
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

    /// Makes the context current: `const auto current = context.makeCurrent();`. Needed before any call through
    /// `api()`, and before GL objects of this context are destroyed.
    /// \throw DeviceError a context is current on this thread already, or this one elsewhere
    [[nodiscard]] Current makeCurrent() const;

    /// The entry points. Valid as long as this object is.
    const Api& api() const;

    /// Where it comes from and the driver's name and version, for reports.
    const std::string& description() const;

    /// Whether a program on the CPU draws, rather than a device.
    bool isSoftware() const;

private:
    std::unique_ptr<State> state_;
};

} // namespace vdbcage::gl
