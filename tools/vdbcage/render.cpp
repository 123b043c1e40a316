#include <tools/vdbcage/render.h>

#include <algorithm>
#include <cmath>
#include <string>

#include <shaders/render.h>
#include <tools/vdbcage/render_geometry.h>
#include <tools/vdbcage/render_view.h>
#include <vdbcage/core/error.h>
#include <vdbcage/gl/objects.h>
#include <vdbcage/gl/offscreen.h>
#include <vdbcage/gl/program.h>

namespace vdbcage {

namespace {

using namespace render;
using gl::Api;

// Every pixel is the mean of supersampling^2 drawn pixels of `samples` samples each.
constexpr int supersampling = 2;
constexpr int samples = 4;
// Large pictures are drawn in pieces of at most this many pixels a side: some 200 MB of memory.
constexpr int tileSize = 1024;
constexpr double creaseDegrees = 40;
constexpr Colour voxelEdgeColour{0.25F, 0.17F, 0.08F};
constexpr float voxelEdgeOpacity = 0.35F;
constexpr float hiddenLineOpacity = 0.16F;
// The part of the way to the eye by which lines stand out of the faces that they lie in.
constexpr float lineLift = 0.0005F;

/// A rectangle of a picture, y from the top.
struct Rectangle {
    int left, top, width, height;
};

[[noreturn]] void fail(const std::string& problem)
{
    throw InputError("picture: " + problem);
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
    requireView(scene.view);
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

/// The number of columns that makes the shorter side of a panel longest; of equals, the one with the most columns.
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

/// The last row of the grid may have no panel everywhere.
Picture blank(int width, int height, const Colour& background)
{
    Picture picture{width, height, {}};
    picture.rgb.resize(3 * static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
    for (std::size_t i = 0; i < picture.rgb.size(); ++i) {
        picture.rgb[i] = static_cast<std::uint8_t>(std::lround(255 * background[i % 3]));
    }
    return picture;
}

/// A layer in the device's memory.
struct Shape {
    gl::Buffer corners, segments;
    gl::VertexArray faces, lines;
    GLsizei cornerCount = 0, segmentCount = 0;
};

/// `vectors` vectors each: position, normal and colour; from and to.
gl::VertexArray describe(const Api& api, const gl::Buffer& buffer, GLuint vectors, GLuint divisor)
{
    constexpr auto size = static_cast<GLuint>(sizeof(Vec3f));
    gl::VertexArray layout = gl::makeVertexArray(api);
    api.VertexArrayVertexBuffer(layout.name(), 0, buffer.name(), 0, static_cast<GLsizei>(vectors * size));
    api.VertexArrayBindingDivisor(layout.name(), 0, divisor);
    for (GLuint attribute = 0; attribute < vectors; ++attribute) {
        api.VertexArrayAttribFormat(layout.name(), attribute, 3, GL_FLOAT, GL_FALSE, attribute * size);
        api.VertexArrayAttribBinding(layout.name(), attribute, 0);
        api.EnableVertexArrayAttrib(layout.name(), attribute);
    }
    return layout;
}

Shape upload(const Api& api, const Geometry& geometry)
{
    Shape shape;
    shape.corners = gl::makeBuffer(api, geometry.corners);
    shape.faces = describe(api, shape.corners, 3, 0);
    shape.cornerCount = static_cast<GLsizei>(geometry.corners.size());
    shape.segments = gl::makeBuffer(api, geometry.segments);
    shape.lines = describe(api, shape.segments, 2, 1);
    shape.segmentCount = static_cast<GLsizei>(geometry.segments.size());
    return shape;
}

/// What is drawn into; its samples are averaged into `flat`.
struct Canvas {
    Canvas(const Api& api, int canvasWidth, int canvasHeight)
        : width(canvasWidth), height(canvasHeight), colour(gl::makeTexture2D(api, GL_RGBA8, width, height, samples)),
          depth(gl::makeTexture2D(api, GL_DEPTH24_STENCIL8, width, height, samples)),
          flatColour(gl::makeTexture2D(api, GL_RGBA8, width, height)), drawing(gl::makeFramebuffer(api, colour, depth)),
          flat(gl::makeFramebuffer(api, flatColour, gl::Texture()))
    {
    }

    int width, height;
    gl::Texture colour, depth, flatColour;
    gl::Framebuffer drawing, flat;
};

class Renderer {
public:
    explicit Renderer(const Api& api)
        : api_(api), surface_(gl::makeProgram(api, {shaders::surfaceVert, shaders::surfaceFrag})),
          tint_(gl::makeProgram(api, {shaders::surfaceVert, shaders::tintFrag})),
          line_(gl::makeProgram(api, {shaders::lineVert, shaders::lineFrag}))
    {
        api_.PixelStorei(GL_PACK_ALIGNMENT, 1);
        api_.BlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
        api_.Enable(GL_BLEND);
        api_.Enable(GL_DEPTH_TEST);
        api_.Enable(GL_POLYGON_OFFSET_FILL);
        api_.StencilFunc(GL_EQUAL, 0, 0xFF);
        api_.StencilOp(GL_KEEP, GL_KEEP, GL_INCR);
    }

    /// Draws one panel into its rectangle of `picture`.
    void drawPanel(const std::vector<Layer>& layers, const std::vector<Geometry>& geometries, const Eye& eye,
                   const Colour& background, const Rectangle& panel, Picture& picture) const
    {
        std::vector<Shape> shapes;
        shapes.reserve(geometries.size());
        for (const Geometry& geometry : geometries) shapes.push_back(upload(api_, geometry));
        // So wide that lines look alike whatever the panel's size, but neither thin nor fat.
        const double lineWidth = std::clamp(std::min(panel.width, panel.height) / 600.0, 1.1, 6.0);
        for (int top = 0; top < panel.height; top += tileSize) {
            for (int left = 0; left < panel.width; left += tileSize) {
                const Rectangle tile{left, top, std::min(tileSize, panel.width - left),
                                     std::min(tileSize, panel.height - top)};
                const Canvas canvas(api_, tile.width * supersampling, tile.height * supersampling);
                look(eye, panel, tile);
                drawLayers(layers, shapes, background, lineWidth * supersampling, canvas);
                read(canvas, {panel.left + left, panel.top + top, tile.width, tile.height}, picture);
            }
        }
    }

private:
    void set(const gl::ProgramObject& program, const char* name, double value) const
    {
        api_.ProgramUniform1f(program.name(), gl::uniformLocation(api_, program, name), static_cast<float>(value));
    }
    void set(const gl::ProgramObject& program, const char* name, const Matrix& value) const
    {
        api_.ProgramUniformMatrix4fv(program.name(), gl::uniformLocation(api_, program, name), 1, GL_FALSE,
                                     value.data());
    }
    void set(const gl::ProgramObject& program, const Colour& colour, float opacity) const
    {
        api_.ProgramUniform4f(program.name(), gl::uniformLocation(api_, program, "colour"), colour[0], colour[1],
                              colour[2], opacity);
    }

    /// Aims the programs at `tile` (counted from the panel's corner) of `panel`.
    void look(const Eye& eye, const Rectangle& panel, const Rectangle& tile) const
    {
        const Crop crop{(2.0 * tile.left + tile.width) / panel.width - 1,
                        1 - (2.0 * tile.top + tile.height) / panel.height, //
                        1.0 * tile.width / panel.width, 1.0 * tile.height / panel.height};
        const Matrix toClip = clipMatrix(eye, crop);
        for (const gl::ProgramObject* program : {&surface_, &tint_, &line_}) set(*program, "toClip", toClip);
        set(surface_, "toView", viewMatrix(eye));
        api_.ProgramUniform4f(line_.name(), gl::uniformLocation(api_, line_, "eye"),
                              static_cast<float>(eye.position.x()), static_cast<float>(eye.position.y()),
                              static_cast<float>(eye.position.z()), lineLift);
        api_.ProgramUniform2f(line_.name(), gl::uniformLocation(api_, line_, "viewport"),
                              static_cast<float>(tile.width * supersampling),
                              static_cast<float>(tile.height * supersampling));
    }

    void drawLayers(const std::vector<Layer>& layers, const std::vector<Shape>& shapes, const Colour& background,
                    double lineWidth, const Canvas& canvas) const
    {
        api_.BindFramebuffer(GL_FRAMEBUFFER, canvas.drawing.name());
        api_.Viewport(0, 0, canvas.width, canvas.height);
        const std::array<float, 4> clear{background[0], background[1], background[2], 1};
        api_.ClearNamedFramebufferfv(canvas.drawing.name(), GL_COLOR, 0, clear.data());
        api_.ClearNamedFramebufferfi(canvas.drawing.name(), GL_DEPTH_STENCIL, 0, 1, 0);

        std::vector<std::size_t> wireframes;
        for (std::size_t i = 0; i < layers.size(); ++i) {
            if (layers[i].style == LayerStyle::wireframe) {
                wireframes.push_back(i);
                continue;
            }
            const bool edges = layers[i].style == LayerStyle::voxels;
            drawFaces(surface_, shapes[i], layers[i].colour, 1, GL_LESS, edges ? supersampling : 0);
            if (edges) {
                drawLines(canvas, shapes[i], voxelEdgeColour, voxelEdgeOpacity, 0.7 * lineWidth, GL_LEQUAL,
                          6 * lineWidth);
            }
        }
        // A wireframe is hidden by solid layers and by itself, not by other wireframes.
        gl::Texture solidDepth;
        gl::Framebuffer solid;
        const auto copyDepth = [&](const gl::Framebuffer& from, const gl::Framebuffer& to) {
            api_.BlitNamedFramebuffer(from.name(), to.name(), 0, 0, canvas.width, canvas.height, 0, 0, canvas.width,
                                      canvas.height, GL_DEPTH_BUFFER_BIT, GL_NEAREST);
        };
        if (wireframes.size() > 1) {
            solidDepth = gl::makeTexture2D(api_, GL_DEPTH24_STENCIL8, canvas.width, canvas.height, samples);
            solid = gl::makeFramebuffer(api_, gl::Texture(), solidDepth);
            copyDepth(canvas.drawing, solid);
        }
        for (const std::size_t i : wireframes) {
            if (i != wireframes.front()) copyDepth(solid, canvas.drawing);
            drawWireframe(canvas, layers[i], shapes[i], lineWidth);
        }
    }

    void drawWireframe(const Canvas& canvas, const Layer& layer, const Shape& shape, double lineWidth) const
    {
        api_.ColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
        drawFaces(tint_, shape, layer.colour, 0, GL_LESS, 2 * supersampling);
        api_.ColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
        if (layer.tint > 0) {
            once(canvas, [&] { drawFaces(tint_, shape, layer.colour, layer.tint, GL_LEQUAL, 0); });
        }
        drawLines(canvas, shape, layer.colour, hiddenLineOpacity, lineWidth, GL_GREATER, 0);
        drawLines(canvas, shape, layer.colour, 1, lineWidth, GL_LEQUAL, 0);
    }

    /// `setBack`: by how many pixels' worth of their slope the faces step back behind lines that lie in them.
    void drawFaces(const gl::ProgramObject& program, const Shape& shape, const Colour& colour, float opacity,
                   GLenum depthTest, int setBack) const
    {
        api_.PolygonOffset(static_cast<float>(setBack), static_cast<float>(setBack));
        set(program, colour, opacity);
        api_.DepthFunc(depthTest);
        api_.UseProgram(program.name());
        api_.BindVertexArray(shape.faces.name());
        api_.DrawArrays(GL_TRIANGLES, 0, shape.cornerCount);
    }

    void drawLines(const Canvas& canvas, const Shape& shape, const Colour& colour, float opacity, double width,
                   GLenum depthTest, double fadeLength) const
    {
        set(line_, colour, opacity);
        set(line_, "width", width);
        set(line_, "fadeLength", fadeLength);
        api_.DepthFunc(depthTest);
        api_.DepthMask(GL_FALSE);
        api_.UseProgram(line_.name());
        api_.BindVertexArray(shape.lines.name());
        once(canvas, [&] { api_.DrawArraysInstanced(GL_TRIANGLE_STRIP, 0, 4, shape.segmentCount); });
        api_.DepthMask(GL_TRUE);
    }

    /// Whatever `draw` draws covers each sample once, so that lines do not darken where they meet.
    template <typename Draw>
    void once(const Canvas& canvas, const Draw& draw) const
    {
        const GLint zero = 0;
        api_.ClearNamedFramebufferiv(canvas.drawing.name(), GL_STENCIL, 0, &zero);
        api_.Enable(GL_STENCIL_TEST);
        draw();
        api_.Disable(GL_STENCIL_TEST);
    }

    /// Averages the canvas into `target`, a rectangle of `picture`.
    void read(const Canvas& canvas, const Rectangle& target, Picture& picture) const
    {
        api_.BlitNamedFramebuffer(canvas.drawing.name(), canvas.flat.name(), 0, 0, canvas.width, canvas.height, 0, 0,
                                  canvas.width, canvas.height, GL_COLOR_BUFFER_BIT, GL_NEAREST);
        api_.BindFramebuffer(GL_FRAMEBUFFER, canvas.flat.name());
        const std::size_t stride = 4 * static_cast<std::size_t>(canvas.width);
        std::vector<std::uint8_t> pixels(stride * static_cast<std::size_t>(canvas.height));
        api_.ReadPixels(0, 0, canvas.width, canvas.height, GL_RGBA, GL_UNSIGNED_BYTE, pixels.data());
        gl::throwIfFailed(api_, "drawing a picture");

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

    const Api& api_;
    gl::ProgramObject surface_, tint_, line_;
};

} // namespace

Picture renderScene(const Scene& scene, int width, int height)
{
    requireSize("width", width);
    requireSize("height", height);
    requireScene(scene);
    const std::vector<Rectangle> rectangles = layOut(scene, width, height);

    openvdb::BBoxd all;
    std::vector<openvdb::BBoxd> boxes(scene.panels.size());
    for (std::size_t i = 0; i < boxes.size(); ++i) {
        for (const Layer& layer : scene.panels[i]) boxes[i].expand(boundingBox(*layer.mesh));
        all.expand(boxes[i]);
    }
    std::vector<std::vector<Geometry>> geometries(scene.panels.size());
    for (std::size_t i = 0; i < geometries.size(); ++i) {
        const Frame frame(scene.sameView ? all : boxes[i]);
        for (const Layer& layer : scene.panels[i]) {
            const double crease = layer.style == LayerStyle::shaded ? creaseDegrees : 0;
            geometries[i].push_back(makeGeometry(*layer.mesh, frame, crease, layer.pointColours));
        }
    }

    const gl::OffscreenContext context;
    const auto current = context.makeCurrent();
    const Renderer renderer(context.api());
    Picture picture = blank(width, height, scene.background);
    for (std::size_t i = 0; i < geometries.size(); ++i) {
        std::vector<const Geometry*> seen;
        for (std::size_t j = 0; j < geometries.size(); ++j) {
            if (j != i && !scene.sameView) continue;
            for (const Geometry& geometry : geometries[j]) seen.push_back(&geometry);
        }
        const Eye eye = fitEye(scene.view, seen, 1.0 * rectangles[i].width / rectangles[i].height);
        renderer.drawPanel(scene.panels[i], geometries[i], eye, scene.background, rectangles[i], picture);
    }
    return picture;
}

} // namespace vdbcage
