#include <vdbcage/gl/program.h>

#include <string>
#include <vector>

#include <vdbcage/core/error.h>

namespace vdbcage::gl {

namespace {

/// Returns the driver's log of a failure, on one line. Debug messages repeat it and are dropped.
template <typename GetValue, typename GetLog>
std::string readLog(const Api& api, GLuint name, GetValue getValue, GetLog getLog)
{
    takeFailures(api);
    GLint size = 0;
    getValue(name, GL_INFO_LOG_LENGTH, &size);
    std::vector<char> log(static_cast<std::size_t>(size) + 1, '\0');
    getLog(name, size, nullptr, log.data());
    std::string line = log.data();
    while (!line.empty() && line.back() == '\n') line.pop_back();
    for (std::size_t at = line.find('\n'); at != std::string::npos; at = line.find('\n', at)) line.replace(at, 1, "; ");
    return line;
}

ShaderObject compile(const Api& api, const ShaderSource& source)
{
    ShaderObject shader(api, api.CreateShader(source.stage));
    throwIfFailed(api, "creating a shader");
    api.ShaderSource(shader.name(), 1, &source.text, nullptr);
    api.CompileShader(shader.name());
    GLint done = GL_FALSE;
    api.GetShaderiv(shader.name(), GL_COMPILE_STATUS, &done);
    if (done == GL_FALSE) {
        throw DeviceError(std::string(source.name) +
                          ": does not compile: " + readLog(api, shader.name(), api.GetShaderiv, api.GetShaderInfoLog));
    }
    return shader;
}

} // namespace

ProgramObject makeProgram(const Api& api, std::initializer_list<ShaderSource> stages)
{
    ProgramObject program(api, api.CreateProgram());
    std::vector<ShaderObject> shaders;
    std::string names;
    for (const ShaderSource& stage : stages) {
        shaders.push_back(compile(api, stage));
        api.AttachShader(program.name(), shaders.back().name());
        names += (names.empty() ? "" : " + ") + std::string(stage.name);
    }
    api.LinkProgram(program.name());
    GLint done = GL_FALSE;
    api.GetProgramiv(program.name(), GL_LINK_STATUS, &done);
    if (done == GL_FALSE) {
        throw DeviceError(names +
                          ": does not link: " + readLog(api, program.name(), api.GetProgramiv, api.GetProgramInfoLog));
    }
    throwIfFailed(api, "making a program");
    return program;
}

GLint uniformLocation(const Api& api, const ProgramObject& program, const char* name)
{
    const GLint location = api.GetUniformLocation(program.name(), name);
    if (location < 0) throw DeviceError(std::string("OpenGL: the program has no uniform ") + name);
    return location;
}

} // namespace vdbcage::gl
