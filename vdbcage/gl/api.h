#pragma once

#include <string>

#include <GL/glcorearb.h>

/// Every OpenGL entry point that the project calls: its type in GL/glcorearb.h and its name without "gl".
#define VDBCAGE_GL_ENTRY_POINTS(X)                                                                                     \
    X(PFNGLATTACHSHADERPROC, AttachShader)                                                                             \
    X(PFNGLBINDBUFFERBASEPROC, BindBufferBase)                                                                         \
    X(PFNGLBINDFRAMEBUFFERPROC, BindFramebuffer)                                                                       \
    X(PFNGLBINDIMAGETEXTUREPROC, BindImageTexture)                                                                     \
    X(PFNGLBINDTEXTUREUNITPROC, BindTextureUnit)                                                                       \
    X(PFNGLBINDVERTEXARRAYPROC, BindVertexArray)                                                                       \
    X(PFNGLBLENDFUNCSEPARATEPROC, BlendFuncSeparate)                                                                   \
    X(PFNGLBLITNAMEDFRAMEBUFFERPROC, BlitNamedFramebuffer)                                                             \
    X(PFNGLCHECKNAMEDFRAMEBUFFERSTATUSPROC, CheckNamedFramebufferStatus)                                               \
    X(PFNGLCLEARNAMEDBUFFERDATAPROC, ClearNamedBufferData)                                                             \
    X(PFNGLCLEARNAMEDFRAMEBUFFERFIPROC, ClearNamedFramebufferfi)                                                       \
    X(PFNGLCLEARNAMEDFRAMEBUFFERFVPROC, ClearNamedFramebufferfv)                                                       \
    X(PFNGLCLEARNAMEDFRAMEBUFFERIVPROC, ClearNamedFramebufferiv)                                                       \
    X(PFNGLCOLORMASKPROC, ColorMask)                                                                                   \
    X(PFNGLCOMPILESHADERPROC, CompileShader)                                                                           \
    X(PFNGLCREATEBUFFERSPROC, CreateBuffers)                                                                           \
    X(PFNGLCREATEFRAMEBUFFERSPROC, CreateFramebuffers)                                                                 \
    X(PFNGLCREATEPROGRAMPROC, CreateProgram)                                                                           \
    X(PFNGLCREATESHADERPROC, CreateShader)                                                                             \
    X(PFNGLCREATETEXTURESPROC, CreateTextures)                                                                         \
    X(PFNGLCREATEVERTEXARRAYSPROC, CreateVertexArrays)                                                                 \
    X(PFNGLDEBUGMESSAGECONTROLPROC, DebugMessageControl)                                                               \
    X(PFNGLDELETEBUFFERSPROC, DeleteBuffers)                                                                           \
    X(PFNGLDELETEFRAMEBUFFERSPROC, DeleteFramebuffers)                                                                 \
    X(PFNGLDELETEPROGRAMPROC, DeleteProgram)                                                                           \
    X(PFNGLDELETESHADERPROC, DeleteShader)                                                                             \
    X(PFNGLDELETETEXTURESPROC, DeleteTextures)                                                                         \
    X(PFNGLDELETEVERTEXARRAYSPROC, DeleteVertexArrays)                                                                 \
    X(PFNGLDEPTHFUNCPROC, DepthFunc)                                                                                   \
    X(PFNGLDEPTHMASKPROC, DepthMask)                                                                                   \
    X(PFNGLDISABLEPROC, Disable)                                                                                       \
    X(PFNGLDISPATCHCOMPUTEPROC, DispatchCompute)                                                                       \
    X(PFNGLDRAWARRAYSPROC, DrawArrays)                                                                                 \
    X(PFNGLDRAWARRAYSINSTANCEDPROC, DrawArraysInstanced)                                                               \
    X(PFNGLDRAWELEMENTSPROC, DrawElements)                                                                             \
    X(PFNGLENABLEPROC, Enable)                                                                                         \
    X(PFNGLENABLEVERTEXARRAYATTRIBPROC, EnableVertexArrayAttrib)                                                       \
    X(PFNGLFINISHPROC, Finish)                                                                                         \
    X(PFNGLGETDEBUGMESSAGELOGPROC, GetDebugMessageLog)                                                                 \
    X(PFNGLGETERRORPROC, GetError)                                                                                     \
    X(PFNGLGETINTEGER64VPROC, GetInteger64v)                                                                           \
    X(PFNGLGETINTEGERVPROC, GetIntegerv)                                                                               \
    X(PFNGLGETNAMEDBUFFERSUBDATAPROC, GetNamedBufferSubData)                                                           \
    X(PFNGLGETPROGRAMINFOLOGPROC, GetProgramInfoLog)                                                                   \
    X(PFNGLGETPROGRAMIVPROC, GetProgramiv)                                                                             \
    X(PFNGLGETSHADERINFOLOGPROC, GetShaderInfoLog)                                                                     \
    X(PFNGLGETSHADERIVPROC, GetShaderiv)                                                                               \
    X(PFNGLGETSTRINGPROC, GetString)                                                                                   \
    X(PFNGLGETUNIFORMLOCATIONPROC, GetUniformLocation)                                                                 \
    X(PFNGLLINKPROGRAMPROC, LinkProgram)                                                                               \
    X(PFNGLMEMORYBARRIERPROC, MemoryBarrier)                                                                           \
    X(PFNGLNAMEDBUFFERSTORAGEPROC, NamedBufferStorage)                                                                 \
    X(PFNGLNAMEDBUFFERSUBDATAPROC, NamedBufferSubData)                                                                 \
    X(PFNGLNAMEDFRAMEBUFFERPARAMETERIPROC, NamedFramebufferParameteri)                                                 \
    X(PFNGLNAMEDFRAMEBUFFERTEXTUREPROC, NamedFramebufferTexture)                                                       \
    X(PFNGLPIXELSTOREIPROC, PixelStorei)                                                                               \
    X(PFNGLPOLYGONOFFSETPROC, PolygonOffset)                                                                           \
    X(PFNGLPROGRAMUNIFORM1FPROC, ProgramUniform1f)                                                                     \
    X(PFNGLPROGRAMUNIFORM1IPROC, ProgramUniform1i)                                                                     \
    X(PFNGLPROGRAMUNIFORM2FPROC, ProgramUniform2f)                                                                     \
    X(PFNGLPROGRAMUNIFORM4FPROC, ProgramUniform4f)                                                                     \
    X(PFNGLPROGRAMUNIFORMMATRIX4FVPROC, ProgramUniformMatrix4fv)                                                       \
    X(PFNGLREADPIXELSPROC, ReadPixels)                                                                                 \
    X(PFNGLSCISSORPROC, Scissor)                                                                                       \
    X(PFNGLSHADERSOURCEPROC, ShaderSource)                                                                             \
    X(PFNGLSTENCILFUNCPROC, StencilFunc)                                                                               \
    X(PFNGLSTENCILOPPROC, StencilOp)                                                                                   \
    X(PFNGLTEXTUREBUFFERPROC, TextureBuffer)                                                                           \
    X(PFNGLTEXTUREPARAMETERIPROC, TextureParameteri)                                                                   \
    X(PFNGLTEXTURESTORAGE2DPROC, TextureStorage2D)                                                                     \
    X(PFNGLTEXTURESTORAGE2DMULTISAMPLEPROC, TextureStorage2DMultisample)                                               \
    X(PFNGLTEXTURESUBIMAGE2DPROC, TextureSubImage2D)                                                                   \
    X(PFNGLUSEPROGRAMPROC, UseProgram)                                                                                 \
    X(PFNGLVERTEXARRAYATTRIBBINDINGPROC, VertexArrayAttribBinding)                                                     \
    X(PFNGLVERTEXARRAYATTRIBFORMATPROC, VertexArrayAttribFormat)                                                       \
    X(PFNGLVERTEXARRAYBINDINGDIVISORPROC, VertexArrayBindingDivisor)                                                   \
    X(PFNGLVERTEXARRAYELEMENTBUFFERPROC, VertexArrayElementBuffer)                                                     \
    X(PFNGLVERTEXARRAYVERTEXBUFFERPROC, VertexArrayVertexBuffer)                                                       \
    X(PFNGLVIEWPORTPROC, Viewport)

namespace vdbcage::gl {

/// A function that returns the entry point of a full name, such as "glClear", or null.
using AnyFunction = void (*)();
using GetProc = AnyFunction (*)(const char* name);

/// The entry points of ONE context: two contexts may come from two drivers, so nothing here is global. The context of
/// an `Api` must be current on a thread that calls a function with it.
struct Api {
    /// Fills the table through the context's own `getProc`.
    /// \pre the context is current
    /// \throw DeviceError an entry point is missing, or the context is older than OpenGL 4.5
    explicit Api(GetProc getProc);

#define VDBCAGE_GL_DECLARE(Type, name) Type name = nullptr;
    VDBCAGE_GL_ENTRY_POINTS(VDBCAGE_GL_DECLARE)
#undef VDBCAGE_GL_DECLARE
};

/// The driver of a context.
struct Driver {
    std::string description; ///< its name and version
    bool isSoftware = false; ///< a program on the CPU, rather than a device
};
Driver driverOf(const Api& api);

/// Makes the context record errors and undefined behaviour in full, for throwIfFailed() to report.
void enableDebugMessages(const Api& api);

/// Returns the errors since the last call, in words; empty if there was none.
std::string takeFailures(const Api& api);

/// Throws if anything in the context failed since the last call. `what` names the work for the message, such as
/// "rendering".
/// \throw DeviceError with the error codes and, after enableDebugMessages(), the driver's messages
void throwIfFailed(const Api& api, const char* what);

} // namespace vdbcage::gl
