#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include <vdbcage/core/detail/simd.h>
#include <vdbcage/volume/detail/contour_blocks.h>
#include <vdbcage/volume/detail/progress.h>

namespace vdbcage::detail {

struct SphereTables;

/// A contour leaf as seen from a part: a cube of 4^3 entries.
struct NearLeaf {
    const Words* words;
    std::uint32_t id;     ///< among all leaves near the block of the part
    std::int16_t x, y, z; ///< its entry, counted from the part's first
    BitBox box;
    std::array<std::int8_t, 3> sample;
    // Set by nearEntries:
    std::uint64_t entriesInRadius;     ///< of the part: at least the entries with a voxel within the radius of its own
    std::int32_t entryPlace, rowPlace; ///< of the part's first entry in the tables
};

/// A query for the voxels within a radius of contour voxels.
///
/// coveredEntries() is rough, for the 64 entries of a part at once; within() is exact, for the voxels of a pile of
/// entries. Entry (x, y, z) of a part is bit 16 x + 4 y + z. A pile is four entries along z.
///
/// For the exact result, let h(dx, dy) be half the sphere's chord in a column along z. A contour voxel q covers the
/// voxels up to h above and below it. The largest q.z + h of the contour voxels below an entry thus decides, and for
/// the next entry above, too. Columns are compared side by side, in bytes (16-bit integers beyond smallRadius). Voxels
/// hidden behind others of their leaf are left out before, and so are leaves that can add nothing.
///
/// It is const after its construction: threads share one.
/// Cost: 32 r^2 bytes (64 r^2 beyond smallRadius).
class SphereQuery {
public:
    /// \pre `squaredRadius` is at most 512^2; `simd` is supported
    /// \throw Cancelled
    SphereQuery(std::int64_t squaredRadius, Simd simd, const Progress& progress);
    ~SphereQuery();

    /// One thread's results for the leaves around its block.
    struct Work {
        struct Voxel {
            std::int32_t place; ///< of its column in the tables, from that of the leaf's first column
            std::int32_t z;     ///< in the leaf; for leaves beside the entry the byte of all voxels in the column
        };
        std::vector<std::uint32_t>
            starts;                ///< by leaf's id and direction to an entry: the place of its front, 0 if none yet
        std::vector<Voxel> voxels; ///< a front is the number of its voxels and the voxels
        std::size_t size = 0;      ///< of the part of `voxels` that is in use
    };
    /// Starts a block. Its near leaves are numbered from 0.
    void startBlock(Work& work, std::size_t leaves) const;
    /// Starts the part of the block with this corner.
    void startPart(Work& work, const Coord& corner) const;
    /// Completes the `count` leaves: sets the last members of each NearLeaf.
    void nearEntries(NearLeaf* near, std::size_t count, const Work& work) const;
    /// Returns the `wanted` entries that lie wholly within the radius of the sample of one of the `count` leaves. Other
    /// entries may be among them.
    std::uint64_t coveredEntries(const NearLeaf* near, std::size_t count, std::uint64_t wanted, const Work& work) const;

    /// The leaves that may be within the radius of a pile of entries, as indices: first those below it, then those
    /// beside its first entry and so on, last those above.
    struct Leaves {
        const std::uint16_t* indices;
        std::array<std::size_t, 6> ends; ///< of each kind
    };
    /// By entry of a pile: its open voxels, or null.
    using Pile = std::array<const Words*, 4>;
    /// Returns the open voxels of pile 4 x + y of the part that are within the radius of the listed leaves. The result
    /// is undefined for an entry without open voxels.
    /// \pre nearEntries() has completed the leaves
    std::array<Words, 4> within(const Pile& open, int pile, const NearLeaf* near, const Leaves& leaves,
                                Work& work) const;

private:
    std::unique_ptr<const SphereTables> tables_;
    Simd simd_;
};

} // namespace vdbcage::detail
