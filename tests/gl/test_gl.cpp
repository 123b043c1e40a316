#include <boost/test/data/monomorphic.hpp>
#include <boost/test/data/test_case.hpp>
#include <boost/test/unit_test.hpp>

#include <algorithm>
#include <array>
#include <atomic>
#include <cstdint>
#include <string>
#include <thread>
#include <vector>

#include <support/gl_sources.h>
#include <support/run_command.h>
#include <vdbcage/core/error.h>
#include <vdbcage/gl/detail/platform.h>
#include <vdbcage/gl/objects.h>
#include <vdbcage/gl/offscreen.h>
#include <vdbcage/gl/program.h>

using namespace vdbcage;
using namespace vdbcage::gl;

namespace vdbcage::gl {

std::ostream& operator<<(std::ostream& out, OffscreenContext::Source source)
{
    return out << (source == OffscreenContext::Source::egl ? "EGL" : "OSMesa");
}

} // namespace vdbcage::gl

namespace {

using Pixel = std::array<std::uint8_t, 4>;
using Debug = OffscreenContext::Debug;
using Source = OffscreenContext::Source;

const auto everySource = boost::unit_test::data::make(test::everySource());
boost::test_tools::assertion_result thereIsOsmesa(boost::unit_test::test_unit_id)
{
    return test::hasOsmesa();
}

constexpr ShaderSource cornerVert{GL_VERTEX_SHADER, "corner.vert", R"(#version 450 core
layout(location = 0) in vec2 position;
void main() { gl_Position = vec4(position, 0.0, 1.0); })"};
constexpr ShaderSource plainFrag{GL_FRAGMENT_SHADER, "plain.frag", R"(#version 450 core
uniform vec4 colour;
layout(location = 0) out vec4 result;
void main() { result = colour; })"};

auto says(std::vector<std::string> words)
{
    return [words](const DeviceError& error) {
        const std::string text = error.what();
        BOOST_TEST_MESSAGE(text);
        return std::all_of(words.begin(), words.end(),
                           [&](const std::string& word) { return text.find(word) != std::string::npos; });
    };
}

/// A picture of size x size pixels: white, with the lower left half in `colour`, as that context draws it.
std::vector<Pixel> drawHalf(const OffscreenContext& context, int size, const std::array<float, 4>& colour)
{
    const auto current = context.makeCurrent();
    const Api& api = context.api();
    const Texture texture = makeTexture2D(api, GL_RGBA8, size, size);
    const Framebuffer framebuffer = makeFramebuffer(api, texture, Texture());
    const Buffer corners = makeBuffer(api, std::vector<float>{-1, -1, 1, -1, -1, 1});
    const VertexArray layout = makeVertexArray(api);
    api.VertexArrayVertexBuffer(layout.name(), 0, corners.name(), 0, 2 * sizeof(float));
    api.VertexArrayAttribFormat(layout.name(), 0, 2, GL_FLOAT, GL_FALSE, 0);
    api.VertexArrayAttribBinding(layout.name(), 0, 0);
    api.EnableVertexArrayAttrib(layout.name(), 0);
    const ProgramObject program = makeProgram(api, {cornerVert, plainFrag});
    api.ProgramUniform4f(program.name(), uniformLocation(api, program, "colour"), colour[0], colour[1], colour[2],
                         colour[3]);

    const std::array<float, 4> white{1, 1, 1, 1};
    api.ClearNamedFramebufferfv(framebuffer.name(), GL_COLOR, 0, white.data());
    api.BindFramebuffer(GL_FRAMEBUFFER, framebuffer.name());
    api.Viewport(0, 0, size, size);
    api.UseProgram(program.name());
    api.BindVertexArray(layout.name());
    api.DrawArrays(GL_TRIANGLES, 0, 3);
    std::vector<Pixel> pixels(static_cast<std::size_t>(size) * static_cast<std::size_t>(size));
    api.ReadPixels(0, 0, size, size, GL_RGBA, GL_UNSIGNED_BYTE, pixels.data());
    throwIfFailed(api, "drawing");
    return pixels;
}

/// Whether the pixels are those that `drawHalf` should give; the diagonal itself is left open.
bool isHalf(const std::vector<Pixel>& pixels, int size, const Pixel& colour)
{
    const Pixel white{255, 255, 255, 255};
    bool right = pixels.size() == static_cast<std::size_t>(size) * static_cast<std::size_t>(size);
    for (int y = 0; right && y < size; ++y) {
        for (int x = 0; x < size; ++x) {
            const Pixel& pixel = pixels[static_cast<std::size_t>(y * size + x)];
            right = right && (x + y == size - 1 || pixel == (x + y < size ? colour : white));
        }
    }
    return right;
}

void oldVersion(GLenum name, GLint* value)
{
    *value = name == GL_MAJOR_VERSION ? 4 : 3;
}
void nothing()
{
}

} // namespace

BOOST_AUTO_TEST_SUITE(offscreen)

BOOST_DATA_TEST_CASE(a_context_draws_and_its_pixels_read_back, everySource, source)
{
    const OffscreenContext context(Debug::on, source);
    BOOST_TEST(context.description().find("OpenGL 4.") != std::string::npos);
    BOOST_TEST(isHalf(drawHalf(context, 64, {1, 0, 0, 1}), 64, {255, 0, 0, 255}));
    BOOST_TEST(isHalf(drawHalf(context, 33, {0, 0, 1, 1}), 33, {0, 0, 255, 255}));
}

BOOST_DATA_TEST_CASE(multisampled_edges_are_resolved, everySource, source)
{
    const OffscreenContext context(Debug::on, source);
    const auto current = context.makeCurrent();
    const Api& api = context.api();
    const Texture colour = makeTexture2D(api, GL_RGBA8, 8, 8, 4);
    const Texture depth = makeTexture2D(api, GL_DEPTH32F_STENCIL8, 8, 8, 4);
    const Framebuffer framebuffer = makeFramebuffer(api, colour, depth);
    const Texture flat = makeTexture2D(api, GL_RGBA8, 8, 8);
    const Framebuffer resolved = makeFramebuffer(api, flat, Texture());
    const std::array<float, 4> grey{0.2F, 0.4F, 0.6F, 1};
    api.ClearNamedFramebufferfv(framebuffer.name(), GL_COLOR, 0, grey.data());
    api.BlitNamedFramebuffer(framebuffer.name(), resolved.name(), 0, 0, 8, 8, 0, 0, 8, 8, GL_COLOR_BUFFER_BIT,
                             GL_NEAREST);
    api.BindFramebuffer(GL_FRAMEBUFFER, resolved.name());
    Pixel pixel{};
    api.ReadPixels(3, 3, 1, 1, GL_RGBA, GL_UNSIGNED_BYTE, pixel.data());
    throwIfFailed(api, "resolving");
    BOOST_CHECK((pixel == Pixel{51, 102, 153, 255}));
}

BOOST_DATA_TEST_CASE(two_contexts_do_not_mix, everySource, source)
{
    const OffscreenContext one(Debug::off, source);
    const OffscreenContext two(Debug::off, source);
    for (int i = 0; i < 3; ++i) {
        BOOST_TEST(isHalf(drawHalf(one, 16, {1, 0, 0, 1}), 16, {255, 0, 0, 255}));
        BOOST_TEST(isHalf(drawHalf(two, 16, {0, 1, 0, 1}), 16, {0, 255, 0, 255}));
    }
}

BOOST_DATA_TEST_CASE(a_context_works_from_any_thread, everySource, source)
{
    const OffscreenContext context(Debug::off, source);
    std::vector<Pixel> pixels;
    std::thread([&] { pixels = drawHalf(context, 16, {1, 0, 0, 1}); }).join();
    BOOST_TEST(isHalf(pixels, 16, {255, 0, 0, 255}));
    BOOST_TEST(isHalf(drawHalf(context, 16, {0, 1, 0, 1}), 16, {0, 255, 0, 255}));
}

// By luck a run ended well two times of three when EGL's data of the threads was left behind.
BOOST_AUTO_TEST_CASE(a_process_ends_well_though_workers_had_contexts)
{
    for (int run = 0; run < 20; ++run) BOOST_TEST(test::runCommand({CONTEXTS_ON_WORKERS}).status == 0);
}

BOOST_DATA_TEST_CASE(threads_draw_at_once_each_with_its_context, everySource, source)
{
    constexpr std::size_t count = 4;
    constexpr int rounds = 8;
    std::array<std::vector<std::vector<Pixel>>, count> pictures;
    std::vector<std::thread> threads;
    for (std::size_t t = 0; t < count; ++t) {
        threads.emplace_back([&, t] {
            for (int round = 0; round < rounds; ++round) { // contexts come and go while others draw
                const OffscreenContext context(Debug::off, source);
                pictures[t].push_back(drawHalf(context, 32, {t % 2 == 0 ? 1.0F : 0.0F, 0, t < 2 ? 1.0F : 0.0F, 1}));
            }
        });
    }
    for (std::thread& thread : threads) thread.join();
    for (std::size_t t = 0; t < count; ++t) {
        const Pixel colour{static_cast<std::uint8_t>(t % 2 == 0 ? 255 : 0), 0,
                           static_cast<std::uint8_t>(t < 2 ? 255 : 0), 255};
        for (const auto& picture : pictures[t]) BOOST_TEST(isHalf(picture, 32, colour));
    }
}

BOOST_DATA_TEST_CASE(a_context_is_current_once, everySource, source)
{
    const OffscreenContext one(Debug::off, source);
    const OffscreenContext two(Debug::off, source);
    {
        const auto current = one.makeCurrent();
        BOOST_CHECK_EXCEPTION((void)two.makeCurrent(), DeviceError, says({"already current"}));
        std::atomic<bool> refused{false};
        std::thread([&] {
            try {
                (void)one.makeCurrent();
            } catch (const DeviceError&) {
                refused = true;
            }
        }).join();
        BOOST_TEST(refused);
    }
    BOOST_CHECK_NO_THROW((void)two.makeCurrent());
    BOOST_CHECK_NO_THROW((void)one.makeCurrent());
}

BOOST_AUTO_TEST_CASE(contexts_of_two_drivers_do_not_mix, *boost::unit_test::precondition(thereIsOsmesa))
{
    const OffscreenContext egl(Debug::off, Source::egl);
    const OffscreenContext osmesa(Debug::off, Source::osmesa);
    for (int i = 0; i < 3; ++i) {
        BOOST_TEST(isHalf(drawHalf(egl, 16, {1, 0, 0, 1}), 16, {255, 0, 0, 255}));
        BOOST_TEST(isHalf(drawHalf(osmesa, 16, {0, 1, 0, 1}), 16, {0, 255, 0, 255}));
    }
    const auto current = egl.makeCurrent();
    BOOST_CHECK_EXCEPTION((void)osmesa.makeCurrent(), DeviceError, says({"already current"}));
}

BOOST_AUTO_TEST_CASE(a_context_says_where_it_comes_from)
{
    const OffscreenContext egl(Debug::off, Source::egl);
    BOOST_TEST(egl.description().find("EGL: ") == 0U);
    const OffscreenContext any;
    BOOST_TEST(any.description() == egl.description());
    BOOST_TEST(any.isSoftware() == egl.isSoftware());
    if (egl.isSoftware()) {
        BOOST_CHECK_EXCEPTION(OffscreenContext(Debug::off, Source::hardware), DeviceError, says({"hardware"}));
    } else {
        BOOST_TEST(OffscreenContext(Debug::off, Source::hardware).description() == egl.description());
    }
}

BOOST_AUTO_TEST_CASE(osmesa_is_software, *boost::unit_test::precondition(thereIsOsmesa))
{
    const OffscreenContext osmesa(Debug::off, Source::osmesa);
    BOOST_TEST(osmesa.description().find("OSMesa: ") == 0U);
    BOOST_TEST(osmesa.isSoftware());
}

BOOST_AUTO_TEST_SUITE_END()

BOOST_AUTO_TEST_SUITE(errors)

BOOST_AUTO_TEST_CASE(a_missing_driver_and_a_missing_function_are_named)
{
    BOOST_CHECK_EXCEPTION(detail::SharedLibrary("libNoSuchDriver.so.1"), DeviceError, says({"libNoSuchDriver.so.1"}));
    const detail::SharedLibrary library("libEGL.so.1");
    void (*function)() = nullptr;
    BOOST_CHECK_EXCEPTION(library.find("eglNoSuchFunction", function), DeviceError, says({"eglNoSuchFunction"}));
}

BOOST_AUTO_TEST_CASE(a_missing_entry_point_is_named)
{
    BOOST_CHECK_EXCEPTION(
        Api([](const char* name) -> AnyFunction { return std::string(name) == "glUseProgram" ? nullptr : &nothing; }),
        DeviceError, says({"glUseProgram"}));
}

BOOST_AUTO_TEST_CASE(an_old_context_is_refused)
{
    BOOST_CHECK_EXCEPTION(Api([](const char* name) -> AnyFunction {
                              return std::string(name) == "glGetIntegerv" ? reinterpret_cast<AnyFunction>(&oldVersion)
                                                                          : &nothing;
                          }),
                          DeviceError, says({"4.3", "4.5"}));
}

BOOST_DATA_TEST_CASE(a_shader_that_does_not_compile_carries_the_log, everySource, source)
{
    const OffscreenContext context(Debug::off, source);
    const auto current = context.makeCurrent();
    const ShaderSource broken{GL_FRAGMENT_SHADER, "broken.frag", "#version 450 core\nvoid main() { wrongName = 1; }"};
    BOOST_CHECK_EXCEPTION((void)makeProgram(context.api(), {cornerVert, broken}), DeviceError,
                          says({"broken.frag", "wrongName"}));
}

BOOST_DATA_TEST_CASE(stages_that_do_not_fit_carry_the_log, everySource, source)
{
    const OffscreenContext context(Debug::off, source);
    const auto current = context.makeCurrent();
    const ShaderSource hungry{GL_FRAGMENT_SHADER, "hungry.frag", R"(#version 450 core
in vec3 neverWritten;
layout(location = 0) out vec4 result;
void main() { result = vec4(neverWritten, 1.0); })"};
    BOOST_CHECK_EXCEPTION((void)makeProgram(context.api(), {cornerVert, hungry}), DeviceError,
                          says({"corner.vert + hungry.frag", "neverWritten"}));
}

BOOST_DATA_TEST_CASE(an_unknown_uniform_is_named, everySource, source)
{
    const OffscreenContext context(Debug::off, source);
    const auto current = context.makeCurrent();
    const ProgramObject program = makeProgram(context.api(), {cornerVert, plainFrag});
    BOOST_CHECK_EXCEPTION((void)uniformLocation(context.api(), program, "color"), DeviceError, says({"color"}));
}

BOOST_DATA_TEST_CASE(a_wrong_call_is_an_error_once, everySource, source)
{
    for (const auto debug : {Debug::off, Debug::on}) {
        const OffscreenContext context(debug, source);
        const auto current = context.makeCurrent();
        context.api().Enable(GL_TRIANGLES);
        BOOST_CHECK_EXCEPTION(throwIfFailed(context.api(), "testing"), DeviceError,
                              says({"testing", "GL_INVALID_ENUM"}));
        BOOST_CHECK_NO_THROW(throwIfFailed(context.api(), "testing"));
    }
}

BOOST_DATA_TEST_CASE(debug_messages_are_the_drivers_own_words, everySource, source)
{
    const OffscreenContext context(Debug::on, source);
    const auto current = context.makeCurrent();
    context.api().UseProgram(123456);
    BOOST_CHECK_EXCEPTION(throwIfFailed(context.api(), "testing"), DeviceError, says({"glUseProgram"}));
}

BOOST_DATA_TEST_CASE(what_does_not_fit_is_an_error, everySource, source)
{
    const OffscreenContext context(Debug::off, source);
    const auto current = context.makeCurrent();
    const Api& api = context.api();
    BOOST_CHECK_EXCEPTION((void)makeTexture2D(api, GL_RGBA8, 1 << 20, 1 << 20), DeviceError, says({"texture"}));
    BOOST_CHECK_EXCEPTION((void)makeBuffer(api, std::size_t{1} << 50U, nullptr), DeviceError,
                          says({"buffer", "GL_OUT_OF_MEMORY"}));
    BOOST_CHECK_THROW((void)makeFramebuffer(api, Texture(), Texture()), DeviceError);
    BOOST_CHECK_NO_THROW((void)makeBuffer(api, std::vector<float>()));
}

BOOST_DATA_TEST_CASE(objects_move, everySource, source)
{
    const OffscreenContext context(Debug::off, source);
    const auto current = context.makeCurrent();
    Buffer one = makeBuffer(context.api(), std::vector<float>{1});
    const GLuint name = one.name();
    Buffer two = std::move(one);
    BOOST_TEST(two.name() == name);
    one = std::move(two);
    BOOST_TEST(one.name() == name);
}

BOOST_AUTO_TEST_SUITE_END()
