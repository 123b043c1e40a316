#pragma once

#include <vdbcage/volume/detail/sphere/radius_field.h>
#include <vdbcage/volume/detail/sphere/sphere_query.h>

namespace vdbcage::detail {

/// A query as SphereQuery, with a radius for each voxel.
///
/// Squared distances to the contour voxels, minus the squares of their radii (scatter), are minimised axis by axis. The
/// least are compared with the squared radii of the entry's voxels (gather). The squares of the unused one are 0.
/// Based on: Saito and Toriwaki, New Algorithms for Euclidean Distance Transformation, 1994.
class VaryingQuery {
public:
    enum class By {
        target, ///< the radius is that of the voxel that looks for contour voxels (gather)
        source  ///< the radius is that of the contour voxel (scatter)
    };
    /// All radii are `factor` (0 to 1) times those of the field, which must outlive this.
    VaryingQuery(const RadiusField& field, double factor, By by, Simd simd)
        : field_(field), factor_(factor), by_(by), simd_(simd)
    {
    }

    struct Work {
        struct Site {
            std::int32_t x, y, z; ///< in the leaf
            std::int32_t square;  ///< of its radius; 0 where the target's counts
        };
        Coord corner; ///< of the part
        std::array<std::int32_t, 64> leastSquare,
            mostSquare;                    ///< of the voxels of each entry; 0 where the source's count
        std::vector<std::uint32_t> starts; ///< by leaf's id: of its sites, 0 if not yet there
        std::vector<Site> sites;           ///< of a leaf: first one whose x is their number
        std::vector<std::int32_t> planes;  ///< by x: least squared distance in the plane, of each (y, z)
        std::vector<int> used;             ///< the x that have a plane
        std::vector<char> isUsed;
    };
    void startBlock(Work& work, std::size_t leaves) const;
    void startPart(Work& work, const Coord& corner) const;
    std::uint64_t coveredEntries(const NearLeaf* near, std::size_t count, std::uint64_t wanted, const Work& work) const;
    void nearEntries(NearLeaf* near, std::size_t count, const Work& work) const;
    std::array<Words, 4> within(const SphereQuery::Pile& open, int pile, const NearLeaf* near,
                                const SphereQuery::Leaves& leaves, Work& work) const;

private:
    Words withinEntry(const Words& open, int entry, const NearLeaf* near, const SphereQuery::Leaves& leaves,
                      Work& work) const;

    const RadiusField& field_;
    double factor_;
    By by_;
    Simd simd_;
};

} // namespace vdbcage::detail
