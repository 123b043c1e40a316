#include <vdbcage/gl/offscreen.h>

#include <array>
#include <atomic>
#include <optional>
#include <type_traits>

#include <GL/osmesa.h>
#include <vdbcage/core/error.h>

namespace vdbcage::gl {

namespace {

struct Destroy {
    void operator()(OSMesaContext context) const { OSMesaDestroyContext(context); }
};
using ContextHandle = std::unique_ptr<std::remove_pointer_t<OSMesaContext>, Destroy>;

ContextHandle createContext()
{
    constexpr std::array<int, 9> attributes{
        OSMESA_FORMAT,
        OSMESA_RGBA,
        OSMESA_PROFILE,
        OSMESA_CORE_PROFILE,
        OSMESA_CONTEXT_MAJOR_VERSION,
        4,
        OSMESA_CONTEXT_MINOR_VERSION,
        5,
        0,
    };
    ContextHandle context(OSMesaCreateContextAttribs(attributes.data(), nullptr));
    if (!context) throw DeviceError("OpenGL: OSMesa cannot make a 4.5 core context");
    return context;
}

std::string text(const Api& api, GLenum name)
{
    const GLubyte* string = api.GetString(name);
    return string ? reinterpret_cast<const char*>(string) : "?";
}

} // namespace

/// What one kind of context needs. OSMesa, Mesa's rasterizer in software, works on every machine.
struct OffscreenContext::Platform {
    void makeCurrent()
    {
        if (OSMesaGetCurrentContext()) throw DeviceError("OpenGL: a context is already current on this thread");
        if (inUse.exchange(true)) throw DeviceError("OpenGL: the context is in use on another thread");
        if (!OSMesaMakeCurrent(context.get(), pixel.data(), GL_UNSIGNED_BYTE, 1, 1)) {
            inUse = false;
            throw DeviceError("OpenGL: OSMesa cannot make its context current");
        }
    }
    void release() noexcept
    {
        OSMesaMakeCurrent(nullptr, nullptr, GL_UNSIGNED_BYTE, 0, 0);
        inUse = false;
    }

    std::array<GLubyte, 4> pixel{}; // OSMesa insists on a default framebuffer
    ContextHandle context = createContext();
    std::atomic<bool> inUse{false};
    std::optional<Api> api;
    std::string description;
};

OffscreenContext::OffscreenContext(Debug debug) : platform_(std::make_unique<Platform>())
{
    const Current current = makeCurrent();
    const Api& table = platform_->api.emplace(&OSMesaGetProcAddress);
    if (debug == Debug::on) enableDebugMessages(table);
    platform_->description = "OSMesa: " + text(table, GL_RENDERER) + ", OpenGL " + text(table, GL_VERSION);
    throwIfFailed(table, "making a context");
}

OffscreenContext::~OffscreenContext() = default;

OffscreenContext::Current::Current(const OffscreenContext& context) : context_(context)
{
    context_.platform_->makeCurrent();
}

OffscreenContext::Current::~Current()
{
    context_.platform_->release();
}

const Api& OffscreenContext::api() const
{
    return *platform_->api;
}

const std::string& OffscreenContext::description() const
{
    return platform_->description;
}

} // namespace vdbcage::gl
