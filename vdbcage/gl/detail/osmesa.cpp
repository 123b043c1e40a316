#include <vdbcage/gl/detail/platform.h>

#include <array>

#include <GL/glcorearb.h>
#include <vdbcage/core/error.h>

namespace vdbcage::gl::detail {

namespace {

// The types of OSMesa's binary interface. Mesa gave up OSMesa in 2025, and its header with it; where the library is
// installed, it still works.
using Context = struct OpaqueOsmesaContext*;
enum Attribute : int {
    format = 0x22,
    profile = 0x33,
    coreProfile = 0x34,
    contextMajorVersion = 0x36,
    contextMinorVersion = 0x37
};

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
    Context (*create)(const int* attributes, Context shared) = nullptr;
    void (*destroy)(Context) = nullptr;
    GLboolean (*makeCurrent)(Context, void* buffer, GLenum type, GLsizei width, GLsizei height) = nullptr;
    Context (*current)() = nullptr;
    GetProc getProc = nullptr;
};

class OsmesaPlatform : public Platform {
public:
    OsmesaPlatform()
    {
        constexpr std::array<int, 9> attributes{
            format, GL_RGBA, profile, coreProfile, contextMajorVersion, 4, contextMinorVersion, 5, 0,
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
    Context context_ = nullptr;
};

} // namespace

std::unique_ptr<Platform> makeOsmesa(bool /*debug*/)
{
    return std::make_unique<OsmesaPlatform>();
}

} // namespace vdbcage::gl::detail
