#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include <vdbcage/core/grids.h>
#include <vdbcage/core/interrupter.h>
#include <vdbcage/mesh/mesh.h>
#include <vdbcage/pipeline/detail/search.h>
#include <vdbcage/pipeline/options.h>
#include <vdbcage/volume/detail/boundary_topology.h>

/// The volumes that cages are made from. They are kept from run to run under typed keys: equal keys, equal volumes.
namespace vdbcage::detail {

/// Stands for the contents of a field. The grid counts by its content, as whoever holds it may write to it between two
/// runs.
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
    SolidKey key;
    std::shared_ptr<const openvdb::MaskGrid> mask;
    VoxelizeReport report;
    std::size_t voxels = 0; ///< active ones
    BoundaryTopology boundary;
};

/// Its closing, cavities filled.
struct Closing {
    ClosingKey key;
    std::shared_ptr<const Solid> solid;
    std::shared_ptr<const openvdb::MaskGrid> mask;
    std::size_t cavitiesFilled = 0;
    std::size_t voxels = 0; ///< active ones
};

/// Makes volumes of one model. The last of each kind is kept. What was given out stays as it is.
class Volumes {
public:
    /// `model` must outlive this.
    explicit Volumes(const Mesh& model) : model_(model) {}

    /// The closing of the model by the radii of `voxels` and the options. `scale` is the version of their scale field.
    /// \throw InputError as voxelize, closeMask
    /// \throw DeviceError
    /// \throw Cancelled
    std::shared_ptr<const Closing> closing(const CageOptions& options, const FieldVersion& scale, const Voxels& voxels,
                                           Interrupter* interrupter);

    /// The model's voxels.
    /// \throw InputError as voxelize
    /// \throw DeviceError
    /// \throw Cancelled
    std::shared_ptr<const Solid> solid(const SolidKey& key, Interrupter* interrupter);

private:
    const Mesh& model_;
    std::shared_ptr<const Solid> solid_;
    std::shared_ptr<const Closing> closing_;
};

/// The key of the closing that Volumes::closing gives.
ClosingKey closingKey(const CageOptions& options, const FieldVersion& scale, const Voxels& voxels);

/// How many active voxels `mask` has.
std::size_t countOf(const openvdb::MaskGrid& mask);

} // namespace vdbcage::detail
