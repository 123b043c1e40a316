// Polychords: Borden, Benzley, Shepherd 2002, "Hexahedral Sheet Extraction", for quads as in Daniels, Silva, Shepherd,
// Cohen 2008, "Quadrilateral Mesh Simplification".
#include "quad_quality.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include <openvdb/math/Vec3.h>
#include <vdbcage/mesh/detail/half_edges.h>

namespace vdbcage::report {

namespace {

using openvdb::Vec3d;

double angleBetween(const Vec3d& a, const Vec3d& b)
{
    return std::atan2(a.cross(b).length(), a.dot(b)) * 180 / std::acos(-1.0);
}

double meanOf(const std::vector<double>& values)
{
    double sum = 0;
    for (const double value : values) sum += value;
    return values.empty() ? 0 : sum / static_cast<double>(values.size());
}

/// Returns the value that `share` of all do not exceed.
double percentile(std::vector<double> values, double share)
{
    if (values.empty()) return 0;
    const auto at = std::min(values.size() - 1, static_cast<std::size_t>(share * static_cast<double>(values.size())));
    std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(at), values.end());
    return values[at];
}

void measureShapes(const Mesh& mesh, QuadQuality& quality)
{
    std::vector<double> corners, folds, aspects;
    for (const auto& quad : mesh.quads) {
        Vec3d p[4], normals[4];
        for (int i = 0; i < 4; ++i) p[i] = mesh.points[quad[i]];
        for (int i = 0; i < 4; ++i) {
            const Vec3d ahead = p[(i + 1) % 4] - p[i], behind = p[(i + 3) % 4] - p[i];
            corners.push_back(std::abs(angleBetween(ahead, behind) - 90));
            normals[i] = ahead.cross(behind);
        }
        folds.push_back(std::max(angleBetween(normals[0], normals[2]), angleBetween(normals[1], normals[3])));
        const double along = (p[0] + p[1] - p[2] - p[3]).length(), across = (p[1] + p[2] - p[3] - p[0]).length();
        aspects.push_back(std::max(along, across) / std::max(1e-300, std::min(along, across)));
    }
    quality.cornerMean = meanOf(corners);
    quality.corner95th = percentile(std::move(corners), 0.95);
    quality.foldMean = meanOf(folds);
    quality.fold95th = percentile(std::move(folds), 0.95);
    quality.aspect = percentile(std::move(aspects), 0.5);
}

void countValences(const Mesh& mesh, const detail::HalfEdges& halfEdges, const detail::EdgeTable& edges,
                   QuadQuality& quality)
{
    std::vector<std::size_t> valence(mesh.points.size());
    for (std::size_t e = 0; e < edges.size(); ++e) {
        const std::size_t h = edges[e][0];
        ++valence[halfEdges.from(h)];
        ++valence[halfEdges.to(h)];
    }
    std::size_t vertices = 0;
    for (const std::size_t n : valence) {
        if (n == 0) continue; // a point that no face uses
        ++vertices;
        ++quality.valences[n];
    }
    if (vertices == 0) return;
    const auto regular = quality.valences.find(4);
    const std::size_t regulars = regular == quality.valences.end() ? 0 : regular->second;
    quality.irregular = static_cast<double>(vertices - regulars) / static_cast<double>(vertices);
}

/// Follows quads across opposite sides: from a half-edge of a quad to the opposite side, and over it into the next
/// quad. Each polychord is met in both directions.
void followPolychords(const Mesh& mesh, const detail::HalfEdges& halfEdges, const detail::EdgeTable& edges,
                      QuadQuality& quality)
{
    constexpr std::size_t none = detail::EdgeTable::none;
    const std::size_t triangles = mesh.triangles.size(), faces = triangles + mesh.quads.size();
    const auto isOfQuad = [&](std::size_t h) { return halfEdges.face(h) >= triangles; };
    const auto across = [&](std::size_t h) { return edges.opposite(halfEdges.next(halfEdges.next(h))); };
    const double longest = 4 * std::sqrt(static_cast<double>(faces));

    std::vector<bool> seen(halfEdges.size()), isInLoop(faces);
    std::vector<std::size_t> passedIn(faces, none); // the polychord that passed a face last
    std::size_t polychords = 0;
    for (std::size_t start = 0; start < halfEdges.size(); ++start) {
        if (!isOfQuad(start) || seen[start]) continue;
        std::vector<std::size_t> passed;
        bool isSimple = true;
        std::size_t h = start;
        do {
            seen[h] = true;
            const std::size_t face = halfEdges.face(h);
            isSimple = isSimple && passedIn[face] != polychords;
            passedIn[face] = polychords;
            passed.push_back(face);
            h = across(h);
        } while (h != none && isOfQuad(h) && !seen[h]);
        ++polychords;
        if (h != start || !isSimple || static_cast<double>(passed.size()) > longest) continue;
        // Follows the other direction.
        for (std::size_t back = edges.opposite(start); back != none && isOfQuad(back) && !seen[back];) {
            seen[back] = true;
            back = across(back);
        }
        ++quality.loops;
        for (const std::size_t face : passed) isInLoop[face] = true;
    }
    const auto inLoops = static_cast<double>(std::count(isInLoop.begin(), isInLoop.end(), true));
    if (!mesh.quads.empty()) quality.inLoops = inLoops / static_cast<double>(mesh.quads.size());
}

} // namespace

QuadQuality quadQuality(const Mesh& mesh)
{
    QuadQuality quality;
    const std::size_t faces = mesh.triangles.size() + mesh.quads.size();
    if (faces == 0) return quality;
    quality.share = static_cast<double>(mesh.quads.size()) / static_cast<double>(faces);
    const detail::HalfEdges halfEdges(mesh);
    const detail::EdgeTable edges(halfEdges, mesh.points.size());
    countValences(mesh, halfEdges, edges, quality);
    measureShapes(mesh, quality);
    followPolychords(mesh, halfEdges, edges, quality);
    return quality;
}

} // namespace vdbcage::report
