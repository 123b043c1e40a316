#pragma once

#include <optional>
#include <string>
#include <vector>

#include <tools/edit/motion.h>
#include <tools/view/state/state.h>

/// What is done with the selected points of the cage that is shown. Each function that returns the document after it
/// throws InputError where there is no cage, or nothing of it is selected.
namespace vdbcage::view {

/// The cage at rest. \throw InputError there is none
const MeshPtr& restOf(const ShownCage& cage);

/// A selection without what the cage does not have, as a script may name it.
edit::Selection withinCage(edit::Selection selection, const edit::Elements& elements);

/// The points that are selected, or belong to what is. They are numbers of points that the cage has.
std::vector<openvdb::Index32> selectedPoints(const Mesh& cage, const edit::Selection& selection);

/// By what the model follows the cage. \pre there is a model
BindOrder bindOrder(const Document& document, const MeshPtr& cage);

/// Where the cage's points are now: posed in mode pose, else at rest. Empty without a cage.
std::vector<openvdb::Vec3d> cagePoints(const State& state, const ShownCage& cage);

/// Where what is selected is moved, turned and scaled from, and along which axes.
struct SelectionFrame {
    openvdb::Vec3d origin{0};             ///< the view's pivot, world space
    openvdb::Vec3d mean{0};               ///< of the selected points, world space
    std::size_t count = 0;                ///< of the selected points
    std::array<openvdb::Vec3d, 3> axes{}; ///< orthonormal, right-handed
};
/// By the view's orientation and pivot; `view`: right, up and to the viewer. None: there is nothing to move, or poses
/// are still to be carried over to the cage.
std::optional<SelectionFrame> selectionFrame(const State& state, const ShownCage& cage,
                                             const std::array<openvdb::Vec3d, 3>& view);

/// Moves what is selected, and with it what soft selection and the mirror add. In mode pose the pose changes, else the
/// cage at rest.
/// \throw InputError also where a point would be no finite number, or farther away than 1e9 sizes of the cage
Document withMotion(const State& state, const ShownCage& cage, const edit::Motion& motion);

/// Changes the faces of the cage at rest: of what is selected, one after the other, as edit::splitEdge and the others.
/// Edges are those that are selected, or else those between selected points or faces.
/// \throw InputError also: the mode is not shape, or one of them cannot be changed so
Document withEdit(const State& state, const ShownCage& cage, CageEdit edit);

/// The pose of the view's frame undone: that of all points, or of those that are selected.
Document withResetPose(const State& state, const ShownCage& cage, bool onlySelected);

/// The pose of the view's frame is that in which the cage's points are at `points`.
/// \throw InputError not as many as the cage has, or one not finite
Document withPose(const State& state, const ShownCage& cage, std::vector<openvdb::Vec3d> points);

/// The pose that is seen at `frame` is a key there, with that name; none: with the one that it has.
Document withKey(const State& state, const ShownCage& cage, int frame, const std::optional<std::string>& name);

/// From rest at frame 0 to the pose of the view's frame at the last of `frames`; no other poses. \pre frames > 1
Document withInBetweens(const State& state, const ShownCage& cage, int frames);

} // namespace vdbcage::view
