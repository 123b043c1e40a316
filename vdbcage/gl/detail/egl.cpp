#include <vdbcage/gl/detail/platform.h>

#include <string>

#include <EGL/egl.h>
#include <EGL/eglext.h>
#include <vdbcage/core/error.h>

namespace vdbcage::gl::detail {

namespace {

struct Library {
    Library() : file("libEGL.so.1")
    {
        file.find("eglGetProcAddress", getProc);
        file.find("eglQueryString", queryString);
        file.find("eglGetError", error);
        file.find("eglInitialize", initialize);
        file.find("eglBindAPI", bindApi);
        file.find("eglQueryAPI", queryApi);
        file.find("eglCreateContext", createContext);
        file.find("eglDestroyContext", destroyContext);
        file.find("eglGetCurrentContext", currentContext);
        file.find("eglMakeCurrent", makeCurrent);
        file.find("eglReleaseThread", releaseThread);
    }
    SharedLibrary file;
    GetProc getProc = nullptr;
    decltype(&eglQueryString) queryString = nullptr;
    decltype(&eglGetError) error = nullptr;
    decltype(&eglInitialize) initialize = nullptr;
    decltype(&eglBindAPI) bindApi = nullptr;
    decltype(&eglQueryAPI) queryApi = nullptr;
    decltype(&eglCreateContext) createContext = nullptr;
    decltype(&eglDestroyContext) destroyContext = nullptr;
    decltype(&eglGetCurrentContext) currentContext = nullptr;
    decltype(&eglMakeCurrent) makeCurrent = nullptr;
    decltype(&eglReleaseThread) releaseThread = nullptr;
};

/// A visit of this thread to EGL, with OpenGL as the API of its calls. It leaves the thread as it was: if no context is
/// current afterwards, even without the data that EGL keeps for each thread. At the end of the process libEGL frees
/// this data of all threads, and then once more for each thread that ends later, such as TBB's workers.
class Visit {
public:
    explicit Visit(const Library& egl) : egl_(egl), before_(egl.queryApi())
    {
        // Not checked: the next call that needs it fails with an error of its own.
        egl_.bindApi(EGL_OPENGL_API);
    }
    ~Visit()
    {
        if (!hasContext(EGL_OPENGL_API) && !hasContext(EGL_OPENGL_ES_API)) egl_.releaseThread();
        if (egl_.queryApi() != before_) egl_.bindApi(before_);
    }
    Visit(const Visit&) = delete;
    Visit& operator=(const Visit&) = delete;

private:
    bool hasContext(EGLenum api) const { return egl_.bindApi(api) && egl_.currentContext() != EGL_NO_CONTEXT; }

    const Library& egl_;
    EGLenum before_;
};

/// Returns whether a list of names separated by blanks, which may be null, has this one.
bool hasName(const char* list, const std::string& name)
{
    return list && (" " + std::string(list) + " ").find(" " + name + " ") != std::string::npos;
}

[[noreturn]] void fail(const Library& egl, const std::string& what)
{
    char code[16];
    std::snprintf(code, sizeof code, "0x%x", static_cast<unsigned>(egl.error()));
    throw DeviceError("OpenGL: EGL " + what + " (" + code + ")");
}

class EglPlatform : public Platform {
public:
    EglPlatform(const Library& egl, EGLDisplay display, bool debug) : egl_(egl), display_(display)
    {
        const Visit visit(egl_);
        // The display belongs to the process and is shared by all who ask for it, so it is never terminated here.
        EGLint major = 0, minor = 0;
        if (!egl_.initialize(display_, &major, &minor)) fail(egl_, "cannot initialize the device");
        const char* extensions = egl_.queryString(display_, EGL_EXTENSIONS);
        for (const char* needed :
             {"EGL_KHR_surfaceless_context", "EGL_KHR_no_config_context", "EGL_KHR_create_context"}) {
            if (!hasName(extensions, needed)) throw DeviceError("OpenGL: EGL: the device lacks " + std::string(needed));
        }
        const EGLint attributes[] = {EGL_CONTEXT_MAJOR_VERSION_KHR,
                                     4,
                                     EGL_CONTEXT_MINOR_VERSION_KHR,
                                     5,
                                     EGL_CONTEXT_OPENGL_PROFILE_MASK_KHR,
                                     EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT_KHR,
                                     EGL_CONTEXT_FLAGS_KHR,
                                     debug ? EGL_CONTEXT_OPENGL_DEBUG_BIT_KHR : 0,
                                     EGL_NONE};
        context_ = egl_.createContext(display_, EGL_NO_CONFIG_KHR, EGL_NO_CONTEXT, attributes);
        if (context_ == EGL_NO_CONTEXT) fail(egl_, "cannot make a 4.5 core context");
    }
    EglPlatform(const EglPlatform&) = delete;
    EglPlatform& operator=(const EglPlatform&) = delete;
    ~EglPlatform() override
    {
        const Visit visit(egl_);
        egl_.destroyContext(display_, context_);
    }

    const char* name() const override { return "EGL"; }
    GetProc getProc() const override { return egl_.getProc; }
    void makeCurrent() override
    {
        const Visit visit(egl_);
        if (egl_.currentContext() != EGL_NO_CONTEXT) {
            throw DeviceError("OpenGL: an EGL context is already current on this thread");
        }
        if (!egl_.makeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, context_)) {
            fail(egl_, "cannot make its context current");
        }
    }
    void release() noexcept override
    {
        const Visit visit(egl_);
        egl_.makeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
    }

private:
    const Library egl_;
    EGLDisplay display_;
    EGLContext context_ = EGL_NO_CONTEXT;
};

template <typename Function>
Function extension(const Library& egl, const char* name)
{
    return reinterpret_cast<Function>(egl.getProc(name));
}

/// Returns the devices that are not software.
std::vector<EGLDeviceEXT> hardware(const Library& egl, const char* extensions)
{
    if (!hasName(extensions, "EGL_EXT_platform_device") || !hasName(extensions, "EGL_EXT_device_enumeration") ||
        !hasName(extensions, "EGL_EXT_device_query")) {
        return {};
    }
    const auto queryDevices = extension<PFNEGLQUERYDEVICESEXTPROC>(egl, "eglQueryDevicesEXT");
    const auto queryString = extension<PFNEGLQUERYDEVICESTRINGEXTPROC>(egl, "eglQueryDeviceStringEXT");
    EGLint count = 0;
    if (!queryDevices || !queryString || !queryDevices(0, nullptr, &count)) return {};
    std::vector<EGLDeviceEXT> all(static_cast<std::size_t>(count)), found;
    if (!queryDevices(count, all.data(), &count)) return {};
    all.resize(static_cast<std::size_t>(count));
    for (EGLDeviceEXT device : all) {
        if (!hasName(queryString(device, EGL_EXTENSIONS), "EGL_MESA_device_software")) found.push_back(device);
    }
    return found;
}

} // namespace

std::vector<MakePlatform> eglPlatforms(bool hardwareOnly)
{
    const Library egl;
    const Visit visit(egl);
    const char* extensions = egl.queryString(EGL_NO_DISPLAY, EGL_EXTENSIONS);
    const auto getDisplay = extension<PFNEGLGETPLATFORMDISPLAYEXTPROC>(egl, "eglGetPlatformDisplayEXT");
    std::vector<MakePlatform> platforms;
    const auto add = [&](EGLenum platform, void* native) {
        const EGLDisplay display = getDisplay(platform, native, nullptr);
        if (display == EGL_NO_DISPLAY) return;
        platforms.emplace_back([=](bool debug) { return std::make_unique<EglPlatform>(egl, display, debug); });
    };
    if (getDisplay && hasName(extensions, "EGL_EXT_platform_base")) {
        for (EGLDeviceEXT device : hardware(egl, extensions)) add(EGL_PLATFORM_DEVICE_EXT, device);
        if (!hardwareOnly && hasName(extensions, "EGL_MESA_platform_surfaceless")) {
            add(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY);
        }
    }
    if (platforms.empty()) {
        throw DeviceError(hardwareOnly ? "OpenGL: EGL has no hardware device"
                                       : "OpenGL: EGL has neither a hardware device nor displays without a surface");
    }
    return platforms;
}

} // namespace vdbcage::gl::detail
