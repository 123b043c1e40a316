#include <boost/test/unit_test.hpp>

#include <array>
#include <cstdlib>
#include <limits>
#include <string>
#include <thread>

#include <draw/meshes.h>
#include <support/says.h>
#include <tools/cli/render.h>
#include <vdbcage/core/error.h>

using namespace vdbcage;
using openvdb::Vec3d;
using test::says;

namespace {

using Pixel = std::array<int, 3>;

Pixel at(const Picture& picture, int x, int y)
{
    const auto* p = &picture.rgb[3 * (std::size_t(y) * std::size_t(picture.width) + std::size_t(x))];
    return {p[0], p[1], p[2]};
}

const Pixel white{255, 255, 255};

template <typename Condition>
double share(const Picture& picture, const Condition& condition)
{
    int count = 0;
    for (int y = 0; y < picture.height; ++y) {
        for (int x = 0; x < picture.width; ++x) count += condition(at(picture, x, y)) ? 1 : 0;
    }
    return double(count) / (double(picture.width) * picture.height);
}

bool isBlue(const Pixel& p)
{
    return p[2] > 200 && p[0] < 60 && p[1] < 60;
}

/// The share of pixels in which the pictures differ by more than a trace.
double difference(const Picture& a, const Picture& b)
{
    BOOST_REQUIRE(a.rgb.size() == b.rgb.size());
    std::size_t count = 0;
    for (std::size_t i = 0; i < a.rgb.size(); ++i) count += std::abs(a.rgb[i] - b.rgb[i]) > 3 ? 1 : 0;
    return double(count) / double(a.rgb.size());
}

Scene sceneOf(std::vector<Layer> layers)
{
    Scene scene;
    scene.panels.push_back(std::move(layers));
    return scene;
}

constexpr Colour red{0.9F, 0.1F, 0.1F};
constexpr Colour blue{0, 0, 1};

/// A red ball in a wireframe cube.
struct BallInCube {
    Mesh ball, box;
    Scene scene;
    explicit BallInCube(double scale = 1, const Vec3d& shift = Vec3d(0))
        : ball(test::moved(test::sphere(12), scale, shift)), box(test::moved(test::cube(), 1.2 * scale, shift)),
          scene(sceneOf({{&ball, LayerStyle::shaded, red, 0}, {&box, LayerStyle::wireframe, blue, 0.1F}}))
    {
    }
};

} // namespace

BOOST_AUTO_TEST_SUITE(render_scene)

BOOST_AUTO_TEST_CASE(a_red_ball_on_white)
{
    const Mesh ball = test::sphere(16);
    const Picture picture = renderScene(sceneOf({{&ball, LayerStyle::shaded, red, 0}}), 160, 120);
    BOOST_TEST(picture.width == 160);
    BOOST_TEST(picture.height == 120);
    BOOST_REQUIRE(picture.rgb.size() == 160U * 120 * 3);
    for (const auto& [x, y] : {std::pair{0, 0}, {159, 0}, {0, 119}, {159, 119}, {80, 3}, {80, 116}, {22, 60}}) {
        BOOST_CHECK(at(picture, x, y) == white);
    }
    const Pixel centre = at(picture, 80, 60);
    BOOST_TEST(centre[0] > 150);
    BOOST_TEST(centre[1] < 100);
    BOOST_TEST(centre[2] < 100);
    // The key lamp hangs at the upper left.
    BOOST_TEST(at(picture, 65, 40)[0] > at(picture, 95, 85)[0] + 30);
    // A disc of 90 % of the height: 108 pixels across, 0.477 of the picture.
    BOOST_TEST(std::abs(share(picture, [](const Pixel& p) { return p != white; }) - 0.477) < 0.02);
}

BOOST_AUTO_TEST_CASE(the_background_and_colours_are_as_asked)
{
    const Mesh box = test::cube();
    Scene scene = sceneOf({{&box, LayerStyle::wireframe, blue, 0}});
    scene.background = {0, 1, 0};
    const Picture picture = renderScene(scene, 300, 300);
    BOOST_CHECK((at(picture, 2, 2) == Pixel{0, 255, 0}));
    BOOST_TEST(share(picture, isBlue) > 0.005);
}

BOOST_AUTO_TEST_CASE(a_wireframe_is_seen_over_the_model_and_faint_behind_it)
{
    // Turned by 45 degrees the cube has an edge in the middle before the ball and one behind it.
    BallInCube both;
    both.scene.view = {45, 0, UpAxis::y};
    both.scene.panels[0][1].tint = 0;
    const Picture before = renderScene(both.scene, 401, 401);
    BOOST_CHECK(isBlue(at(before, 200, 200)));
    // Without its faces at the front only the edge behind is left: the ball shows through it.
    Mesh& box = both.box;
    box.quads = {{0, 4, 6, 2}, {0, 2, 3, 1}}; // x = -1 and z = -1
    const Picture behind = renderScene(both.scene, 401, 401);
    const Picture ball = renderScene(sceneOf({both.scene.panels[0][0]}), 401, 401);
    const Pixel line = at(behind, 200, 200);
    const Pixel beside = at(behind, 190, 200);
    BOOST_TEST(!isBlue(line));
    BOOST_TEST(line[2] > beside[2] + 10); // some blue
    BOOST_TEST(line[0] > beside[0] / 2);  // much red
    BOOST_TEST(share(ball, isBlue) == 0.0);
}

BOOST_AUTO_TEST_CASE(a_wireframe_hides_its_own_far_side)
{
    const Mesh box = test::cube();
    Scene scene = sceneOf({{&box, LayerStyle::wireframe, {0, 0, 0}, 0}});
    scene.view = {0, 0, UpAxis::y};
    const Picture picture = renderScene(scene, 400, 400);
    int strong = 0;
    int faint = 0;
    for (int x = 0; x < 400; ++x) {
        const int level = at(picture, x, 200)[0];
        strong += level < 130 ? 1 : 0;
        faint += level > 200 && level < 250 ? 1 : 0;
    }
    BOOST_TEST(strong >= 2); // two lines of the near side
    BOOST_TEST(strong <= 4);
    BOOST_TEST(faint >= 2); // two of the far side, between them
}

BOOST_AUTO_TEST_CASE(quads_have_no_diagonals)
{
    const Mesh box = test::cube();
    Scene scene = sceneOf({{&box, LayerStyle::wireframe, blue, 0}});
    scene.view = {0, 0, UpAxis::y};
    BOOST_CHECK(!isBlue(at(renderScene(scene, 401, 401), 200, 200)));
    Mesh split = box;
    split.triangles = triangulate(box);
    split.quads.clear();
    scene.panels[0][0].mesh = &split;
    BOOST_CHECK(isBlue(at(renderScene(scene, 401, 401), 200, 200)));
}

BOOST_AUTO_TEST_CASE(a_tint_covers_the_faces_once)
{
    const Mesh box = test::cube();
    Mesh twice = box; // the same faces again
    twice.quads.insert(twice.quads.end(), box.quads.begin(), box.quads.end());
    for (const Mesh* mesh : {&box, static_cast<const Mesh*>(&twice)}) {
        Scene scene = sceneOf({{mesh, LayerStyle::wireframe, {0, 0, 0}, 0.2F}});
        scene.view = {0, 0, UpAxis::y};
        BOOST_CHECK((at(renderScene(scene, 101, 101), 50, 50) == Pixel{204, 204, 204}));
    }
}

BOOST_AUTO_TEST_CASE(a_wireframe_does_not_hide_another)
{
    const Mesh outer = test::cube();
    const Mesh inner = test::moved(outer, 0.5);
    Scene scene = sceneOf({{&outer, LayerStyle::wireframe, red, 0}, {&inner, LayerStyle::wireframe, blue, 0}});
    const double withOuter = share(renderScene(scene, 300, 300), isBlue);
    BOOST_TEST(withOuter > 0.002);
}

BOOST_AUTO_TEST_CASE(voxels_are_flat_with_darker_edges)
{
    const Mesh box = test::cube();
    const Scene scene = sceneOf({voxelsLayer(box)});
    const Picture picture = renderScene(scene, 300, 300);
    BOOST_CHECK(at(picture, 140, 150) != white);
    // Three flat faces, nearly: each a colour of its own, and darker lines where they meet.
    const Picture smooth = renderScene(sceneOf({shadedLayer(box)}), 300, 300);
    BOOST_TEST(difference(picture, smooth) > 0.01);
    Mesh grid; // one side of the cube as 8 x 8 faces
    grid.points.clear();
    for (int j = 0; j <= 8; ++j) {
        for (int i = 0; i <= 8; ++i) grid.points.emplace_back(i, j, 0);
    }
    for (unsigned j = 0; j < 8; ++j) {
        for (unsigned i = 0; i < 8; ++i)
            grid.quads.emplace_back(j * 9 + i, j * 9 + i + 1, j * 9 + i + 10, j * 9 + i + 9);
    }
    Scene front = sceneOf({voxelsLayer(grid)});
    front.view = {0, 0, UpAxis::y};
    const Picture lines = renderScene(front, 401, 401);
    int dips = 0;
    for (int x = 30; x < 370; ++x) {
        if (at(lines, x, 225)[0] + 15 < at(lines, x - 4, 225)[0] && at(lines, x, 225)[0] <= at(lines, x - 1, 225)[0] &&
            at(lines, x, 225)[0] < at(lines, x + 1, 225)[0]) {
            ++dips;
        }
    }
    BOOST_TEST(dips >= 7);
    BOOST_TEST(dips <= 9);
}

BOOST_AUTO_TEST_CASE(panels_fill_a_grid)
{
    const Mesh ball = test::sphere(8);
    Scene scene;
    scene.panels = {{{&ball, LayerStyle::shaded, {1, 0, 0}, 0}},
                    {{&ball, LayerStyle::shaded, {0, 1, 0}, 0}},
                    {{&ball, LayerStyle::shaded, {0, 0, 1}, 0}}};
    const auto strongest = [](const Pixel& p) { return std::max_element(p.begin(), p.end()) - p.begin(); };
    const Picture row = renderScene(scene, 300, 100);
    for (int i = 0; i < 3; ++i) BOOST_TEST(strongest(at(row, 50 + 100 * i, 50)) == i);
    const Picture column = renderScene(scene, 100, 300);
    for (int i = 0; i < 3; ++i) BOOST_TEST(strongest(at(column, 50, 50 + 100 * i)) == i);
    scene.columns = 2;
    const Picture square = renderScene(scene, 201, 203);
    BOOST_TEST(strongest(at(square, 50, 50)) == 0);
    BOOST_TEST(strongest(at(square, 150, 50)) == 1);
    BOOST_TEST(strongest(at(square, 50, 150)) == 2);
    BOOST_CHECK(at(square, 150, 150) == white);
}

BOOST_AUTO_TEST_CASE(the_same_view_keeps_sizes_comparable)
{
    const Mesh large = test::sphere(8);
    const Mesh small = test::moved(large, 0.5);
    Scene scene;
    scene.panels = {{shadedLayer(large)}, {shadedLayer(small)}};
    const auto covered = [&](const Picture& picture, int left) {
        int count = 0;
        for (int x = left; x < left + 100; ++x) count += at(picture, x, 50) != white ? 1 : 0;
        return count;
    };
    const Picture each = renderScene(scene, 200, 100);
    BOOST_TEST(std::abs(covered(each, 0) - covered(each, 100)) <= 1);
    scene.sameView = true;
    const Picture same = renderScene(scene, 200, 100);
    BOOST_TEST(std::abs(covered(same, 0) - 2 * covered(same, 100)) <= 4);
}

BOOST_AUTO_TEST_CASE(the_same_scene_gives_the_same_bytes_also_from_two_threads_at_once)
{
    const BallInCube both;
    const Picture reference = renderScene(both.scene, 200, 150);
    BOOST_CHECK(renderScene(both.scene, 200, 150).rgb == reference.rgb);
    std::array<Picture, 3> pictures;
    std::array<std::thread, 3> threads;
    for (std::size_t i = 0; i < threads.size(); ++i) {
        threads[i] = std::thread([&, i] { pictures[i] = renderScene(both.scene, 200, 150); });
    }
    for (std::thread& thread : threads) thread.join();
    for (const Picture& picture : pictures) BOOST_CHECK(picture.rgb == reference.rgb);
}

BOOST_AUTO_TEST_CASE(size_and_place_do_not_matter)
{
    const Picture reference = renderScene(BallInCube().scene, 240, 180);
    for (const double scale : {0x1p-20, 0x1p20, 0x1p600, 0x1p-600}) { // exact
        BOOST_CHECK(renderScene(BallInCube(scale).scene, 240, 180).rgb == reference.rgb);
    }
    for (const double scale : {1e-6, 1e6}) { // rounded differently
        BOOST_TEST(difference(renderScene(BallInCube(scale).scene, 240, 180), reference) < 0.002);
    }
    BOOST_TEST(difference(renderScene(BallInCube(1, Vec3d(1e6, -2e6, 3e6)).scene, 240, 180), reference) < 0.002);
}

BOOST_AUTO_TEST_CASE(pieces_of_a_large_picture_join)
{
    // 1,100 pixels are two pieces; a quarter of the picture at each side of the seam against the same drawn small.
    BallInCube both;
    const Picture large = renderScene(both.scene, 1100, 220);
    const auto isInk = [](const Pixel& p) { return p != white; };
    BOOST_TEST(share(large, isInk) > 0.05);
    both.scene.view = {0, 0, UpAxis::y};
    const Picture wide = renderScene(sceneOf({both.scene.panels[0][0]}), 2048, 64); // the seam is the middle
    for (int y = 0; y < 64; ++y) {
        const Pixel left = at(wide, 1023, y);
        const Pixel right = at(wide, 1024, y);
        for (std::size_t i = 0; i < 3; ++i) BOOST_TEST(std::abs(left[i] - right[i]) < 16);
    }
    BOOST_CHECK(at(wide, 1023, 32) != white);
}

BOOST_AUTO_TEST_CASE(what_cannot_be_drawn_is_an_error)
{
    const Mesh ball = test::sphere(2);
    const Scene good = sceneOf({shadedLayer(ball)});
    BOOST_CHECK_EXCEPTION(renderScene(Scene(), 10, 10), InputError, says("panel"));
    BOOST_CHECK_EXCEPTION(renderScene(sceneOf({}), 10, 10), InputError, says("layer"));
    BOOST_CHECK_EXCEPTION(renderScene(sceneOf({Layer()}), 10, 10), InputError, says("no mesh"));
    const Mesh empty;
    BOOST_CHECK_EXCEPTION(renderScene(sceneOf({shadedLayer(empty)}), 10, 10), InputError, says("no faces"));
    Mesh infinite = ball;
    infinite.points[0].x() = std::numeric_limits<double>::infinity();
    BOOST_CHECK_EXCEPTION(renderScene(sceneOf({shadedLayer(infinite)}), 10, 10), InputError, says("finite"));
    BOOST_CHECK_EXCEPTION(renderScene(good, 0, 10), InputError, says("width"));
    BOOST_CHECK_EXCEPTION(renderScene(good, 10, 16385), InputError, says("16385"));
    for (const double elevation : {91.0, -91.0, std::numeric_limits<double>::quiet_NaN()}) {
        Scene scene = good;
        scene.view.elevationDegrees = elevation;
        BOOST_CHECK_EXCEPTION(renderScene(scene, 10, 10), InputError, says("elevation"));
    }
    Scene scene = good;
    scene.view.azimuthDegrees = std::numeric_limits<double>::infinity();
    BOOST_CHECK_EXCEPTION(renderScene(scene, 10, 10), InputError, says("azimuth"));
    scene = good;
    scene.panels[0][0].tint = 1.5F;
    BOOST_CHECK_EXCEPTION(renderScene(scene, 10, 10), InputError, says("tint"));
    scene = good;
    scene.background[1] = std::numeric_limits<float>::quiet_NaN();
    BOOST_CHECK_EXCEPTION(renderScene(scene, 10, 10), InputError, says("background"));
    scene = good;
    scene.columns = -1;
    BOOST_CHECK_EXCEPTION(renderScene(scene, 10, 10), InputError, says("columns"));
    scene.columns = 2;
    scene.panels.push_back(scene.panels[0]);
    BOOST_CHECK_EXCEPTION(renderScene(scene, 1, 10), InputError, says("too few"));
    BOOST_CHECK_NO_THROW(renderScene(good, 1, 1));
}

BOOST_AUTO_TEST_SUITE_END()
