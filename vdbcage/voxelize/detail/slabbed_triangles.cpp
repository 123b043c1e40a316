#include <vdbcage/voxelize/detail/slabbed_triangles.h>

#include <algorithm>

#include <vdbcage/core/detail/parallel.h>

namespace vdbcage::detail {

using openvdb::Vec3i;
using openvdb::Vec3I;

SlabbedTriangles::SlabbedTriangles(const Mesh& model, const Frame& frame, int slabThickness, Interrupter* interrupter)
    : points_(latticePoints(model, frame)), faces_(everySplit(model)),
      counted_(model.triangles.size() + 2 * model.quads.size()), slabThickness_(slabThickness),
      slabCount_((frame.voxels.dim().x() + slabThickness_ - 1) / slabThickness_), planes_(frame.voxels.dim().x())
{
    const openvdb::Coord low = frame.voxels.min();
    const Vec3i origin(low.x() * latticeStep, low.y() * latticeStep, low.z() * latticeStep);
    for (Vec3i& point : points_) point -= origin;
    sortIntoSlabs(interrupter);
}

Span SlabbedTriangles::planes(int slab) const
{
    return {slab * slabThickness_, std::min((slab + 1) * slabThickness_, planes_) - 1};
}

Span SlabbedTriangles::slabsOf(const Vec3I& face) const
{
    const int a = points_[face[0]].x(), b = points_[face[1]].x(), c = points_[face[2]].x();
    const int first = (std::min({a, b, c}) - latticeBound + latticeStep - 1) >> latticeBits;
    const int last = (std::max({a, b, c}) + latticeBound) >> latticeBits;
    return {first / slabThickness_, last / slabThickness_};
}

/// Sorts by counting, in parallel over blocks of faces; keeps the order of the faces.
void SlabbedTriangles::sortIntoSlabs(Interrupter* interrupter)
{
    const auto slabs = static_cast<std::size_t>(slabCount_);
    const std::size_t blockSize = std::max<std::size_t>(4096, faces_.size() / 64 + 1);
    const std::size_t blocks = (faces_.size() + blockSize - 1) / blockSize;
    std::vector<std::size_t> next(blocks * slabs); // by block and slab: first the counts, then the places to write to
    const auto forEachFace = [&](const auto& visit) {
        parallelFor(std::size_t(0), blocks, [&](std::size_t block) {
            throwIfInterrupted(interrupter);
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

} // namespace vdbcage::detail
