#include "model.h"

#include <cstdint>
#include <fstream>
#include <stdexcept>

namespace data {

namespace {

/// In millionths, rounded to the nearest and halves away from zero: from here on there is nothing but integers.
std::int64_t millionths(double x)
{
    return static_cast<std::int64_t>(x < 0 ? -std::floor(-x * 1e6 + 0.5) : std::floor(x * 1e6 + 0.5));
}

void appendNumber(std::string& text, double x)
{
    const std::int64_t value = millionths(x);
    const std::uint64_t size = static_cast<std::uint64_t>(value < 0 ? -value : value);
    text += value < 0 ? " -" : " ";
    text += std::to_string(size / 1000000);
    std::string fraction = std::to_string(1000000 + size % 1000000).substr(1);
    fraction.erase(fraction.find_last_not_of('0') + 1);
    if (!fraction.empty()) text += "." + fraction;
}

} // namespace

int Model::addPoint(const Vec3& point)
{
    points.push_back(point);
    return static_cast<int>(points.size()) - 1;
}

void Model::addQuad(int a, int b, int c, int d)
{
    const auto at = [this](int i) { return points[static_cast<std::size_t>(i)]; };
    // Clearly shorter, so that a symmetric quad does not depend on the last bit.
    if (length(at(b) - at(d)) < 0.999999 * length(at(a) - at(c)))
        faces.push_back({b, c, d, a});
    else
        faces.push_back({a, b, c, d});
}

void Model::append(const Model& other)
{
    const int first = static_cast<int>(points.size());
    points.insert(points.end(), other.points.begin(), other.points.end());
    for (Face face : other.faces) {
        for (int& corner : face)
            if (corner >= 0) corner += first;
        faces.push_back(face);
    }
}

void removeUnusedPoints(Model& model)
{
    std::vector<int> renumbered(model.points.size(), -1);
    for (const Face& face : model.faces)
        for (const int corner : face)
            if (corner >= 0) renumbered[static_cast<std::size_t>(corner)] = 0;
    std::vector<Vec3> kept;
    for (std::size_t i = 0; i < renumbered.size(); ++i) {
        if (renumbered[i] < 0) continue;
        renumbered[i] = static_cast<int>(kept.size());
        kept.push_back(model.points[i]);
    }
    model.points = std::move(kept);
    for (Face& face : model.faces)
        for (int& corner : face)
            if (corner >= 0) corner = renumbered[static_cast<std::size_t>(corner)];
}

void writeObj(const Model& model, const std::string& about, const std::filesystem::path& path)
{
    std::string text = "# " + about + "\n# Made by vdbcage-data; centimetres, Y up. Apache-2.0.\n";
    for (const Vec3& point : model.points) {
        text += "v";
        appendNumber(text, point.x);
        appendNumber(text, point.y);
        appendNumber(text, point.z);
        text += "\n";
    }
    for (const Face& face : model.faces) {
        text += "f";
        for (const int corner : face)
            if (corner >= 0) text += " " + std::to_string(corner + 1);
        text += "\n";
    }
    std::ofstream file(path, std::ios::binary);
    file << text;
    file.close();
    if (!file) throw std::runtime_error(path.string() + ": cannot be written");
}

} // namespace data
