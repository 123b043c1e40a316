// Based on: Schwarz and Seidel, Fast Parallel Surface and Solid Voxelization on GPUs, 2010; Akenine-Moller, Fast 3D
// Triangle-Box Overlap Testing, 2001.
// Differs: exact (shaders/voxelize/face.glsl). A triangle is processed by columns along z, whatever its direction: all
// 13 axes together bound one run of bits there, and the same column has its crossings of the rays along all three axes.
// The rasterizer only distributes columns; no decision depends on its rounding. The device finds surface and crossings;
// parities, vote and filling are the host's, shared with the other backends.
#include <vdbcage/voxelize/detail/gl.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include <shaders/voxelize.h>
#include <tbb/task_arena.h>
#include <vdbcage/core/error.h>
#include <vdbcage/gl/offscreen.h>
#include <vdbcage/voxelize/detail/fill.h>
#include <vdbcage/voxelize/detail/parity_vote.h>
#include <vdbcage/voxelize/detail/slabbed_triangles.h>

namespace vdbcage::detail {

namespace {

using Word = BitGrid::Word;
static_assert(__BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__, "two words of the shaders are one of BitGrid's");

constexpr int grids = 4; // surface, crossings along x, y, z

/// The work of an invocation or of six vertices, as in shaders/voxelize/item.glsl.
struct Item {
    std::int32_t corners[9];
    std::int32_t columnsX, columnsY; ///< first + 65536 * last
    std::int32_t counted;
};
static_assert(sizeof(Item) == 48);

/// The number of items that are sent to the device at a time.
constexpr std::size_t batchSize = std::size_t(1) << 18;

/// Returns the voxels that a part from `low` to `high` may touch.
Span voxelsOf(int low, int high)
{
    return {(low - latticeBound + latticeStep - 1) >> latticeBits, (high + latticeBound) >> latticeBits};
}

/// Returns the y of the voxels that the part of the triangle between two x may touch; at times one voxel more.
Span rowsBetween(const LatticeTriangle& triangle, int fromX, int toX)
{
    double low = std::numeric_limits<double>::max(), high = std::numeric_limits<double>::lowest();
    const auto add = [&](double y) {
        low = std::min(low, y);
        high = std::max(high, y);
    };
    for (int i = 0; i < 3; ++i) {
        const openvdb::Vec3i &p = triangle.corners[i], &q = triangle.corners[(i + 1) % 3];
        if (fromX <= p.x() && p.x() <= toX) add(p.y());
        for (const int x : {fromX, toX}) {
            if ((p.x() < x) != (q.x() < x)) add(p.y() + double(x - p.x()) * (q.y() - p.y()) / (q.x() - p.x()));
        }
    }
    if (high < low) return {};
    return voxelsOf(static_cast<int>(std::floor(low)) - 1, static_cast<int>(std::ceil(high)) + 1);
}

/// Cuts the columns that a triangle may touch in the slab's planes into items: visit(item). A driver may silently end
/// an invocation that takes too many steps (llvmpipe: 65,535), and triangles of all sizes run side by side.
template <typename Visit>
void cut(const LatticeTriangle& triangle, bool counted, const Span& planes, const Visit& visit)
{
    constexpr int mostColumns = 64, mostSteps = 8192, thickness = 4;
    const openvdb::Vec3i(&p)[3] = triangle.corners;
    Span xs = voxelsOf(std::min({p[0].x(), p[1].x(), p[2].x()}), std::max({p[0].x(), p[1].x(), p[2].x()}));
    const Span ys = voxelsOf(std::min({p[0].y(), p[1].y(), p[2].y()}), std::max({p[0].y(), p[1].y(), p[2].y()}));
    const Span zs = voxelsOf(std::min({p[0].z(), p[1].z(), p[2].z()}), std::max({p[0].z(), p[1].z(), p[2].z()}));
    xs = {std::max(xs.first, planes.first), std::min(xs.last, planes.last)};
    const int steps = (zs.last >> 5) - (zs.first >> 5) + 1;
    const int columns = std::min(mostColumns, mostSteps / steps);

    Item item;
    for (int i = 0; i < 9; ++i) item.corners[i] = p[i / 3][i % 3];
    item.counted = counted;
    const auto visitColumns = [&](int firstX, int lastX, int firstY, int lastY) {
        item.columnsX = firstX | lastX << 16;
        item.columnsY = firstY | lastY << 16;
        visit(item);
    };
    if ((xs.last - xs.first + 1) * (ys.last - ys.first + 1) <= columns) {
        visitColumns(xs.first, xs.last, ys.first, ys.last);
        return;
    }
    const int width = columns / thickness;
    for (int x = xs.first; x <= xs.last; x += thickness) {
        const int last = std::min(x + thickness - 1, xs.last);
        Span rows = rowsBetween(triangle, x * latticeStep - latticeBound, last * latticeStep + latticeBound);
        rows = {std::max(rows.first, ys.first), std::min(rows.last, ys.last)};
        for (int y = rows.first; y <= rows.last; y += width) {
            visitColumns(x, last, y, std::min(y + width - 1, rows.last));
        }
    }
}

class GlRun {
public:
    GlRun(const gl::Api& api, GlVoxelizer::Path path, const gl::ProgramObject& program, const Mesh& model,
          const Frame& frame, int slabThickness, Interrupter* interrupter)
        : api_(api), raster_(path == GlVoxelizer::Path::raster), program_(program), interrupter_(interrupter),
          triangles_(model, frame, slabThickness, interrupter), grid_(frame.voxels), rows_(grid_.size().y()),
          words_(grid_.wordsPerRow()), planeWords_(grid_.rowOffset(1, 0)),
          slabWords_(planeWords_ * static_cast<std::size_t>(slabThickness)),
          items_(gl::makeBuffer(api, batchSize * sizeof(Item), nullptr, GL_DYNAMIC_STORAGE_BIT)),
          bits_(gl::makeBuffer(api, grids * slabWords_ * sizeof(Word), nullptr)), crossings_(3 * slabWords_)
    {
        setUniform("rowsPerPlane", rows_);
        setUniform("wordsPerRow", 2 * words_);
        setUniform("wordsPerGrid", static_cast<int>(2 * slabWords_));
        if (raster_) {
            image_ = gl::makeBufferTexture(api_, GL_R32UI, bits_);
            picture_ = gl::makeEmptyFramebuffer(api_, rows_, slabThickness);
            noVertices_ = gl::makeVertexArray(api_);
            api_.ProgramUniform2f(program_.name(), gl::uniformLocation(api_, program_, "perPixel"),
                                  2.0F / static_cast<float>(rows_), 2.0F / static_cast<float>(slabThickness));
        }
    }

    BitGrid run()
    {
        parities_ = paritiesAlongX(triangles_, words_, planeWords_, interrupter_);
        for (int slab = 0; slab < triangles_.slabCount(); ++slab) {
            const int percent = 10 + 70 * slab / triangles_.slabCount();
            throwIfInterrupted(interrupter_, percent);
            findCrossings(slab, percent);
            vote(slab);
        }
        fillEnclosed(grid_, interrupter_);
        return std::move(grid_);
    }

private:
    void setUniform(const char* name, int value)
    {
        api_.ProgramUniform1i(program_.name(), gl::uniformLocation(api_, program_, name), value);
    }

    /// Fills the planes of the slab in the grid, and crossings_.
    void findCrossings(int slab, int percent)
    {
        const Span planes = triangles_.planes(slab);
        setUniform("firstPlane", planes.first);
        api_.ClearNamedBufferData(bits_.name(), GL_R32UI, GL_RED_INTEGER, GL_UNSIGNED_INT, nullptr);
        std::vector<Item> batch;
        batch.reserve(std::min(batchSize, 2 * triangles_.size(slab)));
        const auto flush = [&] {
            throwIfInterrupted(interrupter_, percent);
            scan(batch);
            batch.clear();
        };
        for (std::size_t i = 0; i < triangles_.size(slab); ++i) {
            cut(triangles_.triangle(slab, i), triangles_.counted(slab, i), planes, [&](const Item& item) {
                batch.push_back(item);
                if (batch.size() == batchSize) flush();
            });
        }
        if (!batch.empty()) flush();

        api_.MemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
        const std::size_t used = planeWords_ * static_cast<std::size_t>(planes.last - planes.first + 1);
        read(0, grid_.row(planes.first, 0), used);
        read(slabWords_, crossings_.data(), 3 * slabWords_);
        gl::throwIfFailed(api_, "voxelizing");
    }

    void scan(const std::vector<Item>& batch)
    {
        const auto count = static_cast<GLsizei>(batch.size());
        api_.NamedBufferSubData(items_.name(), 0, static_cast<GLsizeiptr>(batch.size() * sizeof(Item)), batch.data());
        api_.UseProgram(program_.name());
        api_.BindBufferBase(GL_SHADER_STORAGE_BUFFER, 0, items_.name());
        if (raster_) {
            api_.BindImageTexture(0, image_.name(), 0, GL_FALSE, 0, GL_READ_WRITE, GL_R32UI);
            api_.BindFramebuffer(GL_FRAMEBUFFER, picture_.name());
            api_.BindVertexArray(noVertices_.name());
            api_.Viewport(0, 0, rows_, triangles_.slabThickness());
            api_.DrawArrays(GL_TRIANGLES, 0, 6 * count);
            api_.Finish(); // llvmpipe does not wait for fragments that still read the items when these change
        } else {
            constexpr GLsizei groupSize = 64;
            setUniform("itemCount", count);
            api_.BindBufferBase(GL_SHADER_STORAGE_BUFFER, 1, bits_.name());
            api_.DispatchCompute(static_cast<GLuint>((count + groupSize - 1) / groupSize), 1, 1);
        }
        gl::throwIfFailed(api_, "voxelizing");
    }

    void read(std::size_t first, Word* words, std::size_t count)
    {
        api_.GetNamedBufferSubData(bits_.name(), static_cast<GLintptr>(first * sizeof(Word)),
                                   static_cast<GLsizeiptr>(count * sizeof(Word)), words);
    }

    Word* entering(int slab) { return parities_.data() + static_cast<std::size_t>(slab) * planeWords_; }

    void vote(int index)
    {
        Slab slab;
        slab.planes = triangles_.planes(index);
        slab.rowsPerPlane = rows_;
        slab.wordsPerRow = words_;
        slab.surface = grid_.row(slab.planes.first, 0);
        for (std::size_t axis = 0; axis < 3; ++axis) slab.crossings[axis] = crossings_.data() + axis * slabWords_;
        voteInside(slab, entering(index), entering(triangles_.slabCount()), interrupter_);
    }

    const gl::Api& api_;
    const bool raster_;
    const gl::ProgramObject& program_;
    Interrupter* interrupter_;
    const SlabbedTriangles triangles_;
    BitGrid grid_;
    const int rows_, words_;
    const std::size_t planeWords_, slabWords_;
    const gl::Buffer items_, bits_;
    gl::Texture image_;       ///< bits_ for the raster path
    gl::Framebuffer picture_; ///< a pixel for each column
    gl::VertexArray noVertices_;
    std::vector<Word> crossings_; ///< of the slab that was read last
    std::vector<Word> parities_;  ///< along x, with which rays enter each slab, and leave the last
};

gl::ProgramObject compile(const gl::Api& api, GlVoxelizer::Path path)
{
    if (path == GlVoxelizer::Path::raster) return gl::makeProgram(api, {shaders::columnsVert, shaders::columnsFrag});
    return gl::makeProgram(api, {shaders::columnsComp});
}

} // namespace

GlVoxelizer::GlVoxelizer(const gl::Api& api, Path path, std::size_t gridBytes)
    : api_(api), path_(path), gridBytes_(gridBytes), program_(compile(api, path))
{
    GLint64 words = 0, bytes = 0;
    api_.GetInteger64v(GL_MAX_TEXTURE_BUFFER_SIZE, &words);
    api_.GetInteger64v(GL_MAX_SHADER_STORAGE_BLOCK_SIZE, &bytes);
    const GLint64 most = path == Path::raster ? 4 * words : bytes;
    gridBytes_ = std::min(gridBytes_, static_cast<std::size_t>(std::max<GLint64>(most, 0)));
}

BitGrid GlVoxelizer::run(const Mesh& model, const Frame& frame, Interrupter* interrupter) const
{
    const openvdb::Coord size = frame.voxels.dim();
    const auto rowWords = static_cast<std::size_t>((size.z() + BitGrid::wordBits - 1) / BitGrid::wordBits);
    const std::size_t planeBytes = grids * sizeof(Word) * rowWords * static_cast<std::size_t>(size.y());
    const auto mostPlanes = static_cast<int>(std::min(gridBytes_ / planeBytes, static_cast<std::size_t>(size.x())));
    if (mostPlanes == 0) throw DeviceError("OpenGL: the device has too small buffers for a plane of this many voxels");
    const int slabs = (size.x() + mostPlanes - 1) / mostPlanes;
    return GlRun(api_, path_, program_, model, frame, (size.x() + slabs - 1) / slabs, interrupter).run();
}

namespace {

BitGrid voxelizeThrough(gl::OffscreenContext::Source source, const Mesh& model, const Frame& frame,
                        Interrupter* interrupter)
{
    // Isolated: a thread that waits here must not begin another model, for which it would need another context.
    return tbb::this_task_arena::isolate([&] {
        const gl::OffscreenContext context(gl::OffscreenContext::Debug::off, source);
        const auto current = context.makeCurrent();
        return GlVoxelizer(context.api(), GlVoxelizer::Path::compute).run(model, frame, interrupter);
    });
}

} // namespace

BitGrid voxelizeGl(const Mesh& model, const Frame& frame, Interrupter* interrupter)
{
    return voxelizeThrough(gl::OffscreenContext::Source::any, model, frame, interrupter);
}

BitGrid voxelizeGlHardware(const Mesh& model, const Frame& frame, Interrupter* interrupter)
{
    return voxelizeThrough(gl::OffscreenContext::Source::hardware, model, frame, interrupter);
}

} // namespace vdbcage::detail
