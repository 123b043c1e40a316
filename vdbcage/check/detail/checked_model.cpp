#include <vdbcage/check/detail/checked_model.h>

#include <algorithm>
#include <cmath>
#include <sstream>
#include <string>

#include <vdbcage/check/detail/hollows.h>
#include <vdbcage/check/detail/measures.h>
#include <vdbcage/core/detail/asker.h>
#include <vdbcage/core/detail/parallel.h>
#include <vdbcage/core/error.h>
#include <vdbcage/geometry/union_find.h>
#include <vdbcage/mesh/topology.h>

namespace vdbcage::detail {

void requireSound(const Mesh& mesh, const char* what)
{
    const auto requirePoint = [&](std::uint32_t index) {
        if (index < mesh.points.size() && mesh.points[index].isFinite()) return;
        std::ostringstream problem;
        if (index >= mesh.points.size()) {
            problem << "a face uses point " << index << "; there are " << mesh.points.size()
                    << " points, counted from 0";
        } else {
            const Vec3d& p = mesh.points[index];
            problem << "point " << index << " is (" << p[0] << ", " << p[1] << ", " << p[2]
                    << "); coordinates must be finite";
        }
        throw InputError(what, problem.str());
    };
    for (const Vec3I& triangle : mesh.triangles) {
        for (int i = 0; i < 3; ++i) requirePoint(triangle[i]);
    }
    for (const openvdb::Vec4I& quad : mesh.quads) {
        for (int i = 0; i < 4; ++i) requirePoint(quad[i]);
    }
    for (const Vec3I& triangle : mesh.alternatives) {
        for (int i = 0; i < 3; ++i) requirePoint(triangle[i]);
    }
}

namespace {

// Returns all triangles; those of a face follow each other.
std::vector<Vec3I> everyTriangle(const Mesh& mesh, const FaceTriangles& faces)
{
    std::vector<Vec3I> triangles = faces.triangles();
    triangles.insert(triangles.end(), mesh.alternatives.begin(), mesh.alternatives.end());
    return triangles;
}

} // namespace

CheckedModel::CheckedModel(const Mesh& mesh, Interrupter* interrupter)
{
    if (faceCount(mesh) == 0) throw InputError("model", "it has no faces; at least one is needed");
    requireSound(mesh, "model");
    throwIfInterrupted(interrupter);
    const FaceTriangles faces(mesh);
    throwIfInterrupted(interrupter);
    loosePoints = vdbcage::loosePoints(mesh);
    bool dropped = false;
    const auto buildTrees = [&] {
        const std::vector<Vec3I> triangles = everyTriangle(mesh, faces);
        candidates = BoxTree(mesh.points, triangles, BoxTree::Copies::drop, interrupter);
        dropped = candidates.size() < triangles.size();
        tree = TriangleBvh(mesh.points, triangles, interrupter, TriangleBvh::Copies::drop);
    };
    parallelInvoke(
        buildTrees, [&] { findParts(mesh, faces, false, interrupter); },
        [&] {
            const MeshTopology topology = analyzeTopology(mesh, interrupter);
            if (topology.isCycle()) volume = std::abs(detail::volume(mesh.points, faces));
            hollows = countHollows(mesh.points, faces, topology, interrupter);
        });
    // A part that touches a dropped copy is only known to touch the kept one, which may be of another part.
    if (dropped) findParts(mesh, faces, true, interrupter);
    const Vec3d extent = tree.box().hi - tree.box().lo;
    longestSide = std::max({extent[0], extent[1], extent[2]});
    diagonal = extent.length();
}

void CheckedModel::findParts(const Mesh& mesh, const FaceTriangles& faces, bool joinPlaces, Interrupter* interrupter)
{
    constexpr std::uint32_t none = ~std::uint32_t(0);
    UnionFind sets(mesh.points.size());
    Asker ask(interrupter);
    partOfPoint.assign(mesh.points.size(), none);
    for (std::size_t t = 0; t < faces.size(); ++t) {
        ask();
        sets.unite(faces[t][0], faces[t][1]);
        sets.unite(faces[t][0], faces[t][2]);
        for (int i = 0; i < 3; ++i) partOfPoint[faces[t][i]] = 0;
    }
    if (joinPlaces) {
        std::vector<std::uint32_t> byPlace;
        for (std::uint32_t p = 0; p < mesh.points.size(); ++p) {
            if (partOfPoint[p] != none) byPlace.push_back(p);
        }
        const auto& points = mesh.points;
        std::sort(byPlace.begin(), byPlace.end(), [&](std::uint32_t a, std::uint32_t b) {
            ask();
            return points[a] < points[b];
        });
        for (std::size_t i = 1; i < byPlace.size(); ++i) {
            ask();
            if (points[byPlace[i]] == points[byPlace[i - 1]]) sets.unite(byPlace[i], byPlace[i - 1]);
        }
    }
    usedVertices = 0;
    partFirst.assign(1, 0);
    for (std::uint32_t p = 0; p < mesh.points.size(); ++p) { // the root of a set is its first vertex
        ask();
        if (partOfPoint[p] == none) continue;
        ++usedVertices;
        const std::uint32_t root = sets.find(p);
        if (root == p) partFirst.push_back(0);
        partOfPoint[p] = root == p ? static_cast<std::uint32_t>(partFirst.size() - 2) : partOfPoint[root];
        ++partFirst[partOfPoint[p] + 1];
    }
    for (std::size_t part = 0; part < parts(); ++part) partFirst[part + 1] += partFirst[part];
    partVertices.resize(usedVertices);
    std::vector<std::size_t> next(partFirst.begin(), partFirst.end() - 1);
    for (std::uint32_t p = 0; p < mesh.points.size(); ++p) {
        if (partOfPoint[p] != none) partVertices[next[partOfPoint[p]]++] = p;
    }
}

} // namespace vdbcage::detail
