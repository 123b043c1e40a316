#include <tools/draw/frame.h>

#include <algorithm>
#include <cmath>

namespace vdbcage::draw {

using openvdb::Vec3d;

namespace {

Vec3d timesPowerOfTwo(const Vec3d& point, int exponent)
{
    return {std::ldexp(point.x(), exponent), std::ldexp(point.y(), exponent), std::ldexp(point.z(), exponent)};
}

} // namespace

Frame::Frame(const openvdb::BBoxd& box)
{
    double largest = 0;
    for (int i = 0; i < 3; ++i) largest = std::max({largest, std::abs(box.min()[i]), std::abs(box.max()[i])});
    // Coordinates of at most magnitude 1 keep later steps from overflow and underflow.
    std::frexp(largest, &exponent_);
    const Vec3d min = timesPowerOfTwo(box.min(), -exponent_);
    const Vec3d max = timesPowerOfTwo(box.max(), -exponent_);
    centre_ = 0.5 * (min + max);
    const double length = 0.5 * (max - min).length();
    if (length > 0) radius_ = length;
}

Vec3d Frame::toDrawing(const Vec3d& worldPoint) const
{
    return (timesPowerOfTwo(worldPoint, -exponent_) - centre_) / radius_;
}

double Frame::unit() const
{
    return std::ldexp(radius_, exponent_);
}

Vec3d Frame::toWorld(const Vec3d& drawnPoint) const
{
    return timesPowerOfTwo(drawnPoint * radius_ + centre_, exponent_);
}

} // namespace vdbcage::draw
