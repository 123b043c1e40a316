#pragma once

#include <optional>
#include <string>
#include <vector>

#include <tools/edit/motion.h>
#include <tools/view/state/state.h>

/// Changes of the shown cage and its poses by hand, and the values that they begin from. Each function that returns a
/// document, the one after the change, throws InputError if there is no cage, or no part of it is selected.
namespace vdbcage::view {

/// Returns the cage at rest. \throw InputError there is none
const MeshPtr& restOf(const PosableCagePtr& cage);

/// Returns the selection except elements that the cage does not have, as a script may name them.
edit::Selection withinCage(edit::Selection selection, const edit::Elements& elements);

/// Returns the points that are selected or belong to selected elements. All are points of the cage.
std::vector<openvdb::Index32> selectedPoints(const Mesh& cage, const edit::Selection& selection);

/// Returns the present points of the cage: posed in mode pose, else at rest. Empty if there is no cage.
std::vector<openvdb::Vec3d> cagePoints(const State& state, const PosableCagePtr& cage);

/// The pivot and axes of the selection, for moving, turning and scaling.
struct SelectionFrame {
    openvdb::Vec3d origin{0};             ///< the view's pivot, world space
    openvdb::Vec3d mean{0};               ///< of the selected points, world space
    std::size_t count = 0;                ///< of the selected points
    std::array<openvdb::Vec3d, 3> axes{}; ///< orthonormal, right-handed
};
/// Returns them by the view's orientation and pivot; `view`: right, up and to the viewer. None: nothing is selected, or
/// poses are still to be carried over to the cage.
std::optional<SelectionFrame> selectionFrame(const State& state, const PosableCagePtr& cage,
                                             const std::array<openvdb::Vec3d, 3>& view);

/// Moves the selection, and the points that soft selection and the mirror add. In mode pose the pose changes, else the
/// cage at rest, of which locked points stay.
/// \throw InputError also if a point would not be finite, or farther away than 1e9 sizes of the cage, or if all selected
/// points are locked
Document withMotion(const State& state, const PosableCagePtr& cage, const edit::Motion& motion);

/// Fits the cage at rest: the opened or edited one, without an earlier fit of it, or else the shown one. Locked points
/// stay.
Document withFit(const State& state, const PosableCagePtr& cage, double tightness);

/// Locks or unlocks the selected points of the cage at rest. A fitted or made cage is an edited one from then on: its
/// points stay where they are seen.
/// \throw InputError also if the mode is not shape
Document withLocks(const State& state, const PosableCagePtr& cage, bool locks);

/// Changes the faces of the cage at rest by edit::splitEdge and the others, one selected element after the other. Edges
/// are the selected ones, or else those between selected points or faces.
/// \throw InputError also if the mode is not shape, an element cannot be changed so, or an edge to collapse has a locked
/// point
Document withEdit(const State& state, const PosableCagePtr& cage, CageEdit edit);

/// Undoes the pose of the view's frame: of all points, or of the selected ones.
Document withResetPose(const State& state, const PosableCagePtr& cage, bool onlySelected);

/// Sets the pose of the view's frame to the cage's points at `points`.
/// \throw InputError their number is not that of the cage's points, or one is not finite
Document withPose(const State& state, const PosableCagePtr& cage, std::vector<openvdb::Vec3d> points);

/// Makes the pose at `frame` a key there, with that name; none: with its present name.
Document withKey(const State& state, const PosableCagePtr& cage, int frame, const std::optional<std::string>& name);

/// Replaces all poses by a motion from rest at frame 0 to the pose of the view's frame at the last of `frames`.
/// \pre frames > 1
Document withInBetweens(const State& state, const PosableCagePtr& cage, int frames);

} // namespace vdbcage::view
