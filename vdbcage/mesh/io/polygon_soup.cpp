#include <vdbcage/mesh/io/polygon_soup.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <numeric>
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

/// Polygons, to get the triangles of their alternate splits.
class Alternates {
public:
    /// `face` must stay where it is.
    void add(const openvdb::Index32* face, std::size_t count)
    {
        if (count > mostCornersWithAlternates) {
            ++tooLarge_;
        } else {
            faces_.push_back({face, count, hashOf(face, count), true});
        }
    }

    /// Appends them, in the order of the polygons, once for those that are equal.
    void appendTo(std::vector<openvdb::Vec3I>& triangles, ReadSummary& summary)
    {
        dropCopies();
        std::array<std::size_t, mostCornersWithAlternates + 1> needed{};
        for (const Face& face : faces_) needed[face.count] += face.first ? alternativesOf(face.count) : 0;
        // Four triangles of a quad are no more than a convex one gets: only larger faces may have to go without.
        std::size_t corners = 4, all = 0;
        while (corners < mostCornersWithAlternates && all + needed[corners + 1] <= mostAlternates) {
            all += needed[++corners];
        }
        triangles.reserve(needed[4] + all);
        summary.alternateCorners = corners;
        summary.facesAsSplit = tooLarge_;
        for (const Face& face : faces_) {
            if (face.count > corners) {
                ++summary.facesAsSplit;
            } else if (face.first) {
                addAlternatives(face.corners, face.count, triangles);
            }
        }
    }

private:
    struct Face {
        const openvdb::Index32* corners;
        std::size_t count;
        std::uint64_t hash;
        bool first; ///< of those that are equal
    };

    /// The same from any start in either direction.
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

    /// The same cycle of corners, from any start in either direction.
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
        std::vector<std::size_t> order(faces_.size());
        std::iota(order.begin(), order.end(), std::size_t(0));
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
    std::size_t tooLarge_ = 0;
};

} // namespace

MeshFile toMesh(PolygonSoup soup, const std::string& name)
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
        if (mesh.quads.size() == quads) alternates.add(face, count);
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

    alternates.appendTo(mesh.alternatives, found);

    if (faceCount(mesh) == 0) throw IoError(name + ": it has no faces; at least one is needed");
    if (!hasArea) {
        throw IoError(name + ": every face is degenerate (its corners are on a line); at least one must have an area");
    }
    return file;
}

} // namespace vdbcage::detail
