#include <vdbcage/gl/detail/platform.h>

#include <array>
#include <type_traits>

#include <GL/osmesa.h>
#include <vdbcage/core/error.h>

namespace vdbcage::gl::detail {

namespace {

struct Library {
    Library() : file("libOSMesa.so.8")
    {
        file.find("OSMesaCreateContextAttribs", create);
        file.find("OSMesaDestroyContext", destroy);
        file.find("OSMesaMakeCurrent", makeCurrent);
        file.find("OSMesaGetCurrentContext", current);
        file.find("OSMesaGetProcAddress", getProc);
    }
    SharedLibrary file;
    decltype(&OSMesaCreateContextAttribs) create = nullptr;
    decltype(&OSMesaDestroyContext) destroy = nullptr;
    decltype(&OSMesaMakeCurrent) makeCurrent = nullptr;
    decltype(&OSMesaGetCurrentContext) current = nullptr;
    GetProc getProc = nullptr;
};

class OsmesaPlatform : public Platform {
public:
    OsmesaPlatform()
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
        context_ = library_.create(attributes.data(), nullptr);
        if (!context_) throw DeviceError("OpenGL: OSMesa cannot make a 4.5 core context");
    }
    OsmesaPlatform(const OsmesaPlatform&) = delete;
    OsmesaPlatform& operator=(const OsmesaPlatform&) = delete;
    ~OsmesaPlatform() override { library_.destroy(context_); }

    const char* name() const override { return "OSMesa"; }
    GetProc getProc() const override { return library_.getProc; }
    void makeCurrent() override
    {
        if (library_.current()) throw DeviceError("OpenGL: an OSMesa context is already current on this thread");
        if (!library_.makeCurrent(context_, pixel_.data(), GL_UNSIGNED_BYTE, 1, 1)) {
            throw DeviceError("OpenGL: OSMesa cannot make its context current");
        }
    }
    void release() noexcept override { library_.makeCurrent(nullptr, nullptr, GL_UNSIGNED_BYTE, 0, 0); }

private:
    const Library library_;
    std::array<GLubyte, 4> pixel_{}; // OSMesa insists on a default framebuffer
    OSMesaContext context_ = nullptr;
};

} // namespace

std::unique_ptr<Platform> makeOsmesa(bool /*debug*/)
{
    return std::make_unique<OsmesaPlatform>();
}

} // namespace vdbcage::gl::detail
