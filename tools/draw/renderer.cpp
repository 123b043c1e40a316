#include <tools/draw/renderer.h>

#include <array>

#include <shaders/draw.h>
#include <vdbcage/gl/program.h>

namespace vdbcage::draw {

namespace {

using openvdb::Vec3d;

// The fraction of the way to the eye by which lines stand out of their faces.
constexpr double lineLift = 0.0005;

bool isSolid(const Layer& layer)
{
    return layer.opacity >= 1;
}

/// Returns the fraction of the way to the viewpoint that is lineLift of the way to the eye.
double liftOf(const Eye& eye)
{
    return eye.projection == Projection::perspective ? lineLift : lineLift / orthographicViewpoint;
}

} // namespace

Renderer::Renderer(const gl::Api& api)
    : api_(api), surface_(gl::makeProgram(api, {shaders::surfaceVert, shaders::surfaceFrag})),
      tint_(gl::makeProgram(api, {shaders::surfaceVert, shaders::tintFrag})),
      line_(gl::makeProgram(api, {shaders::lineVert, shaders::lineFrag}))
{
}

void Renderer::draw(const Target& target, const Look& look, const std::vector<Layer>& layers)
{
    prepare(target, look);
    aim(target, look);
    std::vector<const Layer*> seeThrough;
    for (const Layer& layer : layers) {
        if (!layer.visible) continue;
        if (isSolid(layer)) {
            drawSolid(target, layer);
        } else {
            seeThrough.push_back(&layer);
        }
    }
    // A layer that is not solid is hidden by solid ones and by itself, not by others that are not solid.
    const bool several = seeThrough.size() > 1;
    if (several) copyDepth(target, target.framebuffer, depthStore(target).name());
    for (const Layer* layer : seeThrough) {
        if (several && layer != seeThrough.front()) copyDepth(target, store_.name(), target.framebuffer);
        drawSeeThrough(target, *layer);
    }
    for (const GLenum state : {GL_BLEND, GL_DEPTH_TEST, GL_POLYGON_OFFSET_FILL, GL_SCISSOR_TEST, GL_CLIP_DISTANCE0}) {
        api_.Disable(state);
    }
}

/// Sets the needed state of the context, and clears the target.
void Renderer::prepare(const Target& target, const Look& look) const
{
    for (const GLenum state : {GL_CULL_FACE, GL_STENCIL_TEST}) api_.Disable(state);
    for (const GLenum state : {GL_BLEND, GL_DEPTH_TEST, GL_POLYGON_OFFSET_FILL, GL_SCISSOR_TEST, GL_MULTISAMPLE}) {
        api_.Enable(state);
    }
    if (look.section) {
        api_.Enable(GL_CLIP_DISTANCE0);
    } else {
        api_.Disable(GL_CLIP_DISTANCE0);
    }
    // Colours in the framebuffer are multiplied by their alpha.
    api_.BlendFuncSeparate(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
    api_.StencilFunc(GL_EQUAL, 0, 0xFF);
    api_.StencilOp(GL_KEEP, GL_KEEP, GL_INCR);
    api_.ColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    api_.DepthMask(GL_TRUE);

    api_.BindFramebuffer(GL_FRAMEBUFFER, target.framebuffer);
    api_.Viewport(target.left, target.bottom, target.width, target.height);
    api_.Scissor(target.left, target.bottom, target.width, target.height);
    const float opacity = look.backgroundOpacity;
    const std::array<float, 4> clear{opacity * look.background[0], opacity * look.background[1],
                                     opacity * look.background[2], opacity};
    api_.ClearNamedFramebufferfv(target.framebuffer, GL_COLOR, 0, clear.data());
    api_.ClearNamedFramebufferfi(target.framebuffer, GL_DEPTH_STENCIL, 0, 1, 0);
}

/// Sets the view in the programs.
void Renderer::aim(const Target& target, const Look& look) const
{
    const Eye& eye = look.eye;
    const Matrix toClip = clipMatrix(eye, look.crop);
    // If there is no section nothing is cut off; Mesa's software drivers use the shader's distances even when told not
    // to.
    const Vec3d sectionNormal = look.section ? look.section->normal : Vec3d(0);
    const double sectionShift = look.section ? sectionNormal.dot(eye.origin) - look.section->offset : 1;
    for (const gl::ProgramObject* program : {&surface_, &tint_, &line_}) {
        set(*program, "toClip", toClip);
        set(*program, "origin", eye.origin, 0);
        set(*program, "section", sectionNormal, sectionShift);
    }
    set(surface_, "toView", viewMatrix(eye));
    set(line_, "eye", eye.viewpoint - eye.origin, liftOf(eye));
    api_.ProgramUniform2f(line_.name(), gl::uniformLocation(api_, line_, "viewport"), static_cast<float>(target.width),
                          static_cast<float>(target.height));
}

void Renderer::drawSolid(const Target& target, const Layer& layer) const
{
    drawFaces(facesProgram(layer), layer, 1, GL_LESS, layer.edges ? target.pixelScale : 0);
    if (!layer.edges) return;
    if (layer.edges->hiddenOpacity > 0) {
        drawEdges(target, *layer.shape, *layer.edges, layer.edges->hiddenOpacity, GL_GREATER);
    }
    drawEdges(target, *layer.shape, *layer.edges, layer.edges->opacity, GL_LEQUAL);
}

void Renderer::drawSeeThrough(const Target& target, const Layer& layer) const
{
    api_.ColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
    drawFaces(tint_, layer, 0, GL_LESS, layer.edges ? 2 * target.pixelScale : 0);
    api_.ColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    const bool flagged = layer.shape->looks().name() != 0 && layer.flagOpacity > 0;
    if (layer.opacity > 0 || flagged) {
        once(target, [&] { drawFaces(facesProgram(layer), layer, layer.opacity, GL_LEQUAL, 0); });
    }
    if (!layer.edges) return;
    if (layer.edges->hiddenOpacity > 0) {
        drawEdges(target, *layer.shape, *layer.edges, layer.edges->hiddenOpacity, GL_GREATER);
    }
    drawEdges(target, *layer.shape, *layer.edges, layer.edges->opacity, GL_LEQUAL);
}

/// `setBack`: the pixels' worth of their slope by which the faces step back behind their lines.
void Renderer::drawFaces(const gl::ProgramObject& program, const Layer& layer, float opacity, GLenum depthTest,
                         int setBack) const
{
    const Shape& shape = *layer.shape;
    const bool hasLooks = shape.looks().name() != 0;
    api_.PolygonOffset(static_cast<float>(setBack), static_cast<float>(setBack));
    set(program, "colour", layer.colour, opacity);
    set(program, "quadColour", layer.quadColour.value_or(layer.colour), opacity);
    set(program, "markedColour", layer.markedColour, layer.flagOpacity);
    set(program, "selectedColour", layer.selectedColour, layer.flagOpacity);
    set(program, "triangleCount", static_cast<int>(shape.geometry().triangleCount()));
    set(program, "hasLooks", hasLooks ? 1 : 0);
    if (hasLooks) api_.BindTextureUnit(0, shape.looks().name());
    api_.DepthFunc(depthTest);
    api_.UseProgram(program.name());
    shape.drawFaces();
}

void Renderer::drawEdges(const Target& target, const Shape& shape, const Edges& edges, float opacity,
                         GLenum depthTest) const
{
    const double lineWidth = target.lineWidth * target.pixelScale;
    set(line_, "colour", edges.colour, opacity);
    set(line_, "width", edges.relativeWidth * lineWidth);
    set(line_, "fadeLength", edges.relativeFadeLength * lineWidth);
    api_.DepthFunc(depthTest);
    api_.DepthMask(GL_FALSE);
    api_.UseProgram(line_.name());
    once(target, [&] { shape.drawEdges(); });
    api_.DepthMask(GL_TRUE);
}

/// Makes `draw` cover each sample at most once, so that lines do not darken where they meet.
template <typename Draw>
void Renderer::once(const Target& target, const Draw& draw) const
{
    const GLint zero = 0;
    api_.ClearNamedFramebufferiv(target.framebuffer, GL_STENCIL, 0, &zero);
    api_.Enable(GL_STENCIL_TEST);
    draw();
    api_.Disable(GL_STENCIL_TEST);
}

void Renderer::copyDepth(const Target& target, GLuint from, GLuint to) const
{
    const int right = target.left + target.width;
    const int top = target.bottom + target.height;
    api_.BlitNamedFramebuffer(from, to, target.left, target.bottom, right, top, target.left, target.bottom, right, top,
                              GL_DEPTH_BUFFER_BIT, GL_NEAREST);
}

/// Returns a framebuffer for depths of the target; it may be larger.
const gl::Framebuffer& Renderer::depthStore(const Target& target)
{
    const int width = target.left + target.width;
    const int height = target.bottom + target.height;
    if (width > storeWidth_ || height > storeHeight_ || target.samples != storeSamples_) {
        storeSamples_ = 0; // no samples, in case this throws
        store_ = gl::Framebuffer();
        storedDepth_ = gl::makeTexture2D(api_, GL_DEPTH24_STENCIL8, width, height, target.samples);
        store_ = gl::makeFramebuffer(api_, gl::Texture(), storedDepth_);
        storeWidth_ = width;
        storeHeight_ = height;
        storeSamples_ = target.samples;
    }
    return store_;
}

void Renderer::set(const gl::ProgramObject& program, const char* name, double value) const
{
    api_.ProgramUniform1f(program.name(), gl::uniformLocation(api_, program, name), static_cast<float>(value));
}

void Renderer::set(const gl::ProgramObject& program, const char* name, int value) const
{
    api_.ProgramUniform1i(program.name(), gl::uniformLocation(api_, program, name), value);
}

void Renderer::set(const gl::ProgramObject& program, const char* name, const Matrix& value) const
{
    api_.ProgramUniformMatrix4fv(program.name(), gl::uniformLocation(api_, program, name), 1, GL_FALSE, value.data());
}

void Renderer::set(const gl::ProgramObject& program, const char* name, const Vec3d& value, double last) const
{
    api_.ProgramUniform4f(program.name(), gl::uniformLocation(api_, program, name), static_cast<float>(value.x()),
                          static_cast<float>(value.y()), static_cast<float>(value.z()), static_cast<float>(last));
}

void Renderer::set(const gl::ProgramObject& program, const char* name, const Colour& colour, float opacity) const
{
    api_.ProgramUniform4f(program.name(), gl::uniformLocation(api_, program, name), colour[0], colour[1], colour[2],
                          opacity);
}

} // namespace vdbcage::draw
