#include <vdbcage/bounding/detail/fit/welded_cage.h>

#include <algorithm>
#include <numeric>
#include <optional>
#include <string>
#include <tuple>

#include <vdbcage/bounding/detail/fit/mirror_pairs.h>
#include <vdbcage/core/detail/longest_side.h>
#include <vdbcage/core/error.h>
#include <vdbcage/mesh/detail/half_edges.h>

namespace vdbcage::detail {

namespace {

Vec3I sorted(Vec3I t)
{
    std::sort(&t[0], &t[0] + 3);
    return t;
}

/// Returns the quad of two triangles that share an edge, in their orientation; nothing if they do not.
std::optional<Vec4I> quadOf(const Vec3I& s, const Vec3I& t)
{
    for (const int i : {0, 1, 2}) {
        for (const int j : {0, 1, 2}) {
            if (s[i] == t[(j + 1) % 3] && s[(i + 1) % 3] == t[j])
                return Vec4I(s[i], t[(j + 2) % 3], s[(i + 1) % 3], s[(i + 2) % 3]);
        }
    }
    return std::nullopt;
}

/// Returns for each triangle whether it is half of a quad. Readers split quads that are concave: their other split is
/// among the alternatives, and two that follow each other in the list are one. More than two are a larger polygon.
std::vector<char> halvesOfConcaveQuads(const Mesh& mesh)
{
    std::vector<char> isHalf(mesh.triangles.size(), 0);
    std::vector<Vec3I> alternatives;
    for (const Vec3I& t : mesh.alternatives) alternatives.push_back(sorted(t));
    std::sort(alternatives.begin(), alternatives.end());
    const auto isAlternative = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
        return std::binary_search(alternatives.begin(), alternatives.end(), sorted(Vec3I(a, b, c)));
    };
    const auto areOfOnePolygon = [&](const Vec3I& s, const Vec3I& t) {
        const std::optional<Vec4I> q = quadOf(s, t);
        return q && isAlternative((*q)[1], (*q)[3], (*q)[0]) && isAlternative((*q)[1], (*q)[3], (*q)[2]);
    };
    for (std::size_t begin = 0; begin < mesh.triangles.size();) {
        std::size_t end = begin + 1;
        while (end < mesh.triangles.size() && areOfOnePolygon(mesh.triangles[end - 1], mesh.triangles[end])) ++end;
        if (end - begin == 2) isHalf[begin] = isHalf[begin + 1] = 1;
        begin = end;
    }
    return isHalf;
}

/// Returns for each point whether an edge with one face ends there. Where programs split a surface for normals or
/// texture coordinates, it has such edges.
std::vector<char> pointsOfBoundaries(const Mesh& mesh)
{
    const HalfEdges halfEdges(mesh);
    const EdgeTable edges(halfEdges, mesh.points.size());
    std::vector<char> isEnd(mesh.points.size(), 0);
    for (std::size_t edge = 0; edge < edges.size(); ++edge) {
        if (edges[edge].size() == 1) isEnd[halfEdges.from(edges[edge][0])] = isEnd[halfEdges.to(edges[edge][0])] = 1;
    }
    return isEnd;
}

/// Returns a cycle of corners, begun with the least.
template <typename Face>
std::vector<std::uint32_t> cycle(Face face)
{
    std::vector<std::uint32_t> corners(&face[0], &face[0] + Face::size);
    std::rotate(corners.begin(), std::min_element(corners.begin(), corners.end()), corners.end());
    return corners;
}

} // namespace

WeldedCage::WeldedCage(const Mesh& cage, const GuardModel& guard, Splits splits)
    : cage_(cage), guard_(guard), vertexOf_(cage.points.size())
{
    weld();
    for (const Vec3d& p : cage.points) asInCage_.push_back(guard.rounded(guard.scaled(p)));
    drawn_ = asInCage_;
    if (guard.symmetry()) {
        constexpr double tolerance = 0.01; // of the model's longest side
        std::vector<std::uint32_t> vertices;
        for (std::uint32_t v = 0; v < vertexOf_.size(); ++v) {
            if (vertexOf_[v] == v) vertices.push_back(v);
        }
        partners_ =
            mirrorPairs(drawn_, vertices, *guard.symmetry(), tolerance * longestSide(guard.box()) * guard.scale());
        for (const std::uint32_t v : vertices) {
            const std::uint32_t w = partners_[v];
            if (v < w) {
                drawn_[v] = guard.rounded(0.5 * (drawn_[v] + guard.mirrored(drawn_[w])));
                drawn_[w] = guard.mirrored(drawn_[v]);
            }
        }
        mirror(drawn_);
    }
    addFaces(splits);
}

void WeldedCage::weld()
{
    const std::vector<char> isAtSeam = pointsOfBoundaries(cage_);
    std::vector<std::uint32_t> order(cage_.points.size());
    std::iota(order.begin(), order.end(), 0U);
    std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
        return std::tie(cage_.points[a], isAtSeam[a], a) < std::tie(cage_.points[b], isAtSeam[b], b);
    });
    for (std::size_t i = 0; i < order.size(); ++i) {
        const bool isSame = i > 0 && isAtSeam[order[i]] && isAtSeam[order[i - 1]] &&
                            cage_.points[order[i]] == cage_.points[order[i - 1]];
        vertexOf_[order[i]] = isSame ? vertexOf_[order[i - 1]] : order[i];
    }
}

void WeldedCage::addFaces(Splits splits)
{
    const auto ofVertices = [&](auto face) {
        for (int i = 0; i < face.size; ++i) face[i] = vertexOf_[face[i]];
        return face;
    };
    const std::vector<char> isHalf = halvesOfConcaveQuads(cage_);
    std::vector<std::vector<std::uint32_t>> images, behind; // cycles
    const auto isTaken = [&](const auto& face, std::size_t number) {
        if (!guard_.symmetry()) return true;
        if (!isBeyond(face, number)) {
            behind.push_back(cycle(face));
            return false;
        }
        auto image = face;
        for (int i = 0; i < face.size; ++i) image[i] = partners_[face[face.size - 1 - i]];
        images.push_back(cycle(image));
        return true;
    };
    const std::size_t count = cage_.triangles.size();
    for (std::size_t i = 0; i < count; ++i) {
        const Vec3I t = ofVertices(cage_.triangles[i]);
        if (!isHalf[i] && isTaken(t, i)) addTriangle(t, i);
    }
    firstOfQuads_ = static_cast<std::uint32_t>(triangles_.size());
    for (std::size_t i = 0; i < count; i += isHalf[i] ? 2 : 1) {
        if (!isHalf[i]) continue;
        const Vec3I s = ofVertices(cage_.triangles[i]), t = ofVertices(cage_.triangles[i + 1]);
        if (!isTaken(*quadOf(s, t), i)) continue;
        addTriangle(s, i);
        addTriangle(t, i + 1);
    }
    for (std::size_t i = 0; i < cage_.quads.size(); ++i) {
        const Vec4I q = ofVertices(cage_.quads[i]);
        if (isTaken(q, count + i)) addQuad(q, count + i, splits);
    }
    guardedTriangles_ = static_cast<std::uint32_t>(triangles_.size());
    std::sort(images.begin(), images.end());
    std::sort(behind.begin(), behind.end());
    if (images != behind) throw InputError("cage", "it is not symmetric: a face has no mirror image");
    if (!guard_.symmetry()) return;
    for (std::uint32_t i = 0; i < guardedTriangles_; ++i) {
        const Vec3I& t = triangles_[i];
        addTriangle(Vec3I(partners_[t[0]], partners_[t[2]], partners_[t[1]]), faceOf_[i]);
    }
}

template <typename Face>
bool WeldedCage::isBeyond(const Face& face, std::size_t number) const
{
    const auto [axis, offset] = *guard_.symmetry();
    bool beyond = false, behind = false;
    for (int i = 0; i < face.size; ++i) {
        beyond = beyond || drawn_[face[i]][axis] > offset;
        behind = behind || drawn_[face[i]][axis] < offset;
    }
    if (beyond == behind) {
        throw InputError("cage", "face " + std::to_string(number) + " lies " + (beyond ? "across" : "in") +
                                     " the plane of symmetry, where it needs edges");
    }
    return beyond;
}

void WeldedCage::addTriangle(const Vec3I& t, std::size_t face)
{
    triangles_.push_back(t);
    faceOf_.push_back(face);
}

void WeldedCage::addQuad(const Vec4I& q, std::size_t face, Splits splits)
{
    const auto cosine = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) {
        const Vec3d diagonal = drawn_[c] - drawn_[a];
        const Vec3d n = (drawn_[b] - drawn_[a]).cross(diagonal), m = diagonal.cross(drawn_[d] - drawn_[a]);
        const double lengths = n.length() * m.length();
        return lengths > 0 ? n.dot(m) / lengths : -1;
    };
    const bool isFirst = cosine(q[0], q[1], q[2], q[3]) >= cosine(q[1], q[2], q[3], q[0]);
    const Vec4I corners = isFirst != (splits == Splits::lessFolded) ? Vec4I(q[1], q[2], q[3], q[0]) : q;
    addTriangle(Vec3I(corners[0], corners[1], corners[2]), face);
    addTriangle(Vec3I(corners[0], corners[2], corners[3]), face);
}

bool WeldedCage::isBehind(std::uint32_t vertex) const
{
    return !partners_.empty() && drawn_[vertex][guard_.symmetry()->axis] < guard_.symmetry()->offset;
}

void WeldedCage::mirror(std::vector<Vec3d>& places) const
{
    for (std::uint32_t v = 0; v < partners_.size(); ++v) {
        if (isBehind(v)) places[v] = guard_.mirrored(places[partners_[v]]);
        if (partners_[v] == v) places[v][guard_.symmetry()->axis] = guard_.symmetry()->offset;
    }
}

Mesh WeldedCage::inWorld(const std::vector<Vec3d>& places) const
{
    Mesh mesh{{}, triangles_, {}};
    for (const Vec3d& p : places) mesh.points.push_back(guard_.unscaled(p));
    return mesh;
}

Mesh WeldedCage::cageWith(std::vector<Vec3d> places) const
{
    mirror(places);
    Mesh cage = cage_;
    for (std::size_t i = 0; i < cage.points.size(); ++i) {
        const Vec3d &p = places[vertexOf_[i]], moved = guard_.unscaled(p);
        for (int k = 0; k < 3; ++k) {
            if (p[k] != asInCage_[i][k]) cage.points[i][k] = moved[k];
        }
    }
    return cage;
}

} // namespace vdbcage::detail
