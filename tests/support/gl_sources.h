#pragma once

#include <vector>

#include <vdbcage/core/error.h>
#include <vdbcage/gl/detail/platform.h>
#include <vdbcage/gl/offscreen.h>

namespace vdbcage::test {

/// Returns whether this system has OSMesa, which Mesa gave up in 2025.
inline bool hasOsmesa()
{
    try {
        const gl::detail::SharedLibrary library("libOSMesa.so.8");
        return true;
    } catch (const DeviceError&) {
        return false;
    }
}

/// Returns the sources that must work on this machine, without a display.
inline std::vector<gl::OffscreenContext::Source> everySource()
{
    using Source = gl::OffscreenContext::Source;
    return hasOsmesa() ? std::vector{Source::egl, Source::osmesa} : std::vector{Source::egl};
}

/// Returns the source that draws by software even if there are devices; without OSMesa that is EGL, on machines without
/// devices.
inline gl::OffscreenContext::Source softwareSource()
{
    return everySource().back();
}

} // namespace vdbcage::test
