// Based on: Schwarz and Seidel, Fast Parallel Surface and Solid Voxelization on GPUs, 2010; Nooruddin and Turk,
// Simplification and Repair of Polygonal Models Using Volumetric Techniques, 2003.
// Differs: the grid is worked on in slabs of a few planes along x. Each slab has one thread, which holds the crossings
// of its rays in cache and leaves only the vote in the grid; so nothing needs atomics or a second grid.
#include <algorithm>
#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <tbb/blocked_range.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>
#include <vdbcage/voxelize/detail/backend.h>
#include <vdbcage/voxelize/detail/face_scan.h>
#include <vdbcage/voxelize/detail/fill.h>

namespace vdbcage::detail {

namespace {

using Word = BitGrid::Word;
using openvdb::Vec3i;
using openvdb::Vec3I;

/// The triangles of a model on the lattice, and for each slab a list of those that reach into it.
class SlabbedTriangles {
public:
    SlabbedTriangles(const Mesh& model, const Frame& frame)
        : points_(latticePoints(model, frame)), faces_(everySplit(model)),
          counted_(model.triangles.size() + 2 * model.quads.size()),
          slabThickness_(std::clamp(frame.voxels.dim().x() / 16, 1, 8)),
          slabCount_((frame.voxels.dim().x() + slabThickness_ - 1) / slabThickness_), planes_(frame.voxels.dim().x())
    {
        const openvdb::Coord low = frame.voxels.min();
        const Vec3i origin(low.x() * latticeStep, low.y() * latticeStep, low.z() * latticeStep);
        for (Vec3i& point : points_) point -= origin;
        sortIntoSlabs();
    }

    int slabCount() const { return slabCount_; }
    int slabThickness() const { return slabThickness_; }
    Span planes(int slab) const { return {slab * slabThickness_, std::min((slab + 1) * slabThickness_, planes_) - 1}; }
    /// visit(triangle, whether its crossings count: those of a face do under one way to split it only)
    template <typename Visit>
    void forEach(int slab, const Visit& visit) const
    {
        const auto begin = begins_[static_cast<std::size_t>(slab)], end = begins_[static_cast<std::size_t>(slab) + 1];
        for (std::size_t i = begin; i != end; ++i) {
            const Vec3I& face = faces_[members_[i]];
            visit(LatticeTriangle{{points_[face[0]], points_[face[1]], points_[face[2]]}}, members_[i] < counted_);
        }
    }

private:
    Span slabsOf(const Vec3I& face) const
    {
        const int a = points_[face[0]].x(), b = points_[face[1]].x(), c = points_[face[2]].x();
        const int first = (std::min({a, b, c}) - latticeReach + latticeStep - 1) >> latticeBits;
        const int last = (std::max({a, b, c}) + latticeReach) >> latticeBits;
        return {first / slabThickness_, last / slabThickness_};
    }

    /// A counting sort, in parallel over blocks of faces, that keeps the order of the faces.
    void sortIntoSlabs()
    {
        const auto slabs = static_cast<std::size_t>(slabCount_);
        const std::size_t blockSize = std::max<std::size_t>(4096, faces_.size() / 64 + 1);
        const std::size_t blocks = (faces_.size() + blockSize - 1) / blockSize;
        std::vector<std::size_t> next(blocks * slabs); // by block and slab: first the counts, then where to write
        const auto forEachFace = [&](const auto& visit) {
            tbb::parallel_for(std::size_t(0), blocks, [&](std::size_t block) {
                std::size_t* const row = next.data() + block * slabs;
                const std::size_t end = std::min(faces_.size(), (block + 1) * blockSize);
                for (std::size_t i = block * blockSize; i < end; ++i) {
                    const Span span = slabsOf(faces_[i]);
                    for (int slab = span.first; slab <= span.last; ++slab) visit(i, row[slab]);
                }
            });
        };
        forEachFace([](std::size_t, std::size_t& count) { ++count; });
        begins_.assign(slabs + 1, 0);
        std::size_t total = 0;
        for (std::size_t slab = 0; slab < slabs; ++slab) {
            begins_[slab] = total;
            for (std::size_t block = 0; block < blocks; ++block) {
                const std::size_t count = next[block * slabs + slab];
                next[block * slabs + slab] = total;
                total += count;
            }
        }
        begins_[slabs] = total;
        members_.resize(total);
        forEachFace([&](std::size_t i, std::size_t& at) { members_[at++] = static_cast<std::uint32_t>(i); });
    }

    std::vector<Vec3i> points_; ///< lattice units, counted from the centre of the grid's first voxel
    std::vector<Vec3I> faces_;
    std::size_t counted_; ///< the first so many faces count for parity
    int slabThickness_, slabCount_, planes_;
    std::vector<std::size_t> begins_; ///< by slab
    std::vector<std::uint32_t> members_;
};

/// Asks the interrupter whenever about a millisecond of work has been done.
class WorkMeter {
public:
    explicit WorkMeter(Interrupter* interrupter, int percent = -1) : interrupter_(interrupter), percent_(percent) {}
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

bool anyBit(const Word* words, int count)
{
    Word any = 0;
    for (int i = 0; i < count; ++i) any |= words[i];
    return any != 0;
}

/// Turns crossings into parities: bit z becomes the exclusive or of bits 0 to z.
void accumulate(Word* row, int words)
{
    for (int i = 0; i < words; ++i) {
        for (int step = 1; step < BitGrid::wordBits; step *= 2) row[i] ^= row[i] << step;
    }
    Word carry = 0;
    for (int i = 0; i < words; ++i) {
        row[i] ^= carry;
        carry = Word(0) - (row[i] >> 63);
    }
}

class CpuVoxelizer {
public:
    CpuVoxelizer(const Mesh& model, const Frame& frame, Interrupter* interrupter)
        : interrupter_(interrupter), triangles_(model, frame), grid_(frame.voxels), rows_(grid_.size().y()),
          words_(grid_.wordsPerRow()), planeWords_(grid_.rowOffset(1, 0)),
          entering_(static_cast<std::size_t>(triangles_.slabCount()) * planeWords_)
    {
    }

    BitGrid run()
    {
        findEnteringParities();
        std::atomic<int> finished{0};
        tbb::parallel_for(
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
    /// What a thread needs for a slab; all zero between slabs.
    struct Workspace {
        std::array<std::vector<Word>, 3> crossings;
        std::vector<std::uint8_t> crossed;
        std::vector<Word> alongY; ///< a row
        ScanBuffer buffer;
    };

    Word* entering(int slab) { return entering_.data() + static_cast<std::size_t>(slab) * planeWords_; }

    /// The parities along x with which the rays enter each slab.
    void findEnteringParities()
    {
        const int last = triangles_.slabCount() - 1;
        tbb::parallel_for(0, last, [&](int slab) {
            throwIfInterrupted(interrupter_, 5);
            WorkMeter meter(interrupter_);
            triangles_.forEach(slab, [&](const LatticeTriangle& triangle, bool counted) {
                if (counted) scanCrossingsAlongX(triangle, triangles_.planes(slab), entering(slab + 1), words_);
                meter.add(1);
            });
        });
        tbb::parallel_for(tbb::blocked_range<std::size_t>(0, planeWords_, 4096), [&](const auto& range) {
            for (int slab = 1; slab <= last; ++slab) {
                const Word* before = entering(slab - 1);
                Word* here = entering(slab);
                for (std::size_t i = range.begin(); i != range.end(); ++i) here[i] ^= before[i];
            }
        });
    }

    void voxelizeSlab(int index, int percent)
    {
        Workspace& work = workspaces_.local();
        const Span planes = triangles_.planes(index);
        const auto thickness = static_cast<std::size_t>(triangles_.slabThickness());
        for (std::vector<Word>& bits : work.crossings) bits.resize(thickness * planeWords_);
        work.crossed.resize(thickness * static_cast<std::size_t>(rows_));
        work.alongY.resize(static_cast<std::size_t>(words_));

        Slab slab;
        slab.planes = planes;
        slab.rowsPerPlane = rows_;
        slab.wordsPerRow = words_;
        slab.surface = grid_.row(planes.first, 0);
        for (int axis = 0; axis < 3; ++axis)
            slab.crossings[axis] = work.crossings[static_cast<std::size_t>(axis)].data();
        slab.crossed = work.crossed.data();

        WorkMeter meter(interrupter_, percent);
        triangles_.forEach(index, [&](const LatticeTriangle& triangle, bool counted) {
            meter.add(4 + scanSurface(triangle, counted, slab, work.buffer));
        });
        for (int x = planes.first; x <= planes.last; ++x) {
            meter.add(planeWords_);
            vote(slab, x - planes.first, entering(index), work.alongY.data());
        }
    }

    /// Sets what at least two of the three parities hold to be inside, in one plane of a slab. `alongX` holds the
    /// parities along x of the plane before and then of this one; the crossings are cleared.
    void vote(const Slab& slab, int plane, Word* alongX, Word* alongY)
    {
        std::fill_n(alongY, words_, Word(0));
        bool anyY = false;
        for (int y = 0; y < rows_; ++y, alongX += words_) {
            const std::size_t row =
                static_cast<std::size_t>(plane) * static_cast<std::size_t>(rows_) + static_cast<std::size_t>(y);
            const std::size_t offset = row * static_cast<std::size_t>(words_);
            Word *const crossX = slab.crossings[0] + offset, *const crossY = slab.crossings[1] + offset,
                        *const alongZ = slab.crossings[2] + offset;
            const int crossed = slab.crossed[row];
            slab.crossed[row] = 0;
            if (crossed & 1) {
                for (int i = 0; i < words_; ++i) alongX[i] ^= crossX[i];
                std::fill_n(crossX, words_, Word(0));
            }
            if (crossed & 2) {
                for (int i = 0; i < words_; ++i) alongY[i] ^= crossY[i];
                std::fill_n(crossY, words_, Word(0));
                anyY = anyBit(alongY, words_);
            }
            if (crossed & 4) {
                accumulate(alongZ, words_);
            } else if (!anyY) {
                continue; // at most one vote
            }
            Word* const solid = slab.surface + offset;
            for (int i = 0; i < words_; ++i) {
                solid[i] |= (alongX[i] & alongY[i]) | (alongZ[i] & (alongX[i] | alongY[i]));
            }
            if (crossed & 4) std::fill_n(alongZ, words_, Word(0));
        }
    }

    Interrupter* interrupter_;
    const SlabbedTriangles triangles_;
    BitGrid grid_;
    const int rows_, words_;
    const std::size_t planeWords_;
    std::vector<Word> entering_; ///< by slab, a plane of parities
    tbb::enumerable_thread_specific<Workspace> workspaces_;
};

} // namespace

BitGrid voxelizeCpu(const Mesh& model, const Frame& frame, Interrupter* interrupter)
{
    return CpuVoxelizer(model, frame, interrupter).run();
}

} // namespace vdbcage::detail
