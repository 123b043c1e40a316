#pragma once

#include <random>

#include <support/shapes.h>
#include <tools/edit/elements.h>
#include <vdbcage/mesh/mesh.h>

namespace vdbcage::test {

/// Any faces on few points: edges of one face and of many, either way, faces that repeat corners.
inline Mesh randomFaces(unsigned seed)
{
    std::mt19937 random(seed);
    const unsigned points = 2 + seed % 23;
    std::uniform_int_distribution<openvdb::Index32> any(0, points - 1);
    std::uniform_real_distribution<double> real(-1, 1);
    Mesh mesh;
    for (unsigned i = 0; i < points; ++i) mesh.points.emplace_back(real(random), real(random), real(random));
    for (unsigned i = 0; i < 1 + seed % 31; ++i) mesh.triangles.emplace_back(any(random), any(random), any(random));
    for (unsigned i = 0; i < seed % 17; ++i) {
        mesh.quads.emplace_back(any(random), any(random), any(random), any(random));
    }
    return mesh;
}

/// A torus whose quads are each cut in two: every point has six edges.
inline Mesh triangulatedTorus(int around, int across)
{
    Mesh mesh = torus(2, 0.5, around, across);
    mesh.triangles = triangulate(mesh);
    mesh.quads.clear();
    return mesh;
}

/// Some of the elements of a kind, about one in `share`; only points that faces use.
inline edit::Selection someOf(const edit::Elements& elements, edit::Element kind, std::mt19937& random,
                              unsigned share = 3)
{
    edit::Selection selection{kind, {}};
    for (edit::Index id = 0; id < elements.count(kind); ++id) {
        const bool isThere = kind != edit::Element::point || elements.isUsed(id);
        if (isThere && random() % share == 0) selection.ids.push_back(id);
    }
    return selection;
}

constexpr edit::Element elementKinds[] = {edit::Element::point, edit::Element::edge, edit::Element::face};

} // namespace vdbcage::test
