#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include <vdbcage/core/detail/memo.h>
#include <vdbcage/core/grids.h>
#include <vdbcage/core/interrupter.h>
#include <vdbcage/mesh/mesh.h>
#include <vdbcage/pipeline/detail/search_policy.h>
#include <vdbcage/pipeline/options.h>
#include <vdbcage/volume/detail/boundary_topology.h>

/// The volumes from which cages are made. They are kept from run to run under typed keys: equal keys, equal volumes.
namespace vdbcage::detail {

/// A key for the contents of a field. The grid counts by its content, since its owner may write to it between two runs.
struct FieldVersion {
    std::vector<FactorRegion> regions;
    std::uint64_t grid = 0; ///< digest of transform, background, tiles and leaves; 0 without a grid

    FieldVersion() = default;
    /// Cost: O(values of the grid).
    explicit FieldVersion(const FactorField& scale);
    bool operator==(const FieldVersion& other) const;
};

struct SolidKey {
    int resolution = 0;
    Voxelizer voxelizer = Voxelizer::automatic;
    Interior interior = Interior::automatic;
    std::optional<SymmetryPlane> plane;

    bool operator==(const SolidKey& other) const;
};

struct ClosingKey {
    SolidKey solid;
    double closeRadius = 0, erodeRadius = 0;
    StructuringElement element = StructuringElement::sphere;
    FieldVersion scale;

    bool operator==(const ClosingKey& other) const;
};

/// The voxelized model.
struct Solid {
    std::shared_ptr<const openvdb::MaskGrid> mask;
    VoxelizeReport report;
    std::size_t voxels = 0; ///< active ones
    BoundaryTopology boundary;
};

/// The closing of a solid, with cavities filled.
struct Closing {
    ClosingKey key;
    std::shared_ptr<const Solid> solid;
    std::shared_ptr<const openvdb::MaskGrid> mask;
    std::size_t cavitiesFilled = 0;
    std::size_t voxels = 0; ///< active ones
};

/// The volumes of one model. It keeps the last of each kind. Volumes already returned stay unchanged.
class Volumes {
public:
    /// `model` must outlive this.
    explicit Volumes(const Mesh& model) : model_(model) {}

    /// Returns the closing of the model by the radii of `voxels` and the options. `scale` is the version of their scale
    /// field.
    /// \throw InputError as voxelize, closeMask
    /// \throw DeviceError
    /// \throw Cancelled
    std::shared_ptr<const Closing> closing(const CageOptions& options, const FieldVersion& scale, const Voxels& voxels,
                                           Interrupter* interrupter);

    /// Returns the model's voxels.
    /// \throw InputError as voxelize
    /// \throw DeviceError
    /// \throw Cancelled
    std::shared_ptr<const Solid> solid(const SolidKey& key, Interrupter* interrupter);

private:
    const Mesh& model_;
    Memo<SolidKey, std::shared_ptr<const Solid>> solid_;
    Memo<ClosingKey, std::shared_ptr<const Closing>> closing_;
};

/// Returns the key of the closing that Volumes::closing returns.
ClosingKey closingKey(const CageOptions& options, const FieldVersion& scale, const Voxels& voxels);

/// Returns the number of active voxels of `mask`.
std::size_t countOf(const openvdb::MaskGrid& mask);

/// Returns the number of quads of a closing's surface.
std::size_t quadsOf(Volumes& volumes, const CageOptions& options, const FieldVersion& scale, const Voxels& voxels,
                    Interrupter* interrupter);

} // namespace vdbcage::detail
