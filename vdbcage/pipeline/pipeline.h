#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <vdbcage/check/check.h>
#include <vdbcage/core/export.h>
#include <vdbcage/core/grids.h>
#include <vdbcage/core/interrupter.h>
#include <vdbcage/mesh/mesh.h>
#include <vdbcage/mesh/symmetry.h>
#include <vdbcage/pipeline/memory.h>
#include <vdbcage/pipeline/options.h>

namespace vdbcage {

/// The start that a bounding cage was shrunk from.
enum class CageStart {
    closing,     ///< the surface of the closing
    hull,        ///< the surface of its convex hull: no closing allowed as few faces (or one cage)
    orientedBox, ///< the box around the model along its own axes
    tetrahedron, ///< one around that box
    box          ///< nothing: it is the model's bounding box (below 12 triangles a tetrahedron), as nothing tighter was
                 ///< certified
};

/// How a cage came about, beside the cage itself.
struct CageReport {
    CageCheck check;        ///< the verdict on the cage as it is returned, with measures
    bool floatSafe = false; ///< its coordinates are floats, and the cage also bounds the model rounded to float
    int resolution = 0;     ///< voxels along the longest side, as given, a half of it that is tighter, or chosen
    VoxelizeReport voxels;  ///< what made the voxels
    double closeRadius = 0; ///< fraction of the longest side, as given or chosen
    double erodeRadius = 0; ///< the same
    std::optional<double> minAngle;       ///< degrees, as given or chosen; bounding only
    std::optional<double> mergeAngle;     ///< the same, of CageFaces::triquad and CageFaces::quads
    int smooth = 0;                       ///< sweeps, as given or chosen
    double offsetVoxels = 0;              ///< by how much all of the closing was grown to keep the clearance
    CageStart start = CageStart::closing; ///< what it was shrunk from
    std::optional<Symmetry> symmetry; ///< the plane in which the cage is exactly symmetric, and how far the model is
    /// If the plane lies across no axis: the cage is symmetric in it but for the rounding of its coordinates.
    std::optional<TiltedSymmetry> tiltedSymmetry;
    std::string noSymmetry;        ///< why there is none; empty if there is, or it was not asked for
    bool repaired = false;         ///< an unguarded cage was not valid and went through repair()
    std::size_t partsLeftOut = 0;  ///< of the model, smaller than CageOptions::leastPart: it bounds the others
    std::size_t facesLeftOut = 0;  ///< the model's triangles and quads in these
    double leastPartSide = 0;      ///< the longest side that was asked of a part, world units
    std::vector<std::string> plan; ///< what the search tried, a line for each kind of cage that competed; bounding only
    double sideShare = 1;          ///< of the longest side, that voxels and radii of `auto` were chosen for
    std::size_t startFaces = 0;    ///< of what it was shrunk from
    std::size_t cavitiesFilled = 0; ///< hollows inside the closing that were filled
    std::size_t solidParts = 0;     ///< separate surfaces of the model's voxels, inner ones too
    std::int64_t solidHandles = 0;  ///< and handles, tunnels through them, of all of them
    std::size_t modelHollows = 0;   ///< hollows of the model (CageChecker::hollows), which became solid
    std::size_t parts = 0;          ///< separate surfaces of what the cage was made from: the closing, grown a little
    std::int64_t handles = 0;       ///< tunnels through the surface that the cage was made from
    std::size_t solidVoxels = 0;    ///< of the model
    std::size_t closedVoxels = 0;   ///< of its closing, cavities filled
};

/// From a model to its cage, keeping every intermediate. Running again with other options starts from the first stage
/// that they touch: another face count or smoothness needs no new voxels and no new closing.
///
/// With CageOptions::bounding the surface of the closing is shrunk, decimated and tightened under a BoundingGuard. The
/// cage is then certified by CageChecker, other code than the guard's, on its coordinates as they are returned. It is
/// examined against the model as given and, where its coordinates are floats, as rounded to float. A cage that is not
/// certified is never returned.
///
/// The closing may have too many parts and handles for the faces. If its radius and resolution are not given, it is
/// closed more, then voxelized more coarsely. Where that is not enough, the cage is shrunk from the closing's convex
/// hull. The last resort is the model's bounding box; CageReport::floatSafe says whether it also bounds as floats. So
/// there are never more faces than asked for. Effort::fast takes a coarser resolution where the surface is large.
///
/// Few faces are begun with several resolutions side by side, and the tightest cage is kept. So are a resolution that
/// is given and its halves. Up to 150 faces, what the
/// lower efforts give competes as well, and the box around the model along its own axes, tightened; below 12 triangles
/// a tetrahedron, too. So no effort gives looser cages than a lower one there. Where the box lies on the model, within
/// the clearance as closely as other cages, it is the cage. Up to 24 faces loops compete with other quads, but not with
/// Effort::fast. Loops are also begun with voxels along the model's own axes, where these have a smaller surface.
/// These axes are those along which the model's faces lie flattest.
/// Beyond 150 faces boxes and cages of fewer faces compete where the cage lies on the model, or some of its places are
/// much farther away than most.
///
/// Where a plane of symmetry is found or given, voxels are united with their mirror image. Everything after is done on
/// one half, under a guard that knows the plane. The cage is then symmetric, point for point and face for face: exactly
/// where the plane lies across an axis, else but for rounding. It has an edge wherever it meets the plane, and bounds
/// the mirror image of the model too. If no such cage has few enough faces, one without symmetry is made, and the
/// report says so.
class VDBCAGE_API Pipeline {
public:
    /// Checks the model and keeps it; nothing is made yet.
    /// \throw InputError the model has no usable face (see requireUsable)
    explicit Pipeline(Mesh model);
    ~Pipeline();
    /// The other can only be assigned to or destroyed afterwards.
    Pipeline(Pipeline&&) noexcept;
    /// The other can only be assigned to or destroyed afterwards.
    Pipeline& operator=(Pipeline&&) noexcept;

    /// Makes the cage for `options` and returns it; valid until the next run. A run that throws leaves the cage and the
    /// intermediates of the last one that did not.
    ///
    /// Reports stages to `interrupter`, some more than once: of StageName, those from interior to certify. The cage can
    /// have fewer faces than asked. It has more only where the topology of the closing does not allow fewer and
    /// `bounding` is off.
    /// \throw InputError what requireValid, voxelize or closeMask refuses; float32 is asked for and rounds by more than a
    /// thousandth of the longest side; the model misses the plane of symmetry that
    /// is asked for by more than 0.3 of its longest side
    /// \throw MemoryError a process that makes this cage would hold more than `memoryLimit` bytes, as predictedMemory()
    /// predicts; with unlimitedMemory nothing is predicted
    /// \throw DeviceError the voxelizer asked for is missing or fails
    /// \throw Error the cage could not be certified, which is a defect of vdbcage
    /// \throw Cancelled
    const Mesh& run(const CageOptions& options, Interrupter* interrupter = nullptr,
                    std::size_t memoryLimit = unlimitedMemory);

    /// The model as it was given.
    const Mesh& model() const;

    /// \name Of the last run; valid until the next
    /// \{

    /// The voxelized model; null before the first run. Its voxels lie along x, y and z, or along a plane of symmetry
    /// that lies across none of them.
    std::shared_ptr<const openvdb::MaskGrid> solid() const;
    /// The closing of solid(), cavities filled; null before the first run.
    std::shared_ptr<const openvdb::MaskGrid> closed() const;
    const Mesh& surface() const; ///< what the cage was made from: quads, or a tetrahedron
    /// The result of smoothing: the cage, before edges that are almost flat are bent. Bounding off: the surface.
    const Mesh& smoothed() const;
    /// The surface with fewer faces. Triangles, about twice the faces where pairs become quads; of loops the cage
    /// before smoothing; of a box its quads.
    const Mesh& decimated() const;
    const Mesh& cage() const;         ///< what run() returned; without faces before the first run
    const CageReport& report() const; ///< how that cage came about
    /// \}

private:
    class Impl;
    std::unique_ptr<Impl> impl_;
};

/// Makes one cage of one model, as `Pipeline(model).run(options)` does. What most callers need.
///
/// With the default options the cage has at most 400 triangles. It is certified to bound the model, or this throws.
/// \throw InputError as Pipeline and run()
/// \throw DeviceError as run()
/// \throw Error as run()
/// \throw Cancelled
VDBCAGE_API Mesh makeCage(const Mesh& model, const CageOptions& options = {}, Interrupter* interrupter = nullptr);

} // namespace vdbcage
