#include <vdbcage/mesh/io/polygon_soup.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <tuple>
#include <utility>

#include <vdbcage/core/error.h>
#include <vdbcage/mesh/detail/degenerate.h>
#include <vdbcage/mesh/io/polygon_splitter.h>

namespace vdbcage::detail {

namespace {

bool repeatsCorner(const openvdb::Index32* face, std::size_t count, std::vector<openvdb::Index32>& sorted)
{
    sorted.assign(face, face + count);
    std::sort(sorted.begin(), sorted.end());
    return std::adjacent_find(sorted.begin(), sorted.end()) != sorted.end();
}

/// Polygons, for the triangles of their alternate splits.
class Alternates {
public:
    /// Adds a polygon. `face` must stay in place. `split` are its triangles in the mesh.
    void add(const openvdb::Index32* face, std::size_t count, const openvdb::Vec3I* split)
    {
        Face added{face, count};
        for (std::size_t i = 2; i < count && added.isFirstFan; ++i) {
            added.isFirstFan = split[i - 2] == openvdb::Vec3I(face[0], face[i - 1], face[i]);
        }
        if (count <= mostCornersWithAlternates) added.hash = hashOf(face, count);
        faces_.push_back(added);
    }

    /// Appends the triangles in the order of the polygons, once for equal polygons. Large ones get the other one of two
    /// splits: the fan around their first corner and ear clipping. That is no more than they have in the mesh.
    void appendTo(std::vector<openvdb::Vec3I>& triangles, PolygonSplitter& splitter, ReadSummary& summary)
    {
        dropCopies();
        std::array<std::size_t, mostCornersWithAlternates + 1> needed{};
        for (const Face& face : faces_) {
            if (face.count < needed.size() && face.first) needed[face.count] += alternativesOf(face.count);
        }
        // Four triangles of a quad are no more than a convex one gets: only larger faces may get none.
        std::size_t corners = 4, all = 0;
        while (corners < mostCornersWithAlternates && all + needed[corners + 1] <= mostAlternates) {
            all += needed[++corners];
        }
        triangles.reserve(needed[4] + all);
        summary.alternateCorners = corners;
        for (const Face& face : faces_) {
            if (face.count > corners) {
                if (face.isFirstFan) {
                    splitter.splitByEars(face.corners, face.count, triangles);
                } else {
                    addFirstFan(face.corners, face.count, triangles);
                }
            } else if (face.first) {
                addAlternatives(face.corners, face.count, triangles);
            }
        }
    }

private:
    struct Face {
        const openvdb::Index32* corners;
        std::size_t count;
        bool isFirstFan = true; ///< it is split as a fan around its first corner
        std::uint64_t hash = 0;
        bool first = true; ///< of those that are equal
    };

    /// Returns the same value from any start in either direction.
    static std::uint64_t hashOf(const openvdb::Index32* face, std::size_t count)
    {
        std::uint64_t sum = 0;
        for (std::size_t i = 0; i < count; ++i) {
            const auto [low, high] = std::minmax(face[i], face[i + 1 == count ? 0 : i + 1]);
            std::uint64_t edge = (std::uint64_t(high) << 32U | low) * 0x9e3779b97f4a7c15U;
            edge = (edge ^ edge >> 32U) * 0xd6e8feb86659fd93U;
            sum += edge ^ edge >> 32U;
        }
        return sum;
    }

    /// Returns whether two faces have the same cycle of corners, from any start in either direction.
    static bool areEqual(const Face& a, const Face& b)
    {
        if (a.count != b.count) return false;
        for (std::size_t start = 0; start < a.count; ++start) {
            bool forward = true, backward = true;
            for (std::size_t i = 0; i < a.count && (forward || backward); ++i) {
                forward = forward && a.corners[i] == b.corners[(start + i) % a.count];
                backward = backward && a.corners[i] == b.corners[(start + a.count - i) % a.count];
            }
            if (forward || backward) return true;
        }
        return false;
    }

    void dropCopies()
    {
        std::vector<std::size_t> order;
        for (std::size_t i = 0; i < faces_.size(); ++i) {
            if (faces_[i].count <= mostCornersWithAlternates) order.push_back(i);
        }
        std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
            return std::tie(faces_[a].hash, a) < std::tie(faces_[b].hash, b);
        });
        const Face* first = nullptr;
        for (const std::size_t i : order) {
            Face& face = faces_[i];
            face.first = !first || first->hash != face.hash || !areEqual(*first, face);
            if (face.first) first = &face;
        }
    }

    std::vector<Face> faces_;
};

} // namespace

MeshFile toMesh(PolygonSoup soup, const std::string& name, const Warnings& warnings)
{
    if (soup.points.size() > std::numeric_limits<openvdb::Index32>::max()) {
        throw IoError(name + ": it has " + std::to_string(soup.points.size()) + " points; at most " +
                      std::to_string(std::numeric_limits<openvdb::Index32>::max()) + " are supported");
    }
    MeshFile file;
    auto& [mesh, found] = file;
    mesh.points = std::move(soup.points);
    mesh.triangles = std::move(soup.triangles);

    found.ignoredElements = soup.ignoredElements;
    found.warnings = warnings.texts();
    bool hasArea = false;
    for (const openvdb::Vec3I& triangle : mesh.triangles) {
        if (isDegenerate(mesh, triangle)) {
            ++found.degenerateFaces;
        } else {
            hasArea = true;
        }
    }

    Alternates alternates;
    PolygonSplitter splitter(mesh.points);
    std::vector<openvdb::Index32> sorted;
    std::size_t begin = 0;
    for (const std::size_t end : soup.ends) {
        const openvdb::Index32* face = soup.corners.data() + begin;
        const std::size_t count = end - begin;
        const std::size_t triangles = mesh.triangles.size();
        const std::size_t quads = mesh.quads.size();
        splitter.split(face, count, mesh.triangles, mesh.quads);
        if (mesh.quads.size() == quads) alternates.add(face, count, mesh.triangles.data() + triangles);
        bool faceHasArea = false;
        for (std::size_t i = triangles; i < mesh.triangles.size() && !faceHasArea; ++i) {
            faceHasArea = !isDegenerate(mesh, mesh.triangles[i]);
        }
        if (mesh.quads.size() > quads) {
            faceHasArea = !isDegenerate(mesh, openvdb::Vec3I(face[0], face[1], face[2])) ||
                          !isDegenerate(mesh, openvdb::Vec3I(face[0], face[2], face[3]));
        }
        hasArea = hasArea || faceHasArea;
        if (!faceHasArea || repeatsCorner(face, count, sorted)) ++found.degenerateFaces;
        if (count > 4) ++found.polygons;
        begin = end;
    }

    alternates.appendTo(mesh.alternatives, splitter, found);

    if (faceCount(mesh) == 0) throw IoError(name + ": it has no faces; at least one is needed");
    if (!hasArea) {
        throw IoError(name + ": every face is degenerate (its corners are on a line); at least one must have an area");
    }
    return file;
}

} // namespace vdbcage::detail
