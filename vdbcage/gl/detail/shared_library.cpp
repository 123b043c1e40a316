#include <vdbcage/gl/detail/platform.h>

#include <dlfcn.h>

#include <vdbcage/core/error.h>

namespace vdbcage::gl::detail {

namespace {

std::string lastProblem()
{
    const char* text = ::dlerror();
    return text ? text : "unknown error";
}

} // namespace

SharedLibrary::SharedLibrary(const char* name) : handle_(::dlopen(name, RTLD_NOW | RTLD_LOCAL | RTLD_NODELETE))
{
    if (!handle_) throw DeviceError("OpenGL: " + lastProblem());
}

void* SharedLibrary::address(const char* symbol) const
{
    void* address = ::dlsym(handle_, symbol);
    if (!address) throw DeviceError("OpenGL: " + lastProblem());
    return address;
}

} // namespace vdbcage::gl::detail
