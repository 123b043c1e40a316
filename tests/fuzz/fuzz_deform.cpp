// Random cages, also squeezed, folded, huge and tiny ones, and points in, on and near them, for any family and
// material: coordinates are one line of objection, or finite weights that reproduce the points. Bound to them, points
// at rest stay where they are, and random poses are finite.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string_view>

#include <deform/cages.h>
#include <fuzz/bytes.h>
#include <vdbcage/core/error.h>
#include <vdbcage/deform/binding.h>

using namespace vdbcage;
using fuzz::Choices;
using fuzz::require;
using openvdb::Vec3d;

namespace {

Mesh cageOf(Choices& choices)
{
    Mesh cage = test::randomCage(test::kinds[choices.below(3)], static_cast<std::uint32_t>(choices.below(8)),
                                 0.4 * choices.share());
    const auto anyPoint = [&]() -> Vec3d& {
        return cage.points[static_cast<std::size_t>(choices.below(static_cast<int>(cage.points.size())))];
    };
    for (int i = choices.below(5); i > 0; --i) {
        Vec3d& point = anyPoint();
        switch (choices.below(3)) {
        case 0: // two points nearly at one place: edges and faces of no size
            point = anyPoint() + choices.small() * choices.direction();
            break;
        case 1:
            point += choices.small() * choices.direction();
            break;
        default: // flat, or nearly
            point[choices.below(3)] = choices.small();
        }
    }
    return cage;
}

Vec3d pointOf(Choices& choices, const Mesh& cage)
{
    if (choices.below(4) == 0) return 0.5 * choices.direction();
    if (choices.below(32) == 0) return Vec3d(choices.below(2) ? std::numeric_limits<double>::quiet_NaN() : 1e300);
    std::vector<openvdb::Vec3I> triangles = cage.triangles;
    for (const openvdb::Vec4I& q : cage.quads) triangles.emplace_back(q[0], q[1], q[2]);
    const openvdb::Vec3I& t = triangles[static_cast<std::size_t>(choices.below(static_cast<int>(triangles.size())))];
    const double u = choices.below(3) == 0 ? 0 : choices.share(), v = choices.below(3) == 0 ? 0 : choices.share();
    const Vec3d on = (1 - u) * cage.points[t[0]] + u * ((1 - v) * cage.points[t[1]] + v * cage.points[t[2]]);
    return choices.below(4) == 0 ? on : on + choices.small() * choices.direction();
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    Choices choices(data, size);
    const auto families = static_cast<int>(coordinateFamilies().size());
    const FamilyInfo& family = coordinateFamilies()[static_cast<std::size_t>(choices.below(families))];
    CoordinateOptions options(family.family, 4 + choices.below(9));
    options.elasticity.nu = 0.499 - 1.49 * choices.share();
    if (choices.below(2) == 0) options.elasticity.rotations = Elasticity::Rotations::local;
    if (choices.below(2) == 0) options.elasticity.localBulging = 100 * choices.share();
    if (choices.below(2) == 0) options.elasticity.globalBulging = 100 * choices.share();
    Mesh cage = cageOf(choices);
    std::vector<Vec3d> points;
    for (int i = 1 + choices.below(11); i > 0; --i) points.push_back(pointOf(choices, cage));
    const double scale = choices.below(4) == 0 ? std::pow(10.0, 120 * choices.share() - 60) : 1;
    for (Vec3d& p : cage.points) p *= scale;
    for (Vec3d& p : points) p *= scale;

    std::vector<double> rows;
    try {
        rows = computeCoordinates(cage, points, options);
    } catch (const InputError& error) {
        require(std::string_view(error.what()).find('\n') == std::string_view::npos);
        return 0;
    }
    const std::vector<Vec3d> handles = cageHandles(cage, cage.points, options);
    require(rows.size() == points.size() * handles.size());
    const bool isPositive = family.family == Coordinates::maximumLikelihood || family.family == Coordinates::harmonic;
    for (std::size_t i = 0; i < points.size(); ++i) {
        const double* const row = rows.data() + i * handles.size();
        double sum = 0;
        Vec3d place(0);
        for (std::size_t k = 0; k < handles.size(); ++k) {
            require(std::isfinite(row[k]) && (!isPositive || row[k] >= 0));
            if (k < cage.points.size()) sum += row[k];
            place += row[k] * handles[k];
        }
        require(std::abs(sum - 1) < 1e-9);
        require((place - points[i]).length() < 1e-7 * test::longestSide(cage));
    }
    std::vector<Vec3d> posed = cage.points;
    for (Vec3d& p : posed) {
        if (choices.below(3) == 0) p += scale * choices.share() * choices.direction();
        if (choices.below(16) == 0) p = posed.front();
    }
    for (const Vec3d& handle : cageHandles(cage, posed, options)) {
        for (int axis = 0; axis < 3; ++axis) require(std::isfinite(handle[axis]));
    }
    const Binding binding(cage, points, options);
    require(binding.pose(cage.points) == points);
    for (const Vec3d& p : binding.pose(posed)) {
        for (int axis = 0; axis < 3; ++axis) require(std::isfinite(p[axis]));
    }
    // A row is of its own point only.
    const std::vector<double> last = computeCoordinates(cage, {points.back()}, options);
    require(std::equal(last.begin(), last.end(), rows.end() - static_cast<std::ptrdiff_t>(last.size())));
    return 0;
}
