#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include <tools/draw/camera.h>
#include <tools/draw/colour.h>
#include <tools/edit/elements.h>
#include <tools/view/state/opened_mesh.h>
#include <tools/view/state/opened_weights.h>
#include <tools/view/state/time_line.h>
#include <vdbcage/bounding/fit.h>
#include <vdbcage/deform/coordinates.h>
#include <vdbcage/mesh/symmetry.h>
#include <vdbcage/pipeline/options.h>

/// Everything that a user of the window can change. Values: a copy is a snapshot, and costs a few hundred bytes, since
/// large parts never change and are shared.
namespace vdbcage::view {

/// The user's work: undo and redo act on it.
struct Document {
    OpenedMeshPtr model; ///< null: none
    CageOptions options;
    OpenedMeshPtr cage;                        ///< opened or edited; null: the cage is made, by the options
    std::vector<openvdb::Index32> locked;      ///< points of `cage` that stay in fits and motions, ascending
    bool isFitted = false;                     ///< shown is what fitCage() makes of `cage`
    double tightness = FitOptions().tightness; ///< of the last fit, in FitOptions::tightnesses
    TimeLine poses;
    Coordinates coordinates = Coordinates::meanValue; ///< by which the model follows the pose
    WeightsPtr weights;                               ///< where the coordinates are given; else null
    Elasticity elasticity;                            ///< of Somigliana coordinates; weights do not depend on it

    /// Sets `cage`, neither fitted nor with locked points.
    void setCage(OpenedMeshPtr opened)
    {
        cage = std::move(opened);
        locked.clear();
        isFitted = false;
    }
};

/// The layers of the picture.
enum class LayerId : std::uint8_t {
    model,
    solid,       ///< the exposed faces of the model's voxels
    solidNodes,  ///< boxes of the nodes of the solid's tree
    closed,      ///< the exposed faces of the closing's voxels
    closedNodes, ///< boxes of the nodes of the closing's tree
    surface,     ///< the surface that the cage was made from
    smoothed,    ///< the cage after smoothing; if bounding is off, the surface after it
    decimated,   ///< the cage before its triangles were paired and the last changes
    cage
};
constexpr std::size_t layerCount = 9;

/// Returns its name in commands, such as "solid-nodes".
const char* nameOf(LayerId layer);
/// \throw InputError naming all layers: none has that name
LayerId layerNamed(const std::string& name);

struct LayerLook {
    bool shown = false;
    double opacity = 1;    ///< of faces, in [0, 1]
    draw::Colour colour{}; ///< of faces; of the cage's lines
};
inline bool operator==(const LayerLook& a, const LayerLook& b)
{
    return a.shown == b.shown && a.opacity == b.opacity && a.colour == b.colour;
}

/// The colours of the cage's faces. Faces in contact with the model, or bad otherwise, are red in each.
enum class CageColours : std::uint8_t {
    plain,
    kinds,   ///< differ for quads and triangles
    distance ///< show the distance from the cage to the model
};
inline constexpr std::array<const char*, 3> cageColourNames{"plain", "kinds", "distance"};
/// Names of draw::Projection.
inline constexpr std::array<const char*, 2> projectionNames{"perspective", "orthographic"};

/// The surfaces that are edited.
enum class Mode : std::uint8_t {
    shape, ///< the cage at rest, without the model
    pose   ///< the cage with the model
};
/// The action of the left button in the picture, beside selecting.
enum class Tool : std::uint8_t { select, move, rotate, scale };
/// The axes along which things are moved, turned and scaled.
enum class Orientation : std::uint8_t {
    world,
    local,  ///< the principal axes of the selection
    normal, ///< z is the mean normal of the selection
    view    ///< right, up and to the viewer
};
/// The point that things are turned about and scaled from.
struct Pivot {
    enum class Kind : std::uint8_t {
        mean,   ///< of the selected points
        box,    ///< the middle of their bounding box
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
/// Names of the kinds that need no numbers.
inline constexpr std::array<const char*, 3> pivotNames{"mean", "box", "origin"};

/// Changes of the cage's faces.
enum class CageEdit : std::uint8_t {
    split,    ///< edges in the middle
    collapse, ///< edges to their middle
    flip,     ///< edges of two triangles
    merge,    ///< two triangles beside an edge into a quad
    cut       ///< quads into triangles
};
inline constexpr std::array<const char*, 5> cageEditNames{"split", "collapse", "flip", "merge", "cut"};
inline constexpr std::array<const char*, 2> modeNames{"shape", "pose"};
inline constexpr std::array<const char*, 4> toolNames{"select", "move", "rotate", "scale"};
inline constexpr std::array<const char*, 4> orientationNames{"world", "local", "normal", "view"};

/// The colours of the model in mode pose, once it is bound.
enum class ModelColours : std::uint8_t {
    plain,
    influence, ///< show how far it follows the selection
    stretch,   ///< show how much longer or shorter lengths are than at rest
    inverted   ///< mark triangles that are inside out
};
inline constexpr std::array<const char*, 4> modelColourNames{"plain", "influence", "stretch", "inverted"};

/// A plane that cuts off all points with normal . p > offset, in world space.
struct SectionPlane {
    openvdb::Vec3d normal{1, 0, 0}; ///< not zero
    double offset = 0;
};
inline bool operator==(const SectionPlane& a, const SectionPlane& b)
{
    return a.normal == b.normal && a.offset == b.offset;
}

/// The view of the document. It has a history of its own, apart from undo.
struct ViewState {
    draw::Camera camera; ///< in drawing coordinates of the model's frame
    std::array<LayerLook, layerCount> layers = defaultLayers();
    CageColours cageColours = CageColours::kinds;
    ModelColours modelColours = ModelColours::plain;
    std::optional<SectionPlane> section;
    bool ground = true;     ///< a grid below the model
    bool axes = true;       ///< small ones in a corner
    bool turntable = false; ///< the camera turns by itself
    bool times = true;      ///< durations are shown, which differ from run to run
    Mode mode = Mode::shape;
    Tool tool = Tool::select;
    Orientation orientation = Orientation::world;
    Pivot pivot;
    bool seeThrough = false;             ///< hidden elements are selected too
    double softRadius = 0;               ///< of soft selection, a part of the model's longest side; 0: off
    std::optional<SymmetryPlane> mirror; ///< changes on one side are made on the other too
    edit::Selection selection;           ///< of the cage
    std::optional<Coordinates> compared; ///< a second picture has the model by this family
    int frame = 0;                       ///< of the pose that is shown and changed, 0 to lastFrame
    bool isPlaying = false;              ///< frames follow each other
    double framesPerSecond = 24;         ///< while playing, in [1, 240]

    const LayerLook& layer(LayerId id) const { return layers[static_cast<std::size_t>(id)]; }
    LayerLook& layer(LayerId id) { return layers[static_cast<std::size_t>(id)]; }

    static std::array<LayerLook, layerCount> defaultLayers();

    /// Returns all fields, for comparison.
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

/// Values are equal if their texts are; models if they are the same object, since one that was read again may differ.
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
