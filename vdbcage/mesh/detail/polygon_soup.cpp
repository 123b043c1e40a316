#include <vdbcage/mesh/detail/polygon_soup.h>

#include <algorithm>
#include <limits>
#include <utility>

#include <vdbcage/core/error.h>
#include <vdbcage/mesh/detail/degenerate.h>
#include <vdbcage/mesh/detail/polygon_splitter.h>

namespace vdbcage::detail {

namespace {

bool repeatsCorner(const openvdb::Index32* face, std::size_t count, std::vector<openvdb::Index32>& sorted)
{
    sorted.assign(face, face + count);
    std::sort(sorted.begin(), sorted.end());
    return std::adjacent_find(sorted.begin(), sorted.end()) != sorted.end();
}

} // namespace

Mesh toMesh(PolygonSoup soup, const std::string& name, ReadSummary* summary)
{
    if (soup.points.size() > std::numeric_limits<openvdb::Index32>::max()) {
        throw IoError(name + ": it has " + std::to_string(soup.points.size()) + " points; at most " +
                      std::to_string(std::numeric_limits<openvdb::Index32>::max()) + " are supported");
    }
    Mesh mesh;
    mesh.points = std::move(soup.points);
    mesh.triangles = std::move(soup.triangles);

    ReadSummary found;
    found.ignoredElements = soup.ignoredElements;
    bool hasArea = false;
    for (const openvdb::Vec3I& triangle : mesh.triangles) {
        if (isDegenerate(mesh, triangle)) {
            ++found.degenerateFaces;
        } else {
            hasArea = true;
        }
    }

    PolygonSplitter splitter(mesh.points);
    std::vector<openvdb::Index32> sorted;
    std::size_t begin = 0;
    for (const std::size_t end : soup.ends) {
        const openvdb::Index32* face = soup.corners.data() + begin;
        const std::size_t count = end - begin;
        const std::size_t triangles = mesh.triangles.size();
        const std::size_t quads = mesh.quads.size();
        splitter.split(face, count, mesh.triangles, mesh.quads);
        if (mesh.quads.size() == quads) addAlternatives(face, count, mesh.alternatives);
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

    if (faceCount(mesh) == 0) throw IoError(name + ": it has no faces; at least one is needed");
    if (!hasArea) {
        throw IoError(name + ": every face is degenerate (its corners are on a line); at least one must have an area");
    }
    if (summary) *summary = found;
    return mesh;
}

} // namespace vdbcage::detail
