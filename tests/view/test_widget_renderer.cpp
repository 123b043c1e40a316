#include <boost/test/unit_test.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <initializer_list>
#include <vector>

#include <support/gl_sources.h>
#include <tools/draw/canvas.h>
#include <tools/view/widgets/imgui_versions.h>
#include <tools/view/widgets/theme.h>
#include <tools/view/widgets/widget_renderer.h>
#include <vdbcage/gl/offscreen.h>
#include <view/support/panel.h>

using namespace vdbcage;
using namespace vdbcage::view;
using test::Desk;
using test::Panel;

namespace {

using Pixels = std::vector<std::uint8_t>;
using GLenums = std::initializer_list<GLenum>; // the constants are signed
using Rgba = std::array<int, 4>;
using Source = gl::OffscreenContext::Source;

constexpr int side = 16; // pixels of small pictures

/// A context to draw drawings in.
struct Studio {
    explicit Studio(const Glyphs& glyphs, Source source = Source::any)
        : context(gl::OffscreenContext::Debug::on, source), current(context.makeCurrent()), api(context.api()),
          renderer(api, glyphs)
    {
        gl::enableDebugMessages(api);
    }

    Pixels picture(const Drawing& drawing, const std::array<float, 4>& behind = {})
    {
        const draw::Canvas canvas(api, drawing.width, drawing.height, 1);
        api.ClearNamedFramebufferfv(canvas.target().framebuffer, GL_COLOR, 0, behind.data());
        renderer.draw(canvas.target(), drawing);
        return canvas.pixels();
    }

    gl::OffscreenContext context;
    gl::OffscreenContext::Current current;
    const gl::Api& api;
    WidgetRenderer renderer;
};

/// One white glyph that covers all.
Glyphs block()
{
    return {1, 1, {255}};
}

/// A rectangle over all of a small picture that is seen in a part of it.
Drawing sheet(const std::array<std::uint8_t, 4>& rgba, const std::array<int, 4>& seen, std::uint32_t texture = 0)
{
    Drawing drawing;
    drawing.width = drawing.height = side;
    for (const auto& [u, v] : {std::array{0.0F, 0.0F}, {1.0F, 0.0F}, {1.0F, 1.0F}, {0.0F, 1.0F}}) {
        drawing.vertices.push_back({u * side, v * side, u, v, rgba});
    }
    drawing.indices = {0, 1, 2, 0, 2, 3};
    drawing.batches.push_back({seen[0], seen[1], seen[2], seen[3], texture, 0, 6});
    return drawing;
}

/// From the top left, as drawings count.
Rgba at(const Pixels& pixels, int width, int height, int x, int y)
{
    const std::uint8_t* p = &pixels[4 * static_cast<std::size_t>((height - 1 - y) * width + x)];
    return {p[0], p[1], p[2], p[3]};
}

Rgba opaque(const draw::Colour& colour)
{
    const auto channel = [&](std::size_t i) { return static_cast<int>(std::lround(255 * colour[i])); };
    return {channel(0), channel(1), channel(2), 255};
}

/// How many pixels of a place have a colour, or one so near that only the edges of letters differ.
int countOf(const Pixels& pixels, const Rgba& colour, const Panel::Place& place)
{
    int count = 0;
    for (int y = static_cast<int>(place.top); y < static_cast<int>(place.bottom); ++y) {
        for (int x = static_cast<int>(place.left); x < static_cast<int>(place.right); ++x) {
            const Rgba found = at(pixels, Panel::width, Panel::height, x, y);
            const auto isNear = [](int a, int b) { return std::abs(a - b) <= 24; };
            count += std::equal(found.begin(), found.end(), colour.begin(), isNear) ? 1 : 0;
        }
    }
    return count;
}

const Rgba nothing{0, 0, 0, 0};

} // namespace

BOOST_AUTO_TEST_SUITE(widget_renderer)

BOOST_AUTO_TEST_CASE(text_and_its_ground_are_drawn_where_they_were_laid_out)
{
    Desk desk;
    Studio studio(desk.widgets.glyphs());
    const Pixels pixels = studio.picture(desk.widgets.drawing());
    const Panel::Place button = desk.panel.places.at("button");
    Panel::Place field = desk.panel.places.at("field");
    field.right = (field.left + field.right) / 2; // without its label
    BOOST_TEST(countOf(pixels, opaque(theme::text), button) > 5);
    BOOST_TEST(countOf(pixels, opaque(theme::button), button) > 100);
    BOOST_TEST(countOf(pixels, opaque(theme::field), field) > 1000);
    BOOST_TEST(countOf(pixels, opaque(theme::text), field) == 0);
    const Panel::Place below{0, 380, Panel::width, Panel::height};
    BOOST_TEST(countOf(pixels, nothing, below) == 40 * Panel::width);
    desk.click("field");
    desk.type(U"ogre");
    const Pixels typed = studio.picture(desk.widgets.drawing());
    BOOST_TEST(countOf(typed, opaque(theme::text), field) > 5);
}

BOOST_AUTO_TEST_CASE(every_window_is_drawn_where_it_is)
{
    Widgets widgets(1);
    Studio studio(widgets.glyphs());
    const draw::Colour red{1, 0, 0};
    const draw::Colour green{0, 1, 0};
    const auto window = [](const char* name, float left, const draw::Colour& colour) {
        ImGui::PushStyleColor(ImGuiCol_WindowBg, ImVec4(colour[0], colour[1], colour[2], 1));
        ImGui::SetNextWindowPos({left, 0});
        ImGui::SetNextWindowSize({60, 60});
        ImGui::Begin(name, nullptr, ImGuiWindowFlags_NoDecoration);
        ImGui::End();
        ImGui::PopStyleColor();
    };
    widgets.layOut(nullptr, 160, 60, [&] {
        window("first", 0, red);
        window("second", 100, green);
    });
    const Pixels pixels = studio.picture(widgets.drawing());
    BOOST_TEST((at(pixels, 160, 60, 30, 30) == opaque(red)));
    BOOST_TEST((at(pixels, 160, 60, 80, 30) == nothing));
    BOOST_TEST((at(pixels, 160, 60, 130, 30) == opaque(green)));
}

BOOST_AUTO_TEST_CASE(the_font_has_the_letters_of_names_and_figures)
{
    Widgets widgets(1);
    const Glyphs& glyphs = widgets.glyphs();
    const auto inkOf = [&glyphs](const ImFontGlyph& glyph) {
        const auto column = [&](float u) {
            return static_cast<std::size_t>(std::lround(u * static_cast<float>(glyphs.width)));
        };
        const auto row = [&](float v) {
            return static_cast<std::size_t>(std::lround(v * static_cast<float>(glyphs.height)));
        };
        int ink = 0;
        for (std::size_t y = row(glyph.V0); y < row(glyph.V1); ++y) {
            for (std::size_t x = column(glyph.U0); x < column(glyph.U1); ++x) {
                ink += glyphs.coverage[y * static_cast<std::size_t>(glyphs.width) + x] > 80 ? 1 : 0;
            }
        }
        return ink;
    };
    widgets.layOut(nullptr, 100, 100, [&inkOf] {
        const std::u16string letters = u"Ag\u00e4\u00df\u0141\u03a9\u0436\u2192\u2713\u2264\u2026\u00d7\u2013\u201c";
        for (const char16_t letter : letters) {
            const ImFontGlyph* glyph = imgui::glyphOf(letter);
            const int code = letter;
            BOOST_REQUIRE_MESSAGE(glyph != nullptr, "no glyph of " << code);
            BOOST_TEST(inkOf(*glyph) > 3, code);
        }
    });
}

BOOST_AUTO_TEST_CASE(software_draws_the_same_bytes_by_every_way)
{
    Desk desk;
    useAll(desk);
    const auto draw = [&desk](Source source, bool& software) {
        Studio studio(desk.widgets.glyphs(), source);
        software = studio.context.isSoftware();
        return studio.picture(desk.widgets.drawing());
    };
    bool software = false;
    bool always = false;
    const Pixels egl = draw(Source::egl, software);
    const Pixels osmesa = draw(test::softwareSource(), always);
    BOOST_TEST(always);
    if (software) BOOST_TEST((egl == osmesa));
    bool again = false;
    BOOST_TEST((draw(test::softwareSource(), again) == osmesa));
}

BOOST_AUTO_TEST_CASE(a_batch_is_seen_inside_its_rectangle_only)
{
    Studio studio(block());
    const std::array<int, 4> seen{3, 5, 10, 7};
    const Pixels pixels = studio.picture(sheet({10, 20, 30, 255}, seen));
    for (int y = 0; y < side; ++y) {
        for (int x = 0; x < side; ++x) {
            const bool inside = x >= seen[0] && x < seen[2] && y >= seen[1] && y < seen[3];
            BOOST_TEST((at(pixels, side, side, x, y) == (inside ? Rgba{10, 20, 30, 255} : nothing)));
        }
    }
}

BOOST_AUTO_TEST_CASE(colours_in_the_framebuffer_are_times_their_alpha)
{
    Studio studio(block());
    const Drawing half = sheet({255, 51, 0, 128}, {0, 0, side, side});
    BOOST_TEST((at(studio.picture(half), side, side, 8, 8) == Rgba{128, 26, 0, 128}));
    // Over half of blue: 0.5 of that is left.
    const Rgba mixed = at(studio.picture(half, {0, 0, 0.4F, 0.4F}), side, side, 8, 8);
    BOOST_TEST((mixed == Rgba{128, 26, 51, 179}), mixed[0] << " " << mixed[1] << " " << mixed[2] << " " << mixed[3]);
}

BOOST_AUTO_TEST_CASE(pictures_in_panels_are_textures_of_opengl)
{
    Widgets widgets(1);
    Studio studio(widgets.glyphs());
    const gl::Texture texture = gl::makeTexture2D(studio.api, GL_RGBA8, 1, 2);
    const gl::Framebuffer upper = gl::makeFramebuffer(studio.api, texture, gl::Texture());
    // Its first row is drawn at the top.
    const std::array<std::uint8_t, 8> rows{0, 200, 0, 255, 0, 0, 100, 100};
    studio.api.TextureSubImage2D(texture.name(), 0, 0, 0, 1, 2, GL_RGBA, GL_UNSIGNED_BYTE, rows.data());
    for (const GLenum filter : GLenums{GL_TEXTURE_MIN_FILTER, GL_TEXTURE_MAG_FILTER}) {
        studio.api.TextureParameteri(texture.name(), filter, GL_NEAREST);
    }
    widgets.layOut(nullptr, side, side, [&texture] {
        ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {0, 0});
        ImGui::SetNextWindowPos({0, 0});
        ImGui::Begin("w", nullptr, ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoBackground);
        ImGui::Image(imgui::textureNamed(texture.name()), {side, side});
        ImGui::End();
        ImGui::PopStyleVar();
    });
    const Pixels pixels = studio.picture(widgets.drawing());
    BOOST_TEST((at(pixels, side, side, 8, 2) == Rgba{0, 200, 0, 255}));
    BOOST_TEST((at(pixels, side, side, 8, 13) == Rgba{0, 0, 100, 100}));
}

BOOST_AUTO_TEST_CASE(no_state_of_the_context_is_taken_for_granted)
{
    Desk desk;
    useAll(desk);
    Studio studio(desk.widgets.glyphs());
    const Pixels expected = studio.picture(desk.widgets.drawing());
    const gl::Api& api = studio.api;
    for (const GLenum state : GLenums{GL_CULL_FACE, GL_DEPTH_TEST, GL_STENCIL_TEST, GL_CLIP_DISTANCE0})
        api.Enable(state);
    api.DepthFunc(GL_NEVER);
    api.StencilFunc(GL_NEVER, 0, 0xFF);
    api.ColorMask(GL_FALSE, GL_FALSE, GL_TRUE, GL_TRUE);
    api.BlendFuncSeparate(GL_ZERO, GL_ONE, GL_ONE, GL_ONE);
    api.Scissor(0, 0, 1, 1);
    api.Viewport(0, 0, 5, 5);
    BOOST_TEST((studio.picture(desk.widgets.drawing()) == expected));
    BOOST_TEST((studio.picture(desk.widgets.drawing()) == expected));
    BOOST_TEST(gl::takeFailures(api).empty());
}

BOOST_AUTO_TEST_CASE(a_part_of_a_framebuffer_can_be_the_target)
{
    Studio studio(block());
    const draw::Canvas canvas(studio.api, 2 * side, 2 * side, 1);
    const std::array<float, 4> clear{};
    studio.api.ClearNamedFramebufferfv(canvas.target().framebuffer, GL_COLOR, 0, clear.data());
    draw::Target target = canvas.target();
    target.left = 4;
    target.bottom = 6;
    target.width = target.height = side;
    studio.renderer.draw(target, sheet({255, 255, 255, 255}, {0, 0, side, 2}));
    const Pixels pixels = canvas.pixels();
    const int top = 2 * side - 6 - side;
    BOOST_TEST((at(pixels, 2 * side, 2 * side, 4, top) == Rgba{255, 255, 255, 255}));
    BOOST_TEST((at(pixels, 2 * side, 2 * side, 3 + side, top + 1) == Rgba{255, 255, 255, 255}));
    BOOST_TEST((at(pixels, 2 * side, 2 * side, 3, top) == nothing));
    BOOST_TEST((at(pixels, 2 * side, 2 * side, 4, top - 1) == nothing));
    BOOST_TEST((at(pixels, 2 * side, 2 * side, 4, top + 2) == nothing));
    BOOST_TEST((at(pixels, 2 * side, 2 * side, 4 + side, top) == nothing));
}

BOOST_AUTO_TEST_CASE(drawings_may_grow_and_shrink)
{
    Studio studio(block());
    Drawing large = sheet({1, 2, 3, 255}, {0, 0, side, side});
    for (int i = 0; i < 2000; ++i) {
        for (const std::uint32_t corner : {0U, 1U, 2U, 0U, 2U, 3U}) {
            large.indices.push_back(static_cast<std::uint32_t>(large.vertices.size()) + corner);
        }
        for (std::size_t k = 0; k < 4; ++k) large.vertices.push_back(large.vertices[k]);
    }
    large.batches[0].indexCount = static_cast<std::uint32_t>(large.indices.size());
    const Drawing small = sheet({9, 8, 7, 255}, {0, 0, side, side});
    Drawing none;
    none.width = none.height = side;
    BOOST_TEST((at(studio.picture(none), side, side, 8, 8) == nothing));
    BOOST_TEST((at(studio.picture(small), side, side, 8, 8) == Rgba{9, 8, 7, 255}));
    BOOST_TEST((at(studio.picture(large), side, side, 8, 8) == Rgba{1, 2, 3, 255}));
    BOOST_TEST((at(studio.picture(small), side, side, 8, 8) == Rgba{9, 8, 7, 255}));
}

BOOST_AUTO_TEST_SUITE_END()
