#include <tools/cli/render.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include <tools/draw/canvas.h>
#include <tools/draw/geometry.h>
#include <tools/draw/renderer.h>
#include <tools/draw/shape.h>
#include <vdbcage/core/error.h>
#include <vdbcage/gl/offscreen.h>

namespace vdbcage {

namespace {

// Every pixel is the mean of supersampling^2 drawn pixels of `samples` samples each.
constexpr int supersampling = 2;
constexpr int samples = 4;
// Large pictures are drawn in pieces of at most this many pixels a side: some 200 MB of memory.
constexpr int tileSize = 1024;
constexpr double creaseDegrees = 40;
constexpr Colour voxelEdgeColour{0.25F, 0.17F, 0.08F};
constexpr float voxelEdgeOpacity = 0.35F;
/// A rectangle of a picture, y from the top.
struct Rectangle {
    int left, top, width, height;
};

[[noreturn]] void fail(const std::string& problem)
{
    throw InputError("picture", problem);
}

void requireSize(const char* what, int value)
{
    if (value < 1 || value > maximumPictureSize) {
        fail("its " + std::string(what) + " is " + std::to_string(value) + " pixels; 1 to " +
             std::to_string(maximumPictureSize) + " is allowed");
    }
}

void requireFraction(const char* what, float value)
{
    if (!(value >= 0 && value <= 1)) fail(std::string(what) + " is " + std::to_string(value) + "; 0 to 1 is allowed");
}

void requireColour(const char* what, const Colour& colour)
{
    for (const float channel : colour) requireFraction(what, channel);
}

void requireScene(const Scene& scene)
{
    if (scene.panels.empty()) fail("there is nothing to show; at least one panel is needed");
    if (scene.columns < 0) fail("it has " + std::to_string(scene.columns) + " columns; 0 or more are allowed");
    draw::requireView(scene.view);
    requireColour("the background", scene.background);
    for (const std::vector<Layer>& layers : scene.panels) {
        if (layers.empty()) fail("a panel has nothing to show; at least one layer is needed");
        for (const Layer& layer : layers) {
            if (!layer.mesh) fail("a layer has no mesh");
            requireUsable(*layer.mesh, "picture: a mesh");
            requireColour("a layer's colour", layer.colour);
            requireFraction("a layer's tint", layer.tint);
            for (const Colour& colour : layer.pointColours) requireColour("a point's colour", colour);
            if (!layer.pointColours.empty() && layer.pointColours.size() != layer.mesh->points.size()) {
                fail("a layer has " + std::to_string(layer.pointColours.size()) + " colours of points; its mesh has " +
                     std::to_string(layer.mesh->points.size()) + " points");
            }
        }
    }
}

/// Returns the number of columns that makes the shorter side of a panel longest; of equals, the greatest one.
int chooseColumns(int panels, int width, int height)
{
    int best = 1;
    int bestSide = 0;
    for (int columns = 1; columns <= panels; ++columns) {
        const int rows = (panels + columns - 1) / columns;
        const int side = std::min(width / columns, height / rows);
        if (side >= bestSide) {
            best = columns;
            bestSide = side;
        }
    }
    return best;
}

std::vector<Rectangle> layOut(const Scene& scene, int width, int height)
{
    const int count = static_cast<int>(scene.panels.size());
    const int columns = scene.columns > 0 ? std::min(scene.columns, count) : chooseColumns(count, width, height);
    const int rows = (count + columns - 1) / columns;
    if (columns > width || rows > height) {
        fail(std::to_string(width) + " x " + std::to_string(height) + " pixels are too few for " +
             std::to_string(count) + " panels");
    }
    std::vector<Rectangle> panels;
    for (int i = 0; i < count; ++i) {
        const int left = i % columns * width / columns;
        const int top = i / columns * height / rows;
        panels.push_back(
            {left, top, (i % columns + 1) * width / columns - left, (i / columns + 1) * height / rows - top});
    }
    return panels;
}

/// Returns an empty picture: the last row of the grid may lack panels.
Picture blank(int width, int height, const Colour& background)
{
    Picture picture{width, height, {}};
    picture.rgb.resize(3 * static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
    for (std::size_t i = 0; i < picture.rgb.size(); ++i) {
        picture.rgb[i] = static_cast<std::uint8_t>(std::lround(255 * background[i % 3]));
    }
    return picture;
}

draw::Layer drawnLayer(const Layer& layer, const draw::Shape& shape)
{
    draw::Layer drawn;
    drawn.shape = &shape;
    drawn.colour = layer.colour;
    draw::Edges edges;
    switch (layer.style) {
    case LayerStyle::shaded:
        break;
    case LayerStyle::wireframe:
        drawn.shaded = false;
        drawn.opacity = layer.tint;
        edges.colour = layer.colour;
        drawn.edges = edges;
        break;
    case LayerStyle::voxels:
        edges.colour = voxelEdgeColour;
        edges.opacity = voxelEdgeOpacity;
        edges.hiddenOpacity = 0;
        edges.relativeWidth = 0.7;
        edges.relativeFadeLength = 6;
        drawn.edges = edges;
        break;
    }
    return drawn;
}

/// Averages the canvas into `target`, a rectangle of `picture`.
void read(const draw::Canvas& canvas, const Rectangle& target, Picture& picture)
{
    const std::vector<std::uint8_t> pixels = canvas.pixels();
    const std::size_t stride = 4 * static_cast<std::size_t>(target.width) * supersampling;
    constexpr unsigned count = supersampling * supersampling;
    for (int y = 0; y < target.height; ++y) {
        const auto row = static_cast<std::size_t>(target.height - 1 - y) * supersampling; // OpenGL counts upwards
        auto out = picture.rgb.begin() + 3 * (std::ptrdiff_t(target.top + y) * picture.width + target.left);
        for (std::size_t x = 0; x < static_cast<std::size_t>(target.width); ++x) {
            for (std::size_t channel = 0; channel < 3; ++channel) {
                unsigned sum = count / 2;
                for (std::size_t j = 0; j < supersampling; ++j) {
                    for (std::size_t i = 0; i < supersampling; ++i) {
                        sum += pixels[(row + j) * stride + 4 * (x * supersampling + i) + channel];
                    }
                }
                *out++ = static_cast<std::uint8_t>(sum / count);
            }
        }
    }
}

/// Draws one panel, piece by piece, into its rectangle of `picture`.
void drawPanel(const gl::Api& api, draw::Renderer& renderer, const std::vector<draw::Layer>& layers,
               const draw::Eye& eye, const Colour& background, const Rectangle& panel, Picture& picture)
{
    draw::Look look{eye};
    look.background = background;
    for (int top = 0; top < panel.height; top += tileSize) {
        for (int left = 0; left < panel.width; left += tileSize) {
            const Rectangle tile{left, top, std::min(tileSize, panel.width - left),
                                 std::min(tileSize, panel.height - top)};
            look.crop = {(2.0 * tile.left + tile.width) / panel.width - 1,
                         1 - (2.0 * tile.top + tile.height) / panel.height, //
                         1.0 * tile.width / panel.width, 1.0 * tile.height / panel.height};
            const draw::Canvas canvas(api, tile.width * supersampling, tile.height * supersampling, samples);
            draw::Target target = canvas.target();
            target.pixelScale = supersampling;
            // Lines look alike at any size of the panel, but are neither thin nor fat.
            target.lineWidth = std::clamp(std::min(panel.width, panel.height) / 600.0, 1.1, 6.0);
            renderer.draw(target, look, layers);
            read(canvas, {panel.left + left, panel.top + top, tile.width, tile.height}, picture);
        }
    }
}

std::vector<std::vector<draw::Geometry>> makeGeometries(const Scene& scene)
{
    openvdb::BBoxd all;
    std::vector<openvdb::BBoxd> boxes(scene.panels.size());
    for (std::size_t i = 0; i < boxes.size(); ++i) {
        for (const Layer& layer : scene.panels[i]) boxes[i].expand(boundingBox(*layer.mesh));
        all.expand(boxes[i]);
    }
    std::vector<std::vector<draw::Geometry>> geometries(scene.panels.size());
    for (std::size_t i = 0; i < geometries.size(); ++i) {
        const draw::Frame frame(scene.sameView ? all : boxes[i]);
        for (const Layer& layer : scene.panels[i]) {
            const double crease = layer.style == LayerStyle::shaded ? creaseDegrees : 0;
            geometries[i].emplace_back(*layer.mesh, frame, crease);
        }
    }
    return geometries;
}

} // namespace

Picture renderScene(const Scene& scene, int width, int height)
{
    requireSize("width", width);
    requireSize("height", height);
    requireScene(scene);
    const std::vector<Rectangle> rectangles = layOut(scene, width, height);
    std::vector<std::vector<draw::Geometry>> geometries = makeGeometries(scene);

    std::vector<draw::Eye> eyes;
    for (std::size_t i = 0; i < geometries.size(); ++i) {
        draw::PointSets seen;
        for (std::size_t j = 0; j < geometries.size(); ++j) {
            if (j != i && !scene.sameView) continue;
            for (const draw::Geometry& geometry : geometries[j]) seen.push_back(&geometry.positions());
        }
        const double aspect = 1.0 * rectangles[i].width / rectangles[i].height;
        eyes.push_back(draw::eyeOf(draw::fit(scene.view, draw::Projection::perspective, seen, aspect), aspect, seen));
    }

    const gl::OffscreenContext context;
    const auto current = context.makeCurrent();
    draw::Renderer renderer(context.api());
    Picture picture = blank(width, height, scene.background);
    for (std::size_t i = 0; i < geometries.size(); ++i) {
        std::vector<draw::Shape> shapes;
        std::vector<draw::Layer> layers;
        for (draw::Geometry& geometry : geometries[i]) shapes.emplace_back(context.api(), std::move(geometry));
        for (std::size_t j = 0; j < shapes.size(); ++j) {
            shapes[j].setPointColours(scene.panels[i][j].pointColours);
            layers.push_back(drawnLayer(scene.panels[i][j], shapes[j]));
        }
        drawPanel(context.api(), renderer, layers, eyes[i], scene.background, rectangles[i], picture);
    }
    return picture;
}

} // namespace vdbcage
