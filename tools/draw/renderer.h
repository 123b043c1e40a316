#pragma once

#include <optional>
#include <vector>

#include <tools/draw/camera.h>
#include <tools/draw/colour.h>
#include <tools/draw/shape.h>
#include <vdbcage/gl/objects.h>

namespace vdbcage::draw {

/// The look of a layer's edges: lines of constant width.
struct Edges {
    Colour colour{};
    float opacity = 1;             ///< in [0, 1]
    float hiddenOpacity = 0.16F;   ///< of parts behind solid layers or the layer's own faces, in [0, 1]
    double relativeWidth = 1;      ///< > 0; 1: Target::lineWidth
    double relativeFadeLength = 0; ///< edges shorter than this many line widths fade out; 0: none do
};

/// A shape and its look.
struct Layer {
    const Shape* shape = nullptr; ///< not owned
    bool visible = true;
    bool shaded = true; ///< faces are lit; else of their plain colour, without colours of points
    Colour colour{0.88F, 0.855F, 0.815F};
    std::optional<Colour> quadColour; ///< of quads; none: `colour`
    /// Opacity of faces, in [0, 1]. 1 makes a solid layer, which hides everything behind it. Other layers show only
    /// their nearest faces; they hide no other layer and are drawn over solid ones, in the layers' order. At 0 faces
    /// are invisible but hide the layer's own edges.
    float opacity = 1;
    std::optional<Edges> edges; ///< none: no edges
    /// The colours of faces with these flags, and the least opacity that they have in layers that are not solid.
    Colour markedColour{0.86F, 0.16F, 0.12F}, selectedColour{1.0F, 0.62F, 0.12F};
    float flagOpacity = 0.6F;
};

/// A plane that cuts off all layers where normal . p < offset, in drawing coordinates, which opens their inside.
struct Section {
    openvdb::Vec3d normal{1, 0, 0}; ///< not zero
    double offset = 0;
};

/// A rectangle of a framebuffer, in its pixels. The framebuffer must be of GL_RGBA8 and GL_DEPTH24_STENCIL8.
struct Target {
    GLuint framebuffer = 0; ///< OpenGL's name
    int left = 0, bottom = 0, width = 0, height = 0;
    int samples = 1;        ///< per pixel of the framebuffer
    double lineWidth = 1.1; ///< pixels of the picture
    int pixelScale = 1;     ///< pixels of the framebuffer per pixel of the picture, each way
};

/// The eye, the part of the panel, the background and the section of a picture.
struct Look {
    Eye eye;
    /// The part of the panel that fills the target. Frames shifted by parts of a pixel can be averaged.
    Crop crop = {};
    Colour background{1, 1, 1};
    float backgroundOpacity = 1; ///< in [0, 1]; colours in the framebuffer are multiplied by their alpha
    std::optional<Section> section = std::nullopt;
};

/// A renderer of layers by OpenGL 4.5. Its context must be current in each call, and must outlive it.
class Renderer {
public:
    /// Compiles the shaders. \throw DeviceError
    explicit Renderer(const gl::Api& api);

    /// Clears the target and draws the visible layers: solid ones first, in any order; then the others in the given
    /// order. It assumes no state of the context; after it, blending and all tests are off, and bound are its own
    /// framebuffer, program and arrays. The same call makes the same bytes on one machine.
    /// \throw DeviceError if memory for depths is needed (two layers that are not solid) and is not available. The
    /// caller must ask for other failures (gl::throwIfFailed), which waits for the device.
    void draw(const Target& target, const Look& look, const std::vector<Layer>& layers);

private:
    void prepare(const Target& target, const Look& look) const;
    void aim(const Target& target, const Look& look) const;
    void drawSolid(const Target& target, const Layer& layer) const;
    void drawSeeThrough(const Target& target, const Layer& layer) const;
    void drawFaces(const gl::ProgramObject& program, const Layer& layer, float opacity, GLenum depthTest,
                   int setBack) const;
    void drawEdges(const Target& target, const Shape& shape, const Edges& edges, float opacity, GLenum depthTest) const;
    template <typename Draw>
    void once(const Target& target, const Draw& draw) const;
    void copyDepth(const Target& target, GLuint from, GLuint to) const;
    const gl::Framebuffer& depthStore(const Target& target);

    const gl::ProgramObject& facesProgram(const Layer& layer) const { return layer.shaded ? surface_ : tint_; }
    void set(const gl::ProgramObject& program, const char* name, double value) const;
    void set(const gl::ProgramObject& program, const char* name, int value) const;
    void set(const gl::ProgramObject& program, const char* name, const Matrix& value) const;
    void set(const gl::ProgramObject& program, const char* name, const openvdb::Vec3d& value, double last) const;
    void set(const gl::ProgramObject& program, const char* name, const Colour& colour, float opacity) const;

    const gl::Api& api_;
    gl::ProgramObject surface_, tint_, line_;
    // Depths of solid layers, kept for the next frame.
    int storeWidth_ = 0, storeHeight_ = 0, storeSamples_ = 0;
    gl::Texture storedDepth_;
    gl::Framebuffer store_;
};

} // namespace vdbcage::draw
