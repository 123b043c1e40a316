#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <tuple>
#include <vector>

#include <tools/draw/camera.h>
#include <tools/draw/colour.h>
#include <tools/edit/elements.h>
#include <tools/view/state/opened_mesh.h>
#include <tools/view/state/time_line.h>
#include <vdbcage/mesh/symmetry.h>
#include <vdbcage/pipeline/options.h>

/// Everything that a user of the window can change. Values: a copy is a snapshot, and costs a few hundred bytes, since
/// what is large never changes and is shared.
namespace vdbcage::view {

/// What one works on: undo and redo are about this.
struct Document {
    OpenedMeshPtr model; ///< null: none
    CageOptions options;
    OpenedMeshPtr cage; ///< a cage that was opened or edited; null: it is made, by the options
    TimeLine poses;
    Coordinates coordinates = Coordinates::meanValue; ///< by which the model follows the pose
    WeightsPtr weights;                               ///< where the coordinates are given; else null
    Elasticity elasticity;                            ///< of Somigliana coordinates; weights do not depend on it
};

/// What can be seen, each in a layer of its own.
enum class LayerId : std::uint8_t {
    model,
    solid,       ///< the exposed faces of the model's voxels
    solidNodes,  ///< boxes of the nodes of their tree
    closed,      ///< the exposed faces of the closing's voxels
    closedNodes, ///< boxes of the nodes of its tree
    surface,     ///< what the cage was made from
    smoothed,    ///< the cage after smoothing; where bounding is off, the surface after it
    decimated,   ///< the cage before its triangles were merged and the last touches
    cage
};
constexpr std::size_t layerCount = 9;

/// Its name in commands, such as "solid-nodes".
const char* nameOf(LayerId layer);
/// \throw InputError naming all of them: there is none of that name
LayerId layerNamed(const std::string& name);

struct LayerLook {
    bool shown = false;
    double opacity = 1;    ///< of faces, in [0, 1]
    draw::Colour colour{}; ///< of faces; of the cage, of lines
};
inline bool operator==(const LayerLook& a, const LayerLook& b)
{
    return a.shown == b.shown && a.opacity == b.opacity && a.colour == b.colour;
}

/// By what the cage's faces are coloured. Faces that are in contact with the model or bad otherwise are red in each.
enum class CageColours : std::uint8_t {
    plain,
    kinds,   ///< quads and triangles are told apart
    distance ///< from the cage to the model
};
inline constexpr std::array<const char*, 3> cageColourNames{"plain", "kinds", "distance"};
/// Of draw::Projection.
inline constexpr std::array<const char*, 2> projectionNames{"perspective", "orthographic"};

/// What is moved.
enum class Mode : std::uint8_t {
    shape, ///< the cage at rest, without the model
    pose   ///< the cage with the model
};
/// What the left button does in the picture, beside selecting.
enum class Tool : std::uint8_t { select, move, rotate, scale };
/// Along which axes things are moved, turned and scaled.
enum class Orientation : std::uint8_t {
    world,
    local,  ///< the principal axes of what is selected
    normal, ///< z is the mean normal of what is selected
    view    ///< right, up and to the viewer
};
/// What things are turned about and scaled from.
struct Pivot {
    enum class Kind : std::uint8_t {
        mean,   ///< of the selected points
        box,    ///< the middle of the box around them
        origin, ///< of the world
        point
    };
    Kind kind = Kind::mean;
    openvdb::Vec3d point{0}; ///< world space; 0 unless the kind is point
};
inline bool operator==(const Pivot& a, const Pivot& b)
{
    return a.kind == b.kind && a.point == b.point;
}
/// Of the kinds that need no numbers.
inline constexpr std::array<const char*, 3> pivotNames{"mean", "box", "origin"};

/// Changes of the cage's faces.
enum class CageEdit : std::uint8_t {
    split,    ///< edges in the middle
    collapse, ///< edges to their middle
    flip,     ///< edges of two triangles
    merge,    ///< two triangles beside an edge to a quad
    cut       ///< quads to triangles
};
inline constexpr std::array<const char*, 5> cageEditNames{"split", "collapse", "flip", "merge", "cut"};
inline constexpr std::array<const char*, 2> modeNames{"shape", "pose"};
inline constexpr std::array<const char*, 4> toolNames{"select", "move", "rotate", "scale"};
inline constexpr std::array<const char*, 4> orientationNames{"world", "local", "normal", "view"};

/// By what the model is coloured in mode pose, once it is bound.
enum class ModelColours : std::uint8_t {
    plain,
    influence, ///< how far it follows what is selected
    stretch,   ///< how much longer or shorter lengths are than at rest
    inverted   ///< triangles that are inside out
};
inline constexpr std::array<const char*, 4> modelColourNames{"plain", "influence", "stretch", "inverted"};

/// A plane that cuts off where normal . p > offset, in world space.
struct SectionPlane {
    openvdb::Vec3d normal{1, 0, 0}; ///< not zero
    double offset = 0;
};
inline bool operator==(const SectionPlane& a, const SectionPlane& b)
{
    return a.normal == b.normal && a.offset == b.offset;
}

/// How one looks at it. Undo is not about this; a history of its own is.
struct ViewState {
    draw::Camera camera; ///< in drawing coordinates of the model's frame
    std::array<LayerLook, layerCount> layers = defaultLayers();
    CageColours cageColours = CageColours::kinds;
    ModelColours modelColours = ModelColours::plain;
    std::optional<SectionPlane> section;
    bool ground = true;     ///< a grid below the model
    bool axes = true;       ///< small ones in a corner
    bool turntable = false; ///< it turns by itself
    bool times = true;      ///< how long what took, which is never the same twice
    Mode mode = Mode::shape;
    Tool tool = Tool::select;
    Orientation orientation = Orientation::world;
    Pivot pivot;
    bool seeThrough = false;             ///< what is hidden is selected too
    double softRadius = 0;               ///< of soft selection, a part of the model's longest side; 0: off
    std::optional<SymmetryPlane> mirror; ///< what is done on one side of it is done on the other too
    edit::Selection selection;           ///< of the cage
    std::optional<Coordinates> compared; ///< a second picture has the model by this family
    int frame = 0;                       ///< whose pose is seen and changed, 0 to lastFrame
    bool isPlaying = false;              ///< frames follow each other
    double framesPerSecond = 24;         ///< while it plays, in [1, 240]

    const LayerLook& layer(LayerId id) const { return layers[static_cast<std::size_t>(id)]; }
    LayerLook& layer(LayerId id) { return layers[static_cast<std::size_t>(id)]; }

    static std::array<LayerLook, layerCount> defaultLayers();

    /// All of it, to be compared.
    auto tied() const
    {
        return std::tie(camera, layers, cageColours, modelColours, section, ground, axes, turntable, times, mode, tool,
                        orientation, pivot, seeThrough, softRadius, mirror, selection, compared, frame, isPlaying,
                        framesPerSecond);
    }
};
inline bool operator==(const ViewState& a, const ViewState& b)
{
    return a.tied() == b.tied();
}
inline bool operator!=(const ViewState& a, const ViewState& b)
{
    return !(a == b);
}

struct State {
    Document document;
    ViewState view;
};

/// Values are compared as their text is; models by being the same object, since one that was read anew may differ.
bool areEqual(const CageOptions& a, const CageOptions& b);
bool operator==(const Document& a, const Document& b);
inline bool operator!=(const Document& a, const Document& b)
{
    return !(a == b);
}
inline bool operator==(const State& a, const State& b)
{
    return a.document == b.document && a.view == b.view;
}
inline bool operator!=(const State& a, const State& b)
{
    return !(a == b);
}

} // namespace vdbcage::view
