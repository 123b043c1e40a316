#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include <vdbcage/gl/api.h>

namespace vdbcage::gl::detail {

/// Where a context comes from: one driver, one context of its own. Libraries of drivers are loaded when the first
/// context is made, never linked. So a program that makes none needs none, and their symbols stay out of its own.
class Platform {
public:
    virtual ~Platform() = default;
    /// Names the maker of the context, for messages: "EGL", "OSMesa".
    virtual const char* name() const = 0;
    /// Looks entry points up.
    virtual GetProc getProc() const = 0;
    /// Makes the context current on the calling thread.
    /// \throw DeviceError the thread has a context of somebody else's, or the driver refuses
    virtual void makeCurrent() = 0;
    /// To be called on the thread that called makeCurrent.
    virtual void release() noexcept = 0;
};

/// Makes a context when called.
/// \throw DeviceError
using MakePlatform = std::function<std::unique_ptr<Platform>(bool debug)>;

/// The ways to a context by EGL. First come the devices that are hardware, then, unless only those are wanted, Mesa
/// without a surface.
/// \throw DeviceError EGL cannot be loaded or has none of them
std::vector<MakePlatform> eglPlatforms(bool hardwareOnly);

/// Mesa's rasterizer in software.
/// \throw DeviceError
std::unique_ptr<Platform> makeOsmesa(bool debug);

/// A shared library, loaded and kept until the process ends: drivers leave threads and thread-local data behind.
class SharedLibrary {
public:
    /// Loads the library.
    /// \throw DeviceError saying why it cannot be loaded
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
