// Based on: Dijkstra, A note on two problems in connexion with graphs, Numerische Mathematik 1, 1959.
#include <tools/edit/soft.h>

#include <cmath>
#include <functional>
#include <queue>
#include <string>
#include <utility>

#include <vdbcage/core/detail/number_text.h>
#include <vdbcage/core/error.h>

namespace vdbcage::edit {

namespace {

using openvdb::Vec3d;

/// Returns the distance along the surface to the nearest selected point; infinity if it is at least `farthest`.
std::vector<double> surfaceDistances(const Elements& elements, const std::vector<Vec3d>& points,
                                     const std::vector<Index>& selected, double farthest)
{
    using Reached = std::pair<double, Index>;
    std::priority_queue<Reached, std::vector<Reached>, std::greater<>> front;
    std::vector<double> distances(points.size(), std::numeric_limits<double>::infinity());
    const auto reach = [&](Index point, double distance) {
        if (!(distance < distances[point])) return;
        distances[point] = distance;
        front.emplace(distance, point);
    };
    for (const Index point : selected) reach(point, 0);
    while (!front.empty()) {
        const auto [distance, point] = front.top();
        front.pop();
        if (distance > distances[point]) continue; // a shorter way reached it later
        for (const Index face : elements.facesOfPoint(point)) {
            for (const Index other : elements.pointsOfFace(face)) {
                const double there = distance + (points[other] - points[point]).length();
                if (there < farthest) reach(other, there);
            }
        }
    }
    return distances;
}

} // namespace

std::vector<double> softWeights(const Elements& elements, const std::vector<Vec3d>& points,
                                const std::vector<Index>& selected, double radius)
{
    if (points.size() != elements.count(Element::point)) {
        throw InputError("soft selection", std::to_string(points.size()) + " points were given for a mesh of " +
                                               std::to_string(elements.count(Element::point)) +
                                               "; one for each is needed");
    }
    if (!(radius >= 0 && std::isfinite(radius))) {
        throw InputError("soft selection",
                         "the radius is " + detail::numberText(radius) + "; it must be 0 or more, and finite");
    }
    std::vector<double> weights = surfaceDistances(elements, points, selected, radius);
    for (double& value : weights) {
        const double t = value / radius;
        value = value == 0 ? 1 : value < radius ? (1 - t) * (1 - t) * (1 + 2 * t) : 0;
    }
    return weights;
}

} // namespace vdbcage::edit
