#include <boost/test/unit_test.hpp>

#include <cmath>
#include <functional>
#include <memory>
#include <vector>

#include <draw/meshes.h>
#include <support/gl_sources.h>
#include <tools/draw/canvas.h>
#include <tools/draw/renderer.h>
#include <vdbcage/core/error.h>
#include <vdbcage/gl/offscreen.h>

using namespace vdbcage;
using namespace vdbcage::draw;
using openvdb::Vec3d;

namespace {

using Pixels = std::vector<std::uint8_t>;

constexpr int side = 64; // pixels of the pictures
constexpr Colour red{1, 0, 0}, green{0, 1, 0}, blue{0, 0, 1}, yellow{1, 1, 0};

/// Looks along -z at a cube, or at a ball in its place, that fills about half of a square picture.
struct Studio {
    explicit Studio(gl::OffscreenContext::Source source = gl::OffscreenContext::Source::any)
        : context(gl::OffscreenContext::Debug::off, source), current(context.makeCurrent()), renderer(context.api())
    {
        Camera camera;
        camera.view = {0, 0, UpAxis::y};
        camera.projection = Projection::orthographic;
        look.eye = eyeOf(camera, 1, {&reference.positions()});
    }

    Shape shapeOf(const Mesh& mesh, double creaseDegrees = 0) const
    {
        return {context.api(), Geometry(mesh, frame, creaseDegrees)};
    }

    Pixels picture(const std::vector<Layer>& layers)
    {
        const Canvas canvas(context.api(), side, side, 1);
        renderer.draw(canvas.target(), look, layers);
        return canvas.pixels();
    }

    const Frame frame{openvdb::BBoxd(Vec3d(-1), Vec3d(1))};
    const Geometry reference{test::cube(), frame, 0};
    gl::OffscreenContext context;
    gl::OffscreenContext::Current current;
    Renderer renderer;
    Look look;
};

/// A layer of one plain colour.
Layer plain(const Shape& shape, const Colour& colour, float opacity = 1)
{
    Layer layer;
    layer.shape = &shape;
    layer.shaded = false;
    layer.colour = colour;
    layer.opacity = opacity;
    return layer;
}

/// Under lamps with edges; and a tint over it.
std::vector<Layer> allKindsOf(const Shape& shape)
{
    Layer shaded;
    shaded.shape = &shape;
    shaded.edges.emplace();
    return {shaded, plain(shape, red, 0.4F)};
}

/// Columns count from the left, rows from below.
std::array<int, 4> at(const Pixels& pixels, int x, int y)
{
    const std::uint8_t* p = &pixels[4 * std::size_t(y * side + x)];
    return {p[0], p[1], p[2], p[3]};
}

/// As a plain colour is read back.
std::array<int, 4> opaque(const Colour& colour)
{
    const auto channel = [&](std::size_t i) { return static_cast<int>(std::lround(255 * colour[i])); };
    return {channel(0), channel(1), channel(2), 255};
}

const std::array<int, 4> white{255, 255, 255, 255};

std::size_t differing(const Pixels& a, const Pixels& b)
{
    std::size_t count = 0;
    for (int y = 0; y < side; ++y) {
        for (int x = 0; x < side; ++x) count += at(a, x, y) != at(b, x, y) ? 1 : 0;
    }
    return count;
}

/// A square in the plane z = `depth`, between `low` and `high` in x and in y.
Mesh square(double low, double high, double depth)
{
    Mesh mesh;
    mesh.points = {{low, low, depth}, {high, low, depth}, {high, high, depth}, {low, high, depth}};
    mesh.quads = {{0, 1, 2, 3}};
    return mesh;
}

} // namespace

BOOST_AUTO_TEST_SUITE(renderer)

BOOST_AUTO_TEST_CASE(nothing_is_background_and_what_is_not_visible_is_not_there)
{
    Studio studio;
    studio.look.background = blue;
    const Pixels empty = studio.picture({});
    for (int i = 0; i < side; ++i) BOOST_TEST((at(empty, i, i) == opaque(blue)));
    const Shape cube = studio.shapeOf(test::cube());
    Layer layer = plain(cube, red);
    BOOST_TEST(differing(studio.picture({layer}), empty) > 100U);
    layer.visible = false;
    BOOST_TEST((studio.picture({layer}) == empty));
    studio.look.backgroundOpacity = 0;
    BOOST_TEST((at(studio.picture({}), 3, 5) == std::array<int, 4>{0, 0, 0, 0}));
}

BOOST_AUTO_TEST_CASE(replaced_points_and_colours_give_the_bytes_of_a_new_shape)
{
    Studio studio;
    const Mesh ball = test::sphere(8);
    Mesh other = ball;
    for (Vec3d& point : other.points) point = {0.7 * point.x() + 0.2 * point.y(), point.y(), 0.8 * point.z()};
    std::vector<Colour> colours;
    for (const Vec3d& point : ball.points) colours.push_back({float(0.5 + 0.5 * point.x()), 1, 0.5F});

    Shape changed = studio.shapeOf(ball, 80);
    const Pixels before = studio.picture(allKindsOf(changed));
    changed.setPoints(other.points);
    changed.setPointColours(colours);
    Shape fresh = studio.shapeOf(other, 80);
    fresh.setPointColours(colours);
    const Pixels after = studio.picture(allKindsOf(changed));
    BOOST_TEST((after == studio.picture(allKindsOf(fresh))));
    BOOST_TEST(differing(after, before) > 100U);
    changed.setPoints(ball.points);
    changed.setPointColours({});
    BOOST_TEST((studio.picture(allKindsOf(changed)) == before));
    colours.pop_back();
    BOOST_CHECK_THROW(changed.setPointColours(colours), InputError);
    BOOST_CHECK_THROW(changed.setFaceLooks(std::vector<FaceLook>(3)), InputError);
}

BOOST_AUTO_TEST_CASE(looks_quads_and_flags_colour_the_faces_that_they_name)
{
    Studio studio;
    // Two triangles on the left, which come first, a quad on the right.
    Mesh mesh;
    mesh.points = {{-1, -1, 0}, {0, -1, 0}, {1, -1, 0}, {-1, 1, 0}, {0, 1, 0}, {1, 1, 0}};
    mesh.triangles = {{0, 1, 4}, {0, 4, 3}};
    mesh.quads = {{1, 2, 5, 4}};
    Shape shape = studio.shapeOf(mesh);
    Layer layer = plain(shape, red);
    layer.quadColour = green;
    layer.markedColour = blue;
    layer.selectedColour = yellow;
    const int middle = side / 2;
    const auto expect = [&](const Colour& lower, const Colour& upper, const Colour& quad) {
        const Pixels pixels = studio.picture({layer});
        BOOST_TEST((at(pixels, middle - 4, middle - 8) == opaque(lower)));
        BOOST_TEST((at(pixels, middle - 8, middle + 4) == opaque(upper)));
        BOOST_TEST((at(pixels, middle + 6, middle - 6) == opaque(quad)));
        BOOST_TEST((at(pixels, middle + 6, middle + 6) == opaque(quad)));
        BOOST_TEST((at(pixels, 1, 1) == white));
    };
    expect(red, red, green);
    std::vector<FaceLook> looks(3);
    looks[1].flags = FaceLook::marked;
    looks[2].flags = FaceLook::marked | FaceLook::selected;
    shape.setFaceLooks(looks);
    expect(red, blue, yellow);
    looks.assign(3, {});
    looks[0].colour = {51, 255, 255};
    shape.setFaceLooks(looks);
    expect({0.2F, 0, 0}, red, green);
    shape.setFaceLooks({});
    expect(red, red, green);
}

BOOST_AUTO_TEST_CASE(a_section_cuts_all_layers_in_any_view)
{
    Studio studio;
    const Shape cube = studio.shapeOf(test::cube());
    const Shape ball = studio.shapeOf(test::sphere(8));
    Layer frame = plain(ball, blue, 0.3F);
    frame.edges.emplace();
    studio.look.section = Section{{1, 0, 0}, 0};
    const Pixels cut = studio.picture({plain(cube, red), frame});
    const Pixels whole = [&] {
        Look look = studio.look;
        look.section.reset();
        std::swap(look, studio.look);
        Pixels pixels = studio.picture({plain(cube, red), frame});
        std::swap(look, studio.look);
        return pixels;
    }();
    for (int y = 0; y < side; ++y) {
        for (int x = 0; x < side; ++x) {
            // A pixel beside the plane may be either's.
            if (x < side / 2 - 1) BOOST_TEST((at(cut, x, y) == white));
            if (x > side / 2 + 1) BOOST_TEST((at(cut, x, y) == at(whole, x, y)));
        }
    }
    // Close by, where coordinates count from another origin.
    Camera camera;
    camera.view = {0, 0, UpAxis::y};
    camera.target = {0.3, 0, 0.6};
    camera.distance = 0.2;
    studio.look.eye = eyeOf(camera, 1, {&studio.reference.positions()});
    BOOST_TEST((studio.look.eye.origin != Vec3d(0)));
    studio.look.section = Section{{1, 0, 0}, 0.3};
    const Pixels near = studio.picture({plain(cube, red)});
    BOOST_TEST((at(near, side / 2 - 3, side / 2) == white));
    BOOST_TEST((at(near, side / 2 + 3, side / 2) == opaque(red)));
}

BOOST_AUTO_TEST_CASE(solid_layers_hide_and_others_do_not)
{
    Studio studio;
    const Shape back = studio.shapeOf(square(-1, 1, -0.5));
    const Shape front = studio.shapeOf(square(-1, 1, 0.5));
    const int middle = side / 2;
    const auto seen = [&](const std::vector<Layer>& layers) { return at(studio.picture(layers), middle, middle); };
    // Whatever the order.
    BOOST_TEST((seen({plain(back, red), plain(front, green)}) == opaque(green)));
    BOOST_TEST((seen({plain(front, green), plain(back, red)}) == opaque(green)));
    // Seen through; one behind a solid layer is hidden.
    const auto mixed = seen({plain(front, green, 0.5F), plain(back, red)});
    BOOST_TEST(mixed[0] > 120);
    BOOST_TEST(mixed[1] > 120);
    BOOST_TEST((seen({plain(back, red, 0.5F), plain(front, green)}) == opaque(green)));
    // Two that are not solid: both are seen, also the one behind that is drawn last.
    const auto both = seen({plain(front, green, 0.5F), plain(back, blue, 0.5F)});
    BOOST_TEST(both[0] < 80);
    BOOST_TEST(both[2] > both[0] + 60);
    BOOST_TEST(both[1] > both[0] + 30);
    // Lines are as faint as told where they are hidden.
    Layer lines = plain(back, blue, 0);
    lines.edges.emplace();
    lines.edges->colour = blue;
    lines.edges->hiddenOpacity = 0;
    BOOST_TEST((studio.picture({lines, plain(front, green)}) == studio.picture({plain(front, green)})));
    lines.edges->hiddenOpacity = 1;
    BOOST_TEST(differing(studio.picture({lines, plain(front, green)}), studio.picture({plain(front, green)})) > 50U);
}

BOOST_AUTO_TEST_CASE(a_part_of_a_framebuffer_is_drawn_and_no_more)
{
    Studio studio;
    const gl::Api& api = studio.context.api();
    const Shape ball = studio.shapeOf(test::sphere(8), 80);
    std::vector<Layer> layers = allKindsOf(ball);
    layers.push_back(plain(ball, blue, 0.2F));
    layers.back().edges.emplace();

    constexpr int half = side / 2;
    const Canvas small(api, half, half, 1);
    studio.renderer.draw(small.target(), studio.look, layers);
    const Pixels expected = small.pixels();

    const Canvas canvas(api, side, side, 1);
    Look onGreen = studio.look;
    onGreen.background = green;
    studio.renderer.draw(canvas.target(), onGreen, {});
    Target part = canvas.target();
    part.left = 20;
    part.bottom = 9;
    part.width = part.height = half;
    studio.renderer.draw(part, studio.look, layers);
    const Pixels pixels = canvas.pixels();
    for (int y = 0; y < side; ++y) {
        for (int x = 0; x < side; ++x) {
            const bool inside = x >= 20 && x < 20 + half && y >= 9 && y < 9 + half;
            const std::uint8_t* p = inside ? &expected[4 * std::size_t((y - 9) * half + x - 20)] : nullptr;
            const std::array<int, 4> wanted = inside ? std::array<int, 4>{p[0], p[1], p[2], p[3]} : opaque(green);
            BOOST_TEST((at(pixels, x, y) == wanted));
        }
    }
}

BOOST_AUTO_TEST_CASE(what_others_left_in_the_context_does_not_matter)
{
    Studio studio;
    const gl::Api& api = studio.context.api();
    const Shape ball = studio.shapeOf(test::sphere(8), 80);
    const std::vector<Layer> layers = allKindsOf(ball);
    const Pixels expected = studio.picture(layers);
    const std::vector<std::function<void()>> disturbances{
        [&] { api.Enable(GL_CULL_FACE); },
        [&] { api.Enable(GL_STENCIL_TEST); },
        [&] { api.StencilFunc(GL_NEVER, 3, 0xFF); },
        [&] { api.ColorMask(GL_FALSE, GL_FALSE, GL_TRUE, GL_TRUE); },
        [&] { api.DepthMask(GL_FALSE); },
        [&] { api.DepthFunc(GL_NEVER); },
        [&] { api.BlendFuncSeparate(GL_ONE, GL_ONE, GL_ONE, GL_ONE); },
        [&] { api.Viewport(3, 4, 5, 6); },
        [&] { api.Scissor(3, 4, 5, 6); },
        [&] { api.PolygonOffset(1000, 1000); },
        [&] { api.Enable(GL_CLIP_DISTANCE0); },
        [&] { api.PixelStorei(GL_PACK_ALIGNMENT, 8); },
    };
    for (const auto& disturb : disturbances) {
        disturb();
        BOOST_TEST((studio.picture(layers) == expected));
    }
    for (const auto& disturb : disturbances) disturb();
    BOOST_TEST((studio.picture(layers) == expected));
}

BOOST_AUTO_TEST_CASE(software_draws_the_same_bytes_by_every_way)
{
    const auto draw = [](gl::OffscreenContext::Source source, bool& software) {
        Studio studio(source);
        software = studio.context.isSoftware();
        const Shape ball = studio.shapeOf(test::sphere(8), 80);
        return studio.picture(allKindsOf(ball));
    };
    bool software = false;
    const Pixels any = draw(gl::OffscreenContext::Source::any, software);
    bool always = false;
    const Pixels own = draw(test::softwareSource(), always);
    BOOST_TEST(always);
    if (software) BOOST_TEST((any == own));
    bool again = false;
    BOOST_TEST((draw(test::softwareSource(), again) == own));
}

BOOST_AUTO_TEST_SUITE_END()
