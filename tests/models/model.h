#pragma once

#include <array>
#include <filesystem>
#include <string>
#include <vector>

#include "vec3.h"

namespace data {

/// A triangle or quad: indices of its corners, counter-clockwise seen from outside; a triangle's fourth is -1.
using Face = std::array<int, 4>;

/// Lengths are centimetres, Y is up, the front looks along +Z.
struct Model {
    std::vector<Vec3> points;
    std::vector<Face> faces;

    int addPoint(const Vec3& point);
    void addTriangle(int a, int b, int c) { faces.push_back({a, b, c, -1}); }
    /// Starts the quad at the end of its shorter diagonal, along which readers split it.
    void addQuad(int a, int b, int c, int d);
    /// Adds the points and faces of `other` as a part of its own.
    void append(const Model& other);
};

/// Removes the points that no face uses; the others keep their order.
void removeUnusedPoints(Model& model);

/// Writes an OBJ file: `about` as a comment, then points rounded to 1e-6, then faces.
/// \throw std::runtime_error naming the path
void writeObj(const Model& model, const std::string& about, const std::filesystem::path& path);

// The models, one file each.
Model makeBishop();
Model makeBench();
Model makeBotijo();
Model makeCreature();
Model makeCreature2m();
Model makeOpenShell();
Model makeSoup();

} // namespace data
