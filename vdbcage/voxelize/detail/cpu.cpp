// Based on: Schwarz and Seidel, Fast Parallel Surface and Solid Voxelization on GPUs, 2010; Nooruddin and Turk,
// Simplification and Repair of Polygonal Models Using Volumetric Techniques, 2003.
// Differs: the grid is processed in slabs of a few planes along x. Each slab has one thread, which keeps the crossings
// of its rays in cache and leaves only the vote in the grid; so nothing needs atomics or a second grid.
#include <algorithm>
#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <tbb/blocked_range.h>
#include <tbb/enumerable_thread_specific.h>
#include <vdbcage/core/detail/parallel.h>
#include <vdbcage/voxelize/detail/backend.h>
#include <vdbcage/voxelize/detail/face_scan.h>
#include <vdbcage/voxelize/detail/fill.h>
#include <vdbcage/voxelize/detail/parity_vote.h>
#include <vdbcage/voxelize/detail/slabbed_triangles.h>

namespace vdbcage::detail {

namespace {

using Word = BitGrid::Word;

/// A meter that asks the interrupter after about each millisecond of work.
class WorkMeter {
public:
    explicit WorkMeter(Interrupter* interrupter, int percent) : interrupter_(interrupter), percent_(percent) {}
    void add(std::size_t work)
    {
        done_ += work;
        if (done_ < 16384) return;
        done_ = 0;
        throwIfInterrupted(interrupter_, percent_);
    }

private:
    Interrupter* interrupter_;
    int percent_;
    std::size_t done_ = 0;
};

class CpuVoxelizer {
public:
    CpuVoxelizer(const Mesh& model, const Frame& frame, Interrupter* interrupter)
        : interrupter_(interrupter),
          triangles_(model, frame, std::clamp(frame.voxels.dim().x() / 16, 1, 8), interrupter), grid_(frame.voxels),
          rows_(grid_.size().y()), words_(grid_.wordsPerRow()), planeWords_(grid_.rowOffset(1, 0)),
          parities_(paritiesAlongX(triangles_, words_, planeWords_, interrupter))
    {
    }

    BitGrid run()
    {
        std::atomic<int> finished{0};
        parallelFor(
            tbb::blocked_range<int>(0, triangles_.slabCount(), 1),
            [&](const tbb::blocked_range<int>& range) {
                for (int slab = range.begin(); slab != range.end(); ++slab) {
                    const int percent = 10 + 70 * finished / triangles_.slabCount();
                    throwIfInterrupted(interrupter_, percent);
                    voxelizeSlab(slab, percent);
                    ++finished;
                }
            },
            tbb::simple_partitioner());
        fillEnclosed(grid_, interrupter_);
        return std::move(grid_);
    }

private:
    /// The data of a thread for a slab; all zero between slabs.
    struct Workspace {
        std::array<std::vector<Word>, 3> crossings;
        std::vector<std::uint8_t> crossed;
        std::vector<Word> rows; ///< two
        ScanBuffer buffer;
    };

    Word* entering(int slab) { return parities_.data() + static_cast<std::size_t>(slab) * planeWords_; }

    void voxelizeSlab(int index, int percent)
    {
        Workspace& work = workspaces_.local();
        const Span planes = triangles_.planes(index);
        const auto thickness = static_cast<std::size_t>(triangles_.slabThickness());
        for (std::vector<Word>& bits : work.crossings) bits.resize(thickness * planeWords_);
        work.crossed.resize(thickness * static_cast<std::size_t>(rows_));
        work.rows.resize(2 * static_cast<std::size_t>(words_));

        Slab slab;
        slab.planes = planes;
        slab.rowsPerPlane = rows_;
        slab.wordsPerRow = words_;
        slab.surface = grid_.row(planes.first, 0);
        for (int axis = 0; axis < 3; ++axis)
            slab.crossings[axis] = work.crossings[static_cast<std::size_t>(axis)].data();
        slab.crossed = work.crossed.data();

        WorkMeter meter(interrupter_, percent);
        for (std::size_t i = 0; i < triangles_.size(index); ++i) {
            meter.add(4 + scanSurface(triangles_.triangle(index, i), triangles_.counted(index, i), slab, work.buffer));
        }
        for (int x = planes.first; x <= planes.last; ++x) {
            meter.add(planeWords_);
            voteInside(slab, x, entering(index), entering(triangles_.slabCount()), work.rows.data());
        }
    }

    Interrupter* interrupter_;
    const SlabbedTriangles triangles_;
    BitGrid grid_;
    const int rows_, words_;
    const std::size_t planeWords_;
    std::vector<Word> parities_; ///< along x, with which rays enter each slab, and leave the last
    tbb::enumerable_thread_specific<Workspace> workspaces_;
};

} // namespace

BitGrid voxelizeCpu(const Mesh& model, const Frame& frame, Interrupter* interrupter)
{
    return CpuVoxelizer(model, frame, interrupter).run();
}

} // namespace vdbcage::detail
