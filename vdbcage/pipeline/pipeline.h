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

/// The account of how a cage came about, beside the cage itself.
struct CageReport {
    CageCheck check;        ///< the verdict on the cage as it is returned, with measures
    bool floatSafe = false; ///< its coordinates are floats, and the cage also bounds the model rounded to float
    int resolution = 0;     ///< voxels along the longest side, as given, a half of it that is tighter, or chosen
    VoxelizeReport voxels;  ///< how the voxels were made
    double closeRadius = 0; ///< fraction of the longest side, as given or chosen
    double erodeRadius = 0; ///< the same
    std::optional<double> minAngle;       ///< degrees, as given or chosen; bounding only
    std::optional<double> mergeAngle;     ///< the same, of CageFaces::triquad and CageFaces::quads
    int smooth = 0;                       ///< sweeps, as given or chosen
    double offsetVoxels = 0;              ///< by how much all of the closing was grown to keep the clearance
    CageStart start = CageStart::closing; ///< the start that it was shrunk from
    std::optional<Symmetry> symmetry; ///< the plane in which the cage is exactly symmetric, and how far the model is
    /// If the plane lies across no axis: the cage is symmetric in it except for the rounding of its coordinates.
    std::optional<TiltedSymmetry> tiltedSymmetry;
    std::string noSymmetry;        ///< why there is none; empty if there is, or it was not asked for
    bool repaired = false;         ///< an unguarded cage was not valid and went through repair()
    std::size_t partsLeftOut = 0;  ///< of the model, smaller than CageOptions::leastPart: it bounds the others
    std::size_t facesLeftOut = 0;  ///< the model's triangles and quads in these
    double leastPartSide = 0;      ///< the longest side that was asked of a part, world units
    std::vector<std::string> plan; ///< the search's attempts, a line for each kind of cage that competed; bounding only
    double sideShare = 1;          ///< of the longest side, that voxels and radii of `auto` were chosen for
    std::size_t startFaces = 0;    ///< of the surface that it was shrunk from
    std::size_t cavitiesFilled = 0; ///< hollows inside the closing that were filled
    std::size_t solidParts = 0;     ///< separate surfaces of the model's voxels, inner ones too
    std::int64_t solidHandles = 0;  ///< and handles, tunnels through them, of all of them
    std::size_t modelHollows = 0;   ///< hollows of the model (CageChecker::hollows), which became solid
    std::size_t parts = 0;          ///< separate surfaces that the cage was made from: of the closing, grown a little
    std::int64_t handles = 0;       ///< tunnels through the surface that the cage was made from
    std::size_t solidVoxels = 0;    ///< of the model
    std::size_t closedVoxels = 0;   ///< of its closing, cavities filled
};

/// A pipeline from a model to its cages, which keeps every intermediate. A run with other options starts from the first
/// stage that they touch: another face count or smoothness needs no new voxels and no new closing.
///
/// With CageOptions::bounding a cage that is not certified is never returned. \ref pipeline describes the search.
class VDBCAGE_API Pipeline {
public:
    /// Checks the model and keeps it; nothing is made yet.
    /// \param model any polygon soup with a usable face
    /// \throw InputError when the model has no usable face (see requireUsable())
    explicit Pipeline(Mesh model);
    ~Pipeline();
    /// Takes over another pipeline, which can only be assigned to or destroyed afterwards.
    Pipeline(Pipeline&&) noexcept;
    /// Takes over another pipeline, which can only be assigned to or destroyed afterwards.
    Pipeline& operator=(Pipeline&&) noexcept;

    /// Makes the cage for some options. A run that throws leaves the results of the last one that did not.
    /// \param options as for requireValid(); without `bounding` the cage can have more faces, see \ref pipeline
    /// \param interrupter told of stages, some more than once: those of StageName from interior to certify; may be null
    /// \param memoryLimit bytes; unlimitedMemory, the default: nothing is predicted
    /// \return the cage, valid until the next run
    /// \throw InputError when requireValid(), voxelize() or closeMask() refuses something; when float32 is asked for
    /// and rounds by more than a thousandth of the longest side; when the model misses the plane of symmetry that is
    /// asked for by more than 0.3 of its longest side
    /// \throw MemoryError when a process that makes this cage would hold more, as predictedMemory() predicts
    /// \throw DeviceError when the voxelizer asked for is missing or fails
    /// \throw Error when the cage could not be certified, which is a defect of vdbcage
    /// \throw Cancelled when asked to stop
    const Mesh& run(const CageOptions& options, Interrupter* interrupter = nullptr,
                    std::size_t memoryLimit = unlimitedMemory);

    /// Returns the model as it was given.
    const Mesh& model() const;

    /// \name Of the last run; valid until the next
    /// \{

    /// Returns the voxelized model; null before the first run. Its voxels lie along x, y and z, or along a plane of
    /// symmetry that lies across none of them.
    std::shared_ptr<const openvdb::MaskGrid> solid() const;
    /// Returns the closing of solid(), cavities filled; null before the first run.
    std::shared_ptr<const openvdb::MaskGrid> closed() const;
    /// Returns the surface that the cage was made from: quads, or the triangles of a tetrahedron or of a box.
    const Mesh& surface() const;
    /// Returns the smoothed cage, before edges that are almost flat are bent; without `bounding` the smoothed surface.
    const Mesh& smoothed() const;
    /// Returns the surface with fewer faces. They are triangles, with `bounding` up to three times the faces where
    /// pairs become quads. For loops it is the cage before smoothing; for a box or a tetrahedron it has their faces.
    const Mesh& decimated() const;
    /// Returns the cage, as run() returned it; without faces before the first run.
    const Mesh& cage() const;
    /// Returns the account of how that cage came about.
    const CageReport& report() const;
    /// \}

private:
    class Impl;
    std::unique_ptr<Impl> impl_;
};

/// Makes one cage of one model, as `Pipeline(model).run(options)` does. Most callers need no more.
///
/// With the default options the cage has at most 400 triangles. It is certified to bound the model, or this throws.
/// \param model any polygon soup with a usable face
/// \param options as for Pipeline::run()
/// \param interrupter as for Pipeline::run()
/// \throw InputError as Pipeline and its run()
/// \throw DeviceError as Pipeline::run()
/// \throw Error as Pipeline::run()
/// \throw Cancelled when asked to stop
VDBCAGE_API Mesh makeCage(const Mesh& model, const CageOptions& options = {}, Interrupter* interrupter = nullptr);

} // namespace vdbcage
