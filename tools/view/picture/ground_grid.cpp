#include <tools/view/picture/ground_grid.h>

#include <cmath>
#include <utility>
#include <vector>

namespace vdbcage::view {

using openvdb::Vec3d;

namespace {

/// Returns 1, 2 or 5 times a power of ten, at least `least`.
double roundStep(double least)
{
    const double power = std::pow(10.0, std::floor(std::log10(least)));
    for (const double step : {1.0, 2.0, 5.0}) {
        if (step * power >= least) return step * power;
    }
    return 10 * power;
}

} // namespace

void GroundGrid::fill(const gl::Api& api, const draw::Frame& frame, const openvdb::BBoxd& box, draw::UpAxis up)
{
    const int height = up == draw::UpAxis::y ? 1 : 2;
    const int first = up == draw::UpAxis::y ? 2 : 0, second = up == draw::UpAxis::y ? 0 : 1;
    double radius = 0.5 * box.extents().length();
    if (!(radius > 0 && std::isfinite(radius))) radius = 1;
    step_ = roundStep(radius / 6);
    const int reach = static_cast<int>(std::ceil(1.5 * radius / step_));
    std::vector<std::pair<Vec3d, Vec3d>> lines;
    const Vec3d middle = 0.5 * (box.min() + box.max());
    for (const auto& [along, across] : {std::pair(first, second), std::pair(second, first)}) {
        const double start = std::round(middle[along] / step_) * step_;
        const double side = std::round(middle[across] / step_) * step_;
        for (int i = -reach; i <= reach; ++i) {
            Vec3d from, to;
            from[height] = to[height] = box.min()[height];
            from[along] = start - reach * step_;
            to[along] = start + reach * step_;
            from[across] = to[across] = side + i * step_;
            lines.emplace_back(from, to);
        }
    }
    shape_.reset();
    shape_.emplace(api, draw::Geometry(lines, frame));
}

} // namespace vdbcage::view
