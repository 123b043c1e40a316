#include <vdbcage/volume/detail/sphere/radius_field.h>

#include <algorithm>
#include <cmath>
#include <sstream>

#include <vdbcage/core/detail/parallel.h>
#include <vdbcage/core/error.h>
#include <vdbcage/volume/detail/factor_at.h>
#include <vdbcage/volume/detail/mask_blocks.h>

namespace vdbcage::detail {

namespace {

using openvdb::BBoxd;
using openvdb::CoordBBox;
using openvdb::Vec3d;

constexpr double largestRadius = 512;
// Less than the half voxel a step that leastRadii() assumes, by more than the rounding of floats.
constexpr double steepest = 0.499;

int spacingShift(double radius)
{
    return radius < 8 ? 0 : radius < 16 ? 1 : radius < 32 ? 2 : 3;
}

// Returns by square the least radius with this property: for a voxel q with it, each g at that squared distance is
// within the radius of one of q's neighbours with half a voxel less, if that neighbour's square obeys the same rule.
std::vector<double> leastRadii(int largest)
{
    const auto size = static_cast<std::size_t>(largest * largest) + 1;
    std::vector<double> least(size);
    constexpr int far = 144; // from here on a step gains more than half a voxel in any direction
    for (int square = 1; square < static_cast<int>(size); ++square) {
        // A square stands for all smaller ones, too.
        double radius = std::max(std::sqrt(static_cast<double>(square)), least[static_cast<std::size_t>(square - 1)]);
        for (int x = 1; square <= far && x * x <= square; ++x) {
            for (int y = 0; y <= x && x * x + y * y <= square; ++y) {
                const int rest = square - x * x - y * y, z = static_cast<int>(std::lround(std::sqrt(rest)));
                if (z > y || z * z != rest || x + y + z < 2) continue;
                radius = std::max(radius, least[static_cast<std::size_t>(square - 2 * x + 1)] + 0.5);
            }
        }
        least[static_cast<std::size_t>(square)] = radius;
    }
    return least;
}

// Returns the largest value of a grid, clamped to the allowed ones. Checks that all are finite.
double largestValue(const openvdb::FloatGrid& grid, const Progress& progress)
{
    float largest = grid.background();
    std::size_t count = 0;
    for (auto value = grid.cbeginValueAll(); value; ++value) {
        if (count++ % 4096 == 0) progress.check(0, 1);
        if (!std::isfinite(*value)) throw InputError("the scale field has a value that is not finite");
        largest = std::max(largest, *value);
    }
    return std::clamp(static_cast<double>(largest), 0.0, largestFactor);
}

void expand(BBoxd& box, const openvdb::math::Transform& voxels, const Vec3d& lower, const Vec3d& upper)
{
    for (int corner = 0; corner < 8; ++corner) {
        const Vec3d world((corner & 1 ? upper : lower).x(), (corner & 2 ? upper : lower).y(),
                          (corner & 4 ? upper : lower).z());
        box.expand(voxels.worldToIndex(world));
    }
}

// Returns the box where the field may differ from its outside, in the index space of `voxels`.
BBoxd extentOf(const FactorField& scale, const openvdb::math::Transform& voxels)
{
    BBoxd box;
    for (const FactorRegion& region : scale.regions) {
        requireValid(region);
        if (region.shape == FactorRegion::Shape::box) {
            expand(box, voxels, region.lower, region.upper);
        } else {
            expand(box, voxels, region.lower - Vec3d(region.radius), region.lower + Vec3d(region.radius));
        }
    }
    if (scale.grid) {
        if (!scale.grid->transform().isLinear()) {
            throw InputError("the transform of the scale field must be linear");
        }
        CoordBBox active, leaves;
        isolated([&] { scale.grid->tree().evalActiveVoxelBoundingBox(active); });
        scale.grid->tree().evalLeafBoundingBox(leaves);
        active.expand(leaves);
        if (!active.empty()) {
            // Not with coordinates: the field may extend to their limits.
            const Vec3d lower = active.min().asVec3d() - Vec3d(1), upper = active.max().asVec3d() + Vec3d(1);
            for (int corner = 0; corner < 8; ++corner) {
                const Vec3d index((corner & 1 ? upper : lower).x(), (corner & 2 ? upper : lower).y(),
                                  (corner & 4 ? upper : lower).z());
                box.expand(voxels.worldToIndex(scale.grid->transform().indexToWorld(index)));
            }
        }
    }
    return box;
}

} // namespace

RadiusField::RadiusField(const FactorField& scale, const openvdb::math::Transform& voxels, double radius,
                         const CoordBBox& box, const Progress& progress)
    : shift_(spacingShift(radius))
{
    const double background = scale.grid ? static_cast<double>(scale.grid->background()) : 1.0;
    if (!std::isfinite(background)) throw InputError("the background of the scale field is not finite");
    outside_ = static_cast<float>(radius * std::clamp(background, 0.0, largestFactor));
    largest_ = radius * std::clamp(background, 0.0, largestFactor);
    BBoxd extent = extentOf(scale, voxels);
    if (!box.empty() && !extent.empty()) {
        // A small radius spreads until it has grown to the largest one, from beyond the box, too.
        double scales = scale.grid ? largestValue(*scale.grid, progress) : 1.0;
        for (const FactorRegion& region : scale.regions) scales *= std::max(1.0, region.factor);
        const double most = radius * std::min(scales, largestFactor);
        if (most > largestRadius) {
            std::ostringstream text;
            text << "the radius times the largest scale of the field is " << most << " voxels; it must be at most "
                 << largestRadius;
            throw InputError(text.str());
        }
        const double spread = most / steepest + 2 * (1 << shift_);
        BBoxd around(box.min().asVec3d(), box.max().asVec3d());
        around.expand(spread + most + 2); // radii are needed as far from the box as they are long
        extent.expand(spread);
        double count = 1;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const int i = static_cast<int>(axis); // the index in OpenVDB's vectors, unlike its Coord
            const double lower = std::max(around.min()[i], extent.min()[i]),
                         upper = std::min(around.max()[i], extent.max()[i]);
            if (lower > upper) return;
            const double unit = 1 << shift_;
            first_[axis] = static_cast<int>(std::floor(lower / unit));
            size_[axis] = static_cast<int>(std::ceil(upper / unit)) + 1 - first_[axis];
            count *= size_[axis];
        }
        if (count > 1 << 28) {
            std::ostringstream text;
            text << "the scale field needs " << count << " samples; there may be 2^28";
            throw InputError(text.str());
        }
        sample(scale, voxels, radius, progress.part(0, 3));
        clamp(progress.part(1, 3));
        if (std::all_of(nodes_.begin(), nodes_.end(), [&](float r) { return r == outside_; })) {
            nodes_.clear();
            nodes_.shrink_to_fit();
        }
    }
    for (const float node : nodes_) largest_ = std::max(largest_, static_cast<double>(node));
    if (!isUniform()) {
        leastRadius_ = leastRadii(static_cast<int>(largest_) + 1);
        findRanges(progress.part(2, 3));
    }
}

void RadiusField::sample(const FactorField& scale, const openvdb::math::Transform& voxels, double radius,
                         const Progress& progress)
{
    nodes_.resize(static_cast<std::size_t>(size_.x()) * static_cast<std::size_t>(size_.y()) *
                  static_cast<std::size_t>(size_.z()));
    const openvdb::FloatGrid none(1.0F), &grid = scale.grid ? *scale.grid : none;
    parallelFor(0, size_.x(), [&](int x) {
        const auto accessor = grid.getConstAccessor();
        for (int y = 0; y < size_.y(); ++y) {
            progress.check(static_cast<std::size_t>(x), static_cast<std::size_t>(size_.x()));
            for (int z = 0; z < size_.z(); ++z) {
                const Coord c = first_ + Coord(x, y, z);
                const Vec3d world = voxels.indexToWorld(c.asVec3d() * static_cast<double>(1 << shift_));
                nodes_[node({x, y, z})] = static_cast<float>(radius * factorAt(scale, &accessor, world));
            }
        }
    });
}

// Sets each node to the least of all nodes' radii, each plus the steepest growth along the axes on the way from there.
void RadiusField::clamp(const Progress& progress)
{
    const auto growth = static_cast<float>(steepest * (1 << shift_));
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const std::size_t u = (axis + 1) % 3, v = (axis + 2) % 3;
        parallelFor(0, size_[u], [&](int i) {
            for (int j = 0; j < size_[v]; ++j) {
                if (j % 16 == 0) progress.check(axis, 3);
                Coord c;
                c[u] = i;
                c[v] = j;
                float least = outside_; // the radius beyond the nodes grows in the same way
                const auto pass = [&](int k) {
                    c[axis] = k;
                    float& value = nodes_[node(c)];
                    least = std::min(value, least + growth);
                    value = least;
                };
                for (int k = 0; k < size_[axis]; ++k) pass(k);
                least = outside_;
                for (int k = size_[axis]; k-- > 0;) pass(k);
            }
        });
    }
}

float RadiusField::radiusAt(const Coord& voxel) const
{
    const Coord cell(voxel.x() >> shift_, voxel.y() >> shift_, voxel.z() >> shift_), place = cell - first_;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        if (place[axis] < 0 || place[axis] + 1 >= size_[axis]) return outside_;
    }
    const float unit = 1.0F / static_cast<float>(1 << shift_);
    const auto weight = [&](std::size_t axis) { return static_cast<float>(voxel[axis] & ((1 << shift_) - 1)) * unit; };
    const auto mix = [](float a, float b, float t) { return a + (b - a) * t; };
    const std::size_t corner = node(place), y = static_cast<std::size_t>(size_.z()),
                      x = y * static_cast<std::size_t>(size_.y());
    const float tx = weight(0), ty = weight(1), tz = weight(2);
    const auto alongZ = [&](std::size_t i) { return mix(nodes_[i], nodes_[i + 1], tz); };
    const auto alongYZ = [&](std::size_t i) { return mix(alongZ(i), alongZ(i + y), ty); };
    return mix(alongYZ(corner), alongYZ(corner + x), tx);
}

std::int32_t RadiusField::squareOf(double radius) const
{
    auto square = static_cast<std::int32_t>(std::min(radius * radius, static_cast<double>(leastRadius_.size()) - 1));
    while (square > 0 && leastRadius_[static_cast<std::size_t>(square)] > radius) --square;
    return square;
}

std::int32_t RadiusField::square(const Coord& voxel, double factor) const
{
    return squareOf(static_cast<double>(radiusAt(voxel)) * factor);
}

void RadiusField::findRanges(const Progress& progress)
{
    const int perEntry = leafSize >> shift_;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        firstEntry_[axis] = (first_[axis] * (1 << shift_)) >> 3;
        entries_[axis] = (((first_[axis] + size_[axis] - 1) * (1 << shift_)) >> 3) + 1 - firstEntry_[axis];
    }
    ranges_.resize(static_cast<std::size_t>(entries_.x()) * static_cast<std::size_t>(entries_.y()) *
                   static_cast<std::size_t>(entries_.z()));
    parallelFor(0, entries_.x(), [&](int x) {
        for (int y = 0; y < entries_.y(); ++y) {
            progress.check(static_cast<std::size_t>(x), static_cast<std::size_t>(entries_.x()));
            for (int z = 0; z < entries_.z(); ++z) {
                Coord corner = firstEntry_ + Coord(x, y, z); // then its first node
                for (std::size_t axis = 0; axis < 3; ++axis)
                    corner[axis] = ((corner[axis] * leafSize) >> shift_) - first_[axis];
                Range range{outside_, outside_};
                bool isFirst = true;
                for (auto c = CoordBBox(corner, corner.offsetBy(perEntry)).begin(); c; ++c) {
                    bool isNode = true;
                    for (std::size_t axis = 0; axis < 3; ++axis)
                        isNode = isNode && (*c)[axis] >= 0 && (*c)[axis] < size_[axis];
                    const float value = isNode ? nodes_[node(*c)] : outside_;
                    range.least = isFirst ? value : std::min(range.least, value);
                    range.most = isFirst ? value : std::max(range.most, value);
                    isFirst = false;
                }
                ranges_[(static_cast<std::size_t>(x) * static_cast<std::size_t>(entries_.y()) +
                         static_cast<std::size_t>(y)) *
                            static_cast<std::size_t>(entries_.z()) +
                        static_cast<std::size_t>(z)] = range;
            }
        }
    });
}

RadiusField::Range RadiusField::rangeOfEntry(const Coord& origin) const
{
    const Coord entry = Coord(origin.x() >> 3, origin.y() >> 3, origin.z() >> 3) - firstEntry_;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        if (entry[axis] < 0 || entry[axis] >= entries_[axis]) return {outside_, outside_};
    }
    return ranges_[(static_cast<std::size_t>(entry.x()) * static_cast<std::size_t>(entries_.y()) +
                    static_cast<std::size_t>(entry.y())) *
                       static_cast<std::size_t>(entries_.z()) +
                   static_cast<std::size_t>(entry.z())];
}

} // namespace vdbcage::detail
