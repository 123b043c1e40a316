#include <vdbcage/voxelize/detail/frame.h>

#include <algorithm>
#include <cmath>
#include <sstream>

#include <tbb/blocked_range.h>
#include <vdbcage/core/detail/parallel.h>
#include <vdbcage/core/error.h>

namespace vdbcage::detail {

namespace {

constexpr double smallestSide = 1e-100, largestSide = 1e100;
// The least ratio of a voxel to a coordinate: the transform's translation is then rounded by at most 2^-53 * 2 * 2^37
// voxels, a quarter of a lattice unit (2^-16 voxel).
constexpr double smallestVoxel = 0x1p-37;

int latticeCoordinate(double coordinate, double center, double voxelSize, int resolution)
{
    const int last = resolution << latticeBits;
    const double value = (coordinate - center) / voxelSize * latticeStep + 0.5 * last + 0.5;
    return value > 0 ? (value < last ? static_cast<int>(value) : last) : 0; // 0 also for a NaN
}

} // namespace

Frame makeFrame(const Mesh& model, int resolution, const std::optional<openvdb::BBoxd>& given)
{
    const openvdb::BBoxd own = boundingBox(model), box = given.value_or(own);
    for (int axis = 0; axis < 3; ++axis) {
        if (own.min()[axis] >= box.min()[axis] && own.max()[axis] <= box.max()[axis]) continue;
        throw InputError("model", "its bounding box is not within the box given for the voxels");
    }
    const openvdb::Vec3d sides = box.max() - box.min();
    const double side = std::max({sides.x(), sides.y(), sides.z()});
    if (!(side >= smallestSide && side <= largestSide)) {
        std::ostringstream text;
        text << "its longest side is " << side << "; " << smallestSide << " to " << largestSide << " is allowed";
        throw InputError("model", text.str());
    }
    double farthest = 0;
    for (int axis = 0; axis < 3; ++axis) {
        farthest = std::max({farthest, std::abs(box.min()[axis]), std::abs(box.max()[axis])});
    }
    Frame frame;
    frame.resolution = resolution;
    frame.voxelSize = side / resolution;
    frame.center = 0.5 * box.min() + 0.5 * box.max();
    if (frame.voxelSize < smallestVoxel * farthest) {
        std::ostringstream text;
        text << "its longest side is " << side << ", too small for a coordinate of " << farthest << "; at resolution "
             << resolution << " it must be at least " << smallestVoxel * farthest * resolution
             << " (move the model towards the origin)";
        throw InputError("model", text.str());
    }
    const auto lattice = [&](const openvdb::Vec3d& p, int axis) {
        return latticeCoordinate(p[axis], frame.center[axis], frame.voxelSize, resolution);
    };
    openvdb::Coord low, high;
    for (int axis = 0; axis < 3; ++axis) {
        const auto i = static_cast<std::size_t>(axis); // the index in OpenVDB's Coord, unlike its vectors
        low[i] = (lattice(box.min(), axis) - latticeBound + latticeStep - 1) >> latticeBits;
        high[i] = (lattice(box.max(), axis) + latticeBound) >> latticeBits;
    }
    frame.voxels = openvdb::CoordBBox(low, high);
    return frame;
}

openvdb::math::Transform::Ptr makeTransform(const Frame& frame)
{
    using openvdb::Vec3d;
    using Map = openvdb::math::UniformScaleTranslateMap;
    const Vec3d scale(frame.voxelSize), inverse(1 / frame.voxelSize);
    const Vec3d translation = frame.center - Vec3d(0.5 * frame.resolution * frame.voxelSize);

    // OpenVDB refuses to make a map whose determinant is below 3e-15, but not to read one.
    std::stringstream stream;
    for (const Vec3d& value : {translation, scale, scale, inverse, inverse * inverse, 0.5 * inverse}) {
        value.write(stream);
    }
    const openvdb::math::MapBase::Ptr map(new Map(2, Vec3d(1)));
    auto transform = std::make_shared<openvdb::math::Transform>(map);
    transform->map<Map>()->read(stream);
    return transform;
}

std::vector<openvdb::Vec3i> latticePoints(const Mesh& model, const Frame& frame)
{
    std::vector<openvdb::Vec3i> lattice(model.points.size());
    parallelFor(tbb::blocked_range<std::size_t>(0, lattice.size(), 4096), [&](const auto& range) {
        for (std::size_t i = range.begin(); i != range.end(); ++i) {
            for (int axis = 0; axis < 3; ++axis) {
                lattice[i][axis] =
                    latticeCoordinate(model.points[i][axis], frame.center[axis], frame.voxelSize, frame.resolution);
            }
        }
    });
    return lattice;
}

} // namespace vdbcage::detail
