#include <vdbcage/core/detail/grids.h>
#include <vdbcage/pipeline/detail/stages/volumes.h>

#include <algorithm>
#include <cstring>
#include <utility>

#include <vdbcage/core/detail/parallel.h>
#include <vdbcage/pipeline/detail/stages/mesh_tools.h>
#include <vdbcage/volume/cavities.h>
#include <vdbcage/volume/extract.h>
#include <vdbcage/volume/mirror.h>
#include <vdbcage/volume/morphology.h>

namespace vdbcage::detail {

namespace {

/// A digest of numbers in their order, by multiplication and shifts after the finalizer of MurmurHash3.
class Digest {
public:
    template <typename Number>
    void add(Number number)
    {
        std::uint64_t bits = 0;
        static_assert(sizeof number <= sizeof bits);
        std::memcpy(&bits, &number, sizeof number);
        value_ = (value_ ^ bits) * 0xff51afd7ed558ccdU;
        value_ ^= value_ >> 33U;
        value_ *= 0xc4ceb9fe1a85ec53U;
        value_ ^= value_ >> 29U;
    }
    void add(const openvdb::Coord& c)
    {
        for (const std::size_t i : {0U, 1U, 2U}) add(c[i]);
    }
    std::uint64_t value() const { return value_ == 0 ? 1 : value_; }

private:
    std::uint64_t value_ = 0x9e3779b97f4a7c15U;
};

/// Returns the digest of a grid. Active states do not count: interpolation uses all values.
std::uint64_t digestOf(const openvdb::FloatGrid& grid)
{
    Digest digest;
    for (const openvdb::Vec3d& corner : {openvdb::Vec3d(0, 0, 0), {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}) {
        const openvdb::Vec3d place = grid.transform().indexToWorld(corner);
        for (const int i : {0, 1, 2}) digest.add(place[i]);
    }
    const openvdb::FloatTree& tree = grid.constTree();
    digest.add(tree.background());
    auto tile = tree.cbeginValueAll();
    tile.setMaxDepth(openvdb::FloatTree::ValueAllCIter::LEAF_DEPTH - 1);
    for (; tile; ++tile) {
        digest.add(tile.getDepth());
        digest.add(tile.getCoord());
        digest.add(*tile);
    }
    for (auto leaf = tree.cbeginLeaf(); leaf; ++leaf) {
        digest.add(leaf->origin());
        const float* const values = leaf->buffer().data();
        for (openvdb::Index i = 0; i < openvdb::FloatTree::LeafNodeType::SIZE; ++i) digest.add(values[i]);
    }
    return digest.value();
}

} // namespace

FieldVersion::FieldVersion(const FactorField& scale)
    : regions(scale.regions), grid(scale.grid ? isolated([&] { return digestOf(*scale.grid); }) : 0)
{
}

bool FieldVersion::operator==(const FieldVersion& other) const
{
    const auto areEqual = [](const FactorRegion& a, const FactorRegion& b) {
        return a.shape == b.shape && a.lower == b.lower && a.upper == b.upper && a.radius == b.radius &&
               a.factor == b.factor;
    };
    return grid == other.grid &&
           std::equal(regions.begin(), regions.end(), other.regions.begin(), other.regions.end(), areEqual);
}

bool SolidKey::operator==(const SolidKey& other) const
{
    return resolution == other.resolution && voxelizer == other.voxelizer && interior == other.interior &&
           plane == other.plane;
}

bool ClosingKey::operator==(const ClosingKey& other) const
{
    return solid == other.solid && closeRadius == other.closeRadius && erodeRadius == other.erodeRadius &&
           element == other.element && scale == other.scale;
}

ClosingKey closingKey(const CageOptions& options, const FieldVersion& scale, const Voxels& voxels)
{
    return {{voxels.resolution, options.voxelizer, options.interior, voxels.plane},
            voxels.closeRadius,
            options.erodeRadius.value_or(voxels.closeRadius),
            options.element,
            scale};
}

std::size_t countOf(const openvdb::MaskGrid& mask)
{
    return static_cast<std::size_t>(isolated([&] { return mask.activeVoxelCount(); }));
}

std::size_t quadsOf(Volumes& volumes, const CageOptions& options, const FieldVersion& scale, const Voxels& voxels,
                    Interrupter* interrupter)
{
    return faceCount(extractSurface(*volumes.closing(options, scale, voxels, interrupter)->mask, interrupter));
}

std::shared_ptr<const Solid> Volumes::solid(const SolidKey& key, Interrupter* interrupter)
{
    return solid_.of(key, [&] {
        closing_.forget(); // before the new one takes memory
        const Stage stage(interrupter, StageName::voxelize);
        VoxelizeOptions voxelization;
        voxelization.resolution = key.resolution;
        voxelization.voxelizer = key.voxelizer;
        voxelization.interior = key.interior;
        if (key.plane) voxelization.box = boxWithMirrorImage(boundingBox(model_), *key.plane);
        auto solid = std::make_shared<Solid>();
        auto [mask, report] = voxelize(model_, voxelization, interrupter);
        solid->report = std::move(report);
        if (key.plane) mask = withMirrorImage(*mask, key.plane->axis, key.resolution, interrupter);
        solid->voxels = countOf(*mask);
        solid->boundary = boundaryTopology(*mask, interrupter);
        solid->mask = std::move(mask);
        return solid;
    });
}

std::shared_ptr<const Closing> Volumes::closing(const CageOptions& options, const FieldVersion& scale,
                                                const Voxels& voxels, Interrupter* interrupter)
{
    const ClosingKey key = closingKey(options, scale, voxels);
    return closing_.of(key, [&] {
        auto closing = std::make_shared<Closing>();
        closing->key = key;
        closing->solid = solid(key.solid, interrupter);
        const Stage stage(interrupter, StageName::close);
        CloseOptions closeOptions;
        closeOptions.closeRadiusVoxels = key.closeRadius * voxels.resolution;
        closeOptions.erodeRadiusVoxels = key.erodeRadius * voxels.resolution;
        closeOptions.element = key.element;
        auto closed = closeMask(*closing->solid->mask, closeOptions, options.scale, interrupter);
        // The scale need not be symmetric.
        if (voxels.plane) closed = withMirrorImage(*closed, voxels.plane->axis, voxels.resolution, interrupter);
        FilledMask filled = fillCavities(*closed, interrupter);
        closing->cavitiesFilled = filled.cavities;
        closing->voxels = countOf(*filled.mask);
        closing->mask = std::move(filled.mask);
        return closing;
    });
}

} // namespace vdbcage::detail
