#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include <vdbcage/volume/detail/boundary_leaves.h>
#include <vdbcage/volume/detail/progress.h>
#include <vdbcage/volume/detail/simd.h>

namespace vdbcage::detail {

struct SphereTables;

/// A contour leaf as seen from a part: a cube of 4^3 entries.
struct NearLeaf {
    const Words* words;
    std::uint32_t id;     ///< among all that are near the block of the part
    std::int16_t x, y, z; ///< its entry, counted from the part's first
    BitBox box;
    std::array<std::int8_t, 3> sample;
    // Set by nearEntries:
    std::uint64_t entriesInRadius;     ///< at least the entries of the part with a voxel within the radius of its own
    std::int32_t entryPlace, rowPlace; ///< of the part's first entry in the tables
};

/// Which voxels lie within a sphere's reach of contour voxels: a rough answer for the 64 entries of a part at once, and
/// an exact one for the voxels of a pile of entries. Entry (x, y, z) of a part is bit 16 x + 4 y + z; its piles are the
/// four entries along z.
///
/// Exact: a contour voxel q reaches, in each column along z, the voxels up to h(dx, dy) above and below it. Of contour
/// voxels below an entry so the largest q.z + h tells all, column by column, in bytes side by side (16-bit integers
/// beyond smallRadius), and for the next entry above too. Voxels hidden behind others of their leaf are left out
/// before, and leaves that can add nothing too.
///
/// Const once it is made: threads share one. Memory: 32 r^2 bytes (64 r^2 beyond smallRadius).
class SphereQuery {
public:
    /// `squaredRadius` up to 512^2; `simd` must be supported. \throw Cancelled
    SphereQuery(std::int64_t squaredRadius, Simd simd, const Progress& progress);
    ~SphereQuery();

    /// What one thread has found out about the leaves around the block that it works on.
    struct Work {
        struct Voxel {
            std::int32_t place; ///< of its column in the tables, from that of the leaf's first column
            std::int32_t z;     ///< in the leaf; beside the entry the byte of all voxels in the column
        };
        std::vector<std::uint32_t>
            starts;                ///< by leaf's id and direction to an entry: where its front is, 0 if not yet there
        std::vector<Voxel> voxels; ///< a front is the number of its voxels and the voxels
        std::size_t size = 0;      ///< of the part of `voxels` that is in use
    };
    /// Starts a block with leaves that are numbered from 0, then each part of it, with its corner.
    void startBlock(Work& work, std::size_t leaves) const;
    void startPart(Work& work, const Coord& corner) const;
    /// Completes the `count` leaves.
    void nearEntries(NearLeaf* near, std::size_t count, const Work& work) const;
    /// The `wanted` entries that lie wholly within reach of the sample of one of the `count` leaves, and maybe others.
    std::uint64_t coveredEntries(const NearLeaf* near, std::size_t count, std::uint64_t wanted, const Work& work) const;

    /// The leaves that may reach a pile of entries, as indices: first those below it, then those beside its first entry
    /// and so on, at last those above.
    struct Leaves {
        const std::uint16_t* indices;
        std::array<std::size_t, 6> ends; ///< of each kind
    };
    /// By entry of a pile: its open voxels, or none.
    using Pile = std::array<const Words*, 4>;
    /// Those of the open voxels of pile 4 x + y of the part that are within reach of the listed leaves, which were
    /// given to nearEntries before; anything where an entry has none.
    std::array<Words, 4> within(const Pile& open, int pile, const NearLeaf* near, const Leaves& leaves,
                                Work& work) const;

private:
    std::unique_ptr<const SphereTables> tables_;
    Simd simd_;
};

} // namespace vdbcage::detail
