#pragma once

#include <initializer_list>

#include <vdbcage/gl/api.h>
#include <vdbcage/gl/objects.h>

namespace vdbcage::gl {

/// One stage of a program. cmake/EmbedShaders.cmake generates these from the files in shaders/.
struct ShaderSource {
    GLenum stage;     ///< GL_VERTEX_SHADER, ...
    const char* name; ///< for messages: the file's name
    const char* text; ///< GLSL, null-terminated
};

/// Compiles and links the stages.
/// \throw DeviceError with the name of the stage and the driver's log
[[nodiscard]] ProgramObject makeProgram(const Api& api, std::initializer_list<ShaderSource> stages);

/// Returns the location of a uniform that the program uses.
/// \throw DeviceError there is none of this name
GLint uniformLocation(const Api& api, const ProgramObject& program, const char* name);

} // namespace vdbcage::gl
