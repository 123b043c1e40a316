#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include <vdbcage/gl/api.h>

namespace vdbcage::gl::detail {

/// The source of a context: one driver with one context. Libraries of drivers are loaded when the first context is
/// made, never linked. A program that makes no context needs none of them, and their symbols do not mix with its own.
class Platform {
public:
    virtual ~Platform() = default;
    /// Returns the name of the source for messages: "EGL", "OSMesa".
    virtual const char* name() const = 0;
    virtual GetProc getProc() const = 0;
    /// Makes the context current on the calling thread.
    /// \throw DeviceError the thread has a context of another owner, or the driver refuses
    virtual void makeCurrent() = 0;
    /// Releases the context. \pre the calling thread is that of makeCurrent()
    virtual void release() noexcept = 0;
};

/// A function that makes a context.
/// \throw DeviceError
using MakePlatform = std::function<std::unique_ptr<Platform>(bool debug)>;

/// Returns the ways to a context by EGL: first the hardware devices, then, unless `hardwareOnly`, Mesa without a
/// surface.
/// \throw DeviceError EGL cannot be loaded or has none of them
std::vector<MakePlatform> eglPlatforms(bool hardwareOnly);

/// Makes a context of Mesa's software rasterizer.
/// \throw DeviceError
std::unique_ptr<Platform> makeOsmesa(bool debug);

/// A shared library, kept loaded until the process ends: drivers leave threads and thread-local data behind.
class SharedLibrary {
public:
    /// Loads the library.
    /// \throw DeviceError with the reason why it cannot be loaded
    explicit SharedLibrary(const char* name);

    /// Sets `function` to the library's function of this name.
    /// \throw DeviceError the library has none
    template <typename Function>
    void find(const char* symbol, Function& function) const
    {
        function = reinterpret_cast<Function>(address(symbol));
    }

private:
    void* address(const char* symbol) const;

    void* handle_;
};

} // namespace vdbcage::gl::detail
