#include <vdbcage/gl/api.h>

#include <array>
#include <string>

#include <vdbcage/core/error.h>

namespace vdbcage::gl {

namespace {

template <typename Function>
void load(GetProc getProc, const char* name, Function& function)
{
    function = reinterpret_cast<Function>(getProc(name));
    if (!function) throw DeviceError(std::string("OpenGL: this context has no ") + name);
}

std::string errorName(GLenum error)
{
    switch (error) {
    case GL_INVALID_ENUM:
        return "GL_INVALID_ENUM";
    case GL_INVALID_VALUE:
        return "GL_INVALID_VALUE";
    case GL_INVALID_OPERATION:
        return "GL_INVALID_OPERATION";
    case GL_INVALID_FRAMEBUFFER_OPERATION:
        return "GL_INVALID_FRAMEBUFFER_OPERATION";
    case GL_OUT_OF_MEMORY:
        return "GL_OUT_OF_MEMORY";
    case GL_CONTEXT_LOST:
        return "GL_CONTEXT_LOST";
    default:
        return "error " + std::to_string(error);
    }
}

} // namespace

Api::Api(GetProc getProc)
{
#define VDBCAGE_GL_LOAD(Type, name) load(getProc, "gl" #name, this->name);
    VDBCAGE_GL_ENTRY_POINTS(VDBCAGE_GL_LOAD)
#undef VDBCAGE_GL_LOAD

    // Drivers return entry points of versions that they do not have.
    GLint major = 0;
    GLint minor = 0;
    GetIntegerv(GL_MAJOR_VERSION, &major);
    GetIntegerv(GL_MINOR_VERSION, &minor);
    if (major < 4 || (major == 4 && minor < 5)) {
        throw DeviceError("OpenGL: this context has version " + std::to_string(major) + "." + std::to_string(minor) +
                          "; 4.5 is needed");
    }
}

Driver driverOf(const Api& api)
{
    const auto text = [&](GLenum name) {
        const GLubyte* const string = api.GetString(name);
        return std::string(string ? reinterpret_cast<const char*>(string) : "?");
    };
    const std::string renderer = text(GL_RENDERER);
    Driver driver{renderer + ", OpenGL " + text(GL_VERSION)};
    for (const char* name : {"llvmpipe", "softpipe", "swrast", "Software Rasterizer"}) {
        driver.isSoftware = driver.isSoftware || renderer.find(name) != std::string::npos;
    }
    return driver;
}

void enableDebugMessages(const Api& api)
{
    api.Enable(GL_DEBUG_OUTPUT);
    api.Enable(GL_DEBUG_OUTPUT_SYNCHRONOUS);
    // The log is short (ten entries in Mesa), so advice about speed must not fill it.
    api.DebugMessageControl(GL_DONT_CARE, GL_DONT_CARE, GL_DONT_CARE, 0, nullptr, GL_FALSE);
    for (const GLenum type : std::array<GLenum, 2>{GL_DEBUG_TYPE_ERROR, GL_DEBUG_TYPE_UNDEFINED_BEHAVIOR}) {
        api.DebugMessageControl(GL_DONT_CARE, type, GL_DONT_CARE, 0, nullptr, GL_TRUE);
    }
}

std::string takeFailures(const Api& api)
{
    std::string problems;
    const auto add = [&](const std::string& problem) { problems += (problems.empty() ? "" : "; ") + problem; };
    // A lost context may report errors for ever.
    for (int i = 0; i < 16; ++i) {
        const GLenum error = api.GetError();
        if (error == GL_NO_ERROR) break;
        add(errorName(error));
    }
    std::array<char, 4096> text{};
    GLsizei length = 0;
    while (api.GetDebugMessageLog(1, static_cast<GLsizei>(text.size()), nullptr, nullptr, nullptr, nullptr, &length,
                                  text.data()) == 1) {
        add(text.data());
    }
    return problems;
}

void throwIfFailed(const Api& api, const char* what)
{
    const std::string problems = takeFailures(api);
    if (!problems.empty()) throw DeviceError("OpenGL failed while " + std::string(what) + ": " + problems);
}

} // namespace vdbcage::gl
