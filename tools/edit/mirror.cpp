#include <tools/edit/mirror.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <tuple>
#include <utility>

#include <vdbcage/core/detail/number_text.h>
#include <vdbcage/core/error.h>

namespace vdbcage::edit {

namespace {

using openvdb::Vec3d;

void requirePlane(int axis, double place)
{
    if (axis < 0 || axis > 2) {
        throw InputError("mirror", "the axis is " + std::to_string(axis) + "; it must be 0, 1 or 2");
    }
    if (!std::isfinite(place)) {
        throw InputError("mirror", "the plane is at " + detail::numberText(place) + "; it must be finite");
    }
}

/// Returns two coordinates that are each other's mirror images: `x`, rounded if need be, and the other one.
std::pair<double, double> mutualImages(double x, double place)
{
    double image = mirroredCoordinate(x, place);
    // After one rounding the distance to the plane has so few bits that the next image is exact, except in rare ties.
    for (int i = 0; i < 4 && mirroredCoordinate(image, place) != x; ++i) {
        x = mirroredCoordinate(image, place);
        image = mirroredCoordinate(x, place);
    }
    return {x, image};
}

} // namespace

double mirroredCoordinate(double x, double place)
{
    return 2 * place - x;
}

std::vector<Index> mirrorPartners(const std::vector<Vec3d>& points, int axis, double place)
{
    requirePlane(axis, place);
    struct Place {
        Vec3d at;
        Index point;

        auto key() const { return std::make_tuple(at.x(), at.y(), at.z(), point); }
        bool operator<(const Place& other) const { return key() < other.key(); }
    };
    std::vector<Place> places, images;
    for (Index i = 0; i < points.size(); ++i) {
        if (!points[i].isFinite()) continue;
        Vec3d image = points[i];
        image[axis] = mirroredCoordinate(image[axis], place);
        places.push_back({points[i], i});
        images.push_back({image, i});
    }
    std::sort(places.begin(), places.end());
    std::sort(images.begin(), images.end());
    const auto isBefore = [](const Place& a, const Place& b) {
        return std::make_tuple(a.at.x(), a.at.y(), a.at.z()) < std::make_tuple(b.at.x(), b.at.y(), b.at.z());
    };
    std::vector<Index> found(points.size(), none);
    auto at = places.begin();
    for (auto image = images.begin(); image != images.end() && at != places.end();) {
        if (isBefore(*image, *at)) {
            ++image;
        } else if (isBefore(*at, *image)) {
            ++at;
        } else {
            found[(image++)->point] = (at++)->point;
        }
    }
    // A partner that rounding makes one-sided is dropped.
    std::vector<Index> partners(points.size(), none);
    for (Index i = 0; i < points.size(); ++i) {
        if (found[i] != none && found[found[i]] == i) partners[i] = found[i];
    }
    return partners;
}

std::vector<Vec3d> mirrored(const std::vector<Vec3d>& before, std::vector<Vec3d> after, const std::vector<Index>& moved,
                            const std::vector<Index>& partners, int axis, double place)
{
    requirePlane(axis, place);
    if (before.size() != after.size() || before.size() != partners.size()) {
        throw InputError("mirror", "there are " + std::to_string(before.size()) + " points before, " +
                                       std::to_string(after.size()) + " after and " + std::to_string(partners.size()) +
                                       " partners; as many are needed");
    }
    std::vector<char> isMoved(before.size(), 0);
    for (const Index point : moved) isMoved[point] = 1;
    const auto leads = [&](Index point, Index partner) {
        const double own = before[point][axis], other = before[partner][axis];
        return !isMoved[partner] || own > other || (own == other && point < partner);
    };
    for (const Index point : moved) {
        const Index partner = partners[point];
        if (partner == none) continue;
        if (partner == point) {
            after[point][axis] = place;
        } else if (leads(point, partner)) {
            const auto [own, image] = mutualImages(after[point][axis], place);
            after[point][axis] = own;
            after[partner] = after[point];
            after[partner][axis] = image;
        }
    }
    return after;
}

} // namespace vdbcage::edit
