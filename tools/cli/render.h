#pragma once

#include <vector>

#include <tools/draw/camera.h>
#include <tools/draw/colour.h>
#include <tools/draw/picture.h>
#include <vdbcage/mesh/mesh.h>

namespace vdbcage {

using draw::Colour;
using draw::Picture;
using draw::UpAxis;
using draw::View;

enum class LayerStyle {
    shaded,    ///< a solid surface, smooth across edges of less than 40 degrees
    wireframe, ///< every edge once, a quad without its diagonal; faint behind solid layers or its own faces
    voxels,    ///< a solid surface of flat faces with faint edges
};

/// One mesh of a panel.
struct Layer {
    const Mesh* mesh = nullptr; ///< not owned
    LayerStyle style = LayerStyle::shaded;
    Colour colour{};   ///< of the faces, or of a wireframe's lines
    float tint = 0.0F; ///< opacity of a wireframe's faces in [0, 1], 0: none
    /// For a solid surface, a factor of `colour` for each point of the mesh; empty: none.
    std::vector<Colour> pointColours = {};
};

/// Styles for a clay model, a cage around it, and voxels.
inline Layer shadedLayer(const Mesh& mesh)
{
    return {&mesh, LayerStyle::shaded, {0.88F, 0.855F, 0.815F}, 0};
}
inline Layer wireframeLayer(const Mesh& mesh)
{
    return {&mesh, LayerStyle::wireframe, {0.10F, 0.22F, 0.48F}, 0.08F};
}
inline Layer voxelsLayer(const Mesh& mesh)
{
    return {&mesh, LayerStyle::voxels, {0.96F, 0.80F, 0.56F}, 0};
}

/// The content of a picture: panels, each with its layers drawn over each other, filled row by row.
struct Scene {
    std::vector<std::vector<Layer>> panels; ///< at least one, each with at least one layer
    int columns = 0;                        ///< of the grid of panels; 0: the number that makes the panels largest
    bool sameView = false;                  ///< one eye for all panels, to compare them; else each is fitted
    View view;
    Colour background{1, 1, 1};
};

/// The largest width and height of a picture, in pixels.
constexpr int maximumPictureSize = 16384;

/// Draws the scene in mild perspective, fitted to all points of its layers, whatever their size and place; needs no
/// display. The same scene makes the same bytes on one machine. It takes about 1 s for a megapixel and 100,000 faces in
/// software.
/// \throw InputError if the scene is empty, a mesh cannot be used (see `requireUsable`) or a value is out of range;
/// DeviceError if there is no OpenGL 4.5
Picture renderScene(const Scene& scene, int width, int height);

} // namespace vdbcage
