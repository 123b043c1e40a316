#pragma once

#include <cstddef>
#include <memory>

#include <openvdb/openvdb.h>
#include <vdbcage/check/check.h>
#include <vdbcage/core/export.h>
#include <vdbcage/core/interrupter.h>
#include <vdbcage/mesh/mesh.h>
#include <vdbcage/pipeline/options.h>

namespace vdbcage {

/// How a cage came about, beside the cage itself.
struct CageReport {
    CageCheck check;                ///< the verdict on the cage as it is returned, with measures
    bool floatSafe = false;         ///< its coordinates are floats, and the cage also bounds the model rounded to float
    double offsetVoxels = 0;        ///< how far the closing had to be grown before the cage bounded the model
    int attempts = 0;               ///< cages built on the way to this one
    bool isBox = false;             ///< nothing tighter than the model's bounding box was certified
    bool repaired = false;          ///< an unguarded cage was not valid and went through repair()
    std::size_t cavitiesFilled = 0; ///< hollows inside the closing that were filled
    std::size_t solidVoxels = 0, closedVoxels = 0;
};

/// From a model to its cage, keeping every intermediate. Running again with other options starts from the first stage
/// that they touch: another face count or smoothness needs no new voxels and no new closing.
///
/// With CageOptions::bounding the cage is certified: every candidate is examined by checkCage, on its coordinates
/// rounded to float where float can hold the model, against the model as given and as rounded to float. Plain smoothing
/// and decimation cut into a model, so the closing is grown until a candidate holds, and by as little as a short search
/// finds; the last resort is the model's bounding box. A cage that is not certified is never returned.
class VDBCAGE_API Pipeline {
public:
    /// \throw InputError the model has no usable face (see requireUsable)
    explicit Pipeline(Mesh model);
    ~Pipeline();
    Pipeline(Pipeline&&) noexcept;
    Pipeline& operator=(Pipeline&&) noexcept;

    /// Makes the cage for `options` and returns it; valid until the next run. If it throws, the intermediates and the
    /// cage of the run before may be gone, but the pipeline can run again.
    /// Stages reported to `interrupter`: voxelize, close, surface, smooth, decimate, certify (some more than once).
    /// The cage can have fewer faces than asked, and more where the topology of the closing does not allow fewer and
    /// `bounding` is off. \throw InputError, DeviceError, Cancelled
    const Mesh& run(const CageOptions& options, Interrupter* interrupter = nullptr);

    const Mesh& model() const;
    /// The intermediates of the last run; null or empty before the first.
    openvdb::MaskGrid::ConstPtr solid() const;  ///< the voxelized model
    openvdb::MaskGrid::ConstPtr closed() const; ///< its closing, cavities filled
    const Mesh& surface() const;                ///< faces of the closing grown by CageReport::offsetVoxels
    const Mesh& smoothed() const;
    const Mesh& decimated() const;
    const Mesh& cage() const;
    const CageReport& report() const;

private:
    class Stages;
    std::unique_ptr<Stages> stages_;
};

/// One model, one cage: Pipeline(model).run(options). What most callers need. \throw InputError, DeviceError, Cancelled
VDBCAGE_API Mesh makeCage(const Mesh& model, const CageOptions& options = {}, Interrupter* interrupter = nullptr);

} // namespace vdbcage
