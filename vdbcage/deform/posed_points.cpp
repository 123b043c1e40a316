#include <vdbcage/deform/posed_points.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <map>
#include <string>
#include <utility>

#include <vdbcage/core/error.h>
#include <vdbcage/mesh/detail/half_edges.h>

namespace vdbcage {

namespace {

using openvdb::Index32;
using openvdb::Vec3I;
using openvdb::Vec4I;

constexpr std::size_t none = detail::EdgeTable::none;

/// A set of triangles, each beginning at any corner.
class TriangleSet {
public:
    explicit TriangleSet(std::vector<Vec3I> triangles) : sorted_(std::move(triangles))
    {
        for (Vec3I& triangle : sorted_) triangle = turned(triangle);
        std::sort(sorted_.begin(), sorted_.end());
    }

    bool has(Index32 a, Index32 b, Index32 c) const
    {
        return std::binary_search(sorted_.begin(), sorted_.end(), turned({a, b, c}));
    }

private:
    static Vec3I turned(const Vec3I& t) { return std::min({t, Vec3I(t[1], t[2], t[0]), Vec3I(t[2], t[0], t[1])}); }

    std::vector<Vec3I> sorted_;
};

/// Returns the number of faces of `mesh` that are not in another mesh, whose triangles by every split are `ofOther`.
std::size_t otherFaces(const Mesh& mesh, const TriangleSet& ofOther)
{
    const auto isOther = [&](const Vec3I& t) { return !ofOther.has(t[0], t[1], t[2]); };
    const auto isOtherQuad = [&](const Vec4I& q) {
        return !(ofOther.has(q[0], q[1], q[2]) && ofOther.has(q[0], q[2], q[3])) &&
               !(ofOther.has(q[0], q[1], q[3]) && ofOther.has(q[1], q[2], q[3]));
    };
    return static_cast<std::size_t>(std::count_if(mesh.triangles.begin(), mesh.triangles.end(), isOther) +
                                    std::count_if(mesh.quads.begin(), mesh.quads.end(), isOtherQuad));
}

/// Returns the faces of `mesh`, with the quads that its reader split made whole again: which ones are concave depends
/// on the pose.
Mesh withWholeQuads(const Mesh& mesh)
{
    if (mesh.alternatives.empty()) return mesh;
    const TriangleSet alternatives(mesh.alternatives);
    const Mesh triangles{mesh.points, mesh.triangles, {}};
    const detail::HalfEdges halfEdges(triangles);
    const detail::EdgeTable edges(halfEdges, mesh.points.size());
    // The half-edge of each triangle beyond which the other half of its quad is, and the number of possible ones:
    // larger polygons have several.
    std::vector<std::size_t> diagonal(mesh.triangles.size(), none), candidates(mesh.triangles.size(), 0);
    for (std::size_t h = 0; h < halfEdges.size(); ++h) {
        const std::size_t opposite = edges.opposite(h);
        if (opposite == none) continue;
        const Index32 tip = halfEdges.before(h), otherTip = halfEdges.before(opposite);
        if (!alternatives.has(halfEdges.from(h), otherTip, tip) || !alternatives.has(otherTip, halfEdges.to(h), tip)) {
            continue;
        }
        diagonal[halfEdges.face(h)] = h;
        ++candidates[halfEdges.face(h)];
    }
    Mesh whole{mesh.points, {}, mesh.quads};
    for (std::size_t face = 0; face < mesh.triangles.size(); ++face) {
        const std::size_t h = diagonal[face];
        const std::size_t other = candidates[face] == 1 ? halfEdges.face(edges.opposite(h)) : face;
        if (other == face || candidates[other] != 1) {
            whole.triangles.push_back(mesh.triangles[face]);
        } else if (face < other) {
            whole.quads.emplace_back(halfEdges.before(h), halfEdges.from(h), halfEdges.before(edges.opposite(h)),
                                     halfEdges.to(h));
        }
    }
    return whole;
}

/// The faces of a mesh as half-edges, with properties that do not depend on the numbers of points and faces.
class Connectivity {
public:
    /// `mesh` must outlive this.
    explicit Connectivity(const Mesh& mesh)
        : halfEdges_(mesh), edges_(halfEdges_, mesh.points.size()), degrees_(mesh.points.size(), 0)
    {
        for (std::size_t h = 0; h < size(); ++h) ++degrees_[from(h)];
    }

    std::size_t size() const { return halfEdges_.size(); }
    Index32 from(std::size_t h) const { return halfEdges_.from(h); }
    std::size_t next(std::size_t h) const { return halfEdges_.next(h); }
    /// Returns the opposite half-edge; `none` at a boundary.
    std::size_t opposite(std::size_t h) const { return edges_.opposite(h); }
    /// Returns the points that no face has.
    std::vector<std::size_t> loosePoints() const
    {
        std::vector<std::size_t> found;
        for (std::size_t point = 0; point < degrees_.size(); ++point) {
            if (degrees_[point] == 0) found.push_back(point);
        }
        return found;
    }

    /// Returns whether no edge has more than two faces, and the two of each run along it in opposite directions.
    bool isManifold() const
    {
        for (std::size_t h = 0; h < size(); ++h) {
            const std::size_t edge = edges_.edgeOf(h);
            if (edge == none || (opposite(h) == none && edges_[edge].size() != 1)) return false;
        }
        return true;
    }

    /// The numbers of corners of the faces on both sides, 0 beyond a boundary, and the degrees of both ends.
    using Kind = std::array<Index32, 4>;
    Kind kind(std::size_t h) const
    {
        const auto corners = [&](std::size_t g) { return next(next(next(g))) == g ? 3U : 4U; };
        return {corners(h), opposite(h) == none ? 0U : corners(opposite(h)), degrees_[from(h)],
                degrees_[from(next(h))]};
    }

private:
    detail::HalfEdges halfEdges_;
    detail::EdgeTable edges_;
    std::vector<Index32> degrees_; ///< by point: the number of corners of faces there
};

using Pair = std::pair<std::size_t, std::size_t>;

/// A one-to-one pairing of numbers with numbers.
class Pairing {
public:
    Pairing(std::size_t left, std::size_t right) : ofLeft_(left, none), ofRight_(right, none) {}

    /// Returns the partner of `left`, or `none`.
    std::size_t operator[](std::size_t left) const { return ofLeft_[left]; }
    std::size_t size() const { return pairs_.size(); }

    /// Pairs two numbers. Returns false if one of them has another partner.
    bool add(const Pair& pair)
    {
        const auto& [left, right] = pair;
        if (ofLeft_[left] == right) return true;
        if (ofLeft_[left] != none || ofRight_[right] != none) return false;
        ofLeft_[left] = right;
        ofRight_[right] = left;
        pairs_.push_back(pair);
        return true;
    }
    /// Removes all except the first pairs, and returns them.
    std::vector<Pair> takeAfter(std::size_t count)
    {
        const std::vector<Pair> taken(pairs_.begin() + static_cast<std::ptrdiff_t>(count), pairs_.end());
        for (const auto& [left, right] : taken) ofLeft_[left] = ofRight_[right] = none;
        pairs_.resize(count);
        return taken;
    }

private:
    std::vector<std::size_t> ofLeft_, ofRight_;
    std::vector<Pair> pairs_;
};

/// The search for the orders of the points of a posed cage in which its faces are those of the cage.
class Matching {
public:
    enum class Found { nothing, one, several };

    Matching(const Mesh& cage, const Mesh& posed)
        : cage_(cage), posed_(posed), halfEdges_(cage_.size(), posed_.size()),
          points_(cage.points.size(), posed.points.size())
    {
        for (std::size_t h = 0; h < posed_.size(); ++h) posedOfKind_[posed_.kind(h)].push_back(h);
    }

    Found find()
    {
        if (!cage_.isManifold()) return Found::several; // its edges do not determine the next faces
        if (cage_.size() != posed_.size() || !posed_.isManifold()) return Found::nothing;
        Found found = Found::one;
        for (const std::size_t seed : seeds()) {
            const Found part = matchFrom(seed);
            if (part == Found::nothing) return part;
            if (part == Found::several) found = part;
        }
        // No face identifies a point without faces.
        const std::vector<std::size_t> loose = cage_.loosePoints();
        if (loose.size() > 1) return Found::several;
        if (found == Found::one && !loose.empty()) points_.add({loose.front(), posed_.loosePoints().front()});
        return found;
    }

    /// Returns the posed point of a point of the cage. \pre find() was `one`
    std::size_t operator[](std::size_t point) const { return points_[point]; }

private:
    /// Returns, for each component connected over edges, the half-edge with the fewest like it in the cage.
    std::vector<std::size_t> seeds() const
    {
        std::map<Connectivity::Kind, std::size_t> counts;
        for (std::size_t h = 0; h < cage_.size(); ++h) ++counts[cage_.kind(h)];
        std::vector<std::size_t> found, pending;
        std::vector<bool> seen(cage_.size(), false);
        for (std::size_t first = 0; first < cage_.size(); ++first) {
            if (seen[first]) continue;
            seen[first] = true;
            pending.assign(1, first);
            std::size_t best = first, least = counts.at(cage_.kind(first));
            while (!pending.empty()) {
                const std::size_t h = pending.back();
                pending.pop_back();
                const std::size_t count = counts.at(cage_.kind(h));
                if (count < least) {
                    best = h;
                    least = count;
                }
                for (const std::size_t g : {cage_.next(h), cage_.opposite(h)}) {
                    if (g == none || seen[g]) continue;
                    seen[g] = true;
                    pending.push_back(g);
                }
            }
            found.push_back(best);
        }
        return found;
    }

    /// Pairs the component of `seed`, if there is exactly one way to do so.
    Found matchFrom(std::size_t seed)
    {
        const auto candidates = posedOfKind_.find(cage_.kind(seed));
        if (candidates == posedOfKind_.end()) return Found::nothing;
        const std::size_t halfEdges = halfEdges_.size(), points = points_.size();
        std::vector<Pair> pairsOfEdges, pairsOfPoints;
        for (const std::size_t candidate : candidates->second) {
            const bool fits = follow(seed, candidate);
            std::vector<Pair> edges = halfEdges_.takeAfter(halfEdges), ends = points_.takeAfter(points);
            if (!fits) continue;
            if (!pairsOfEdges.empty()) return Found::several;
            pairsOfEdges = std::move(edges);
            pairsOfPoints = std::move(ends);
        }
        for (const Pair& pair : pairsOfEdges) halfEdges_.add(pair);
        for (const Pair& pair : pairsOfPoints) points_.add(pair);
        return pairsOfEdges.empty() ? Found::nothing : Found::one;
    }

    /// Pairs two half-edges, and all that follows from it. Returns false if they do not fit.
    bool follow(std::size_t seed, std::size_t candidate)
    {
        std::vector<Pair> pending{{seed, candidate}};
        while (!pending.empty()) {
            const auto [h, g] = pending.back();
            pending.pop_back();
            if (halfEdges_[h] == g) continue;
            if (cage_.kind(h) != posed_.kind(g) || !halfEdges_.add({h, g}) ||
                !points_.add({cage_.from(h), posed_.from(g)})) {
                return false;
            }
            pending.emplace_back(cage_.next(h), posed_.next(g));
            if (cage_.opposite(h) != none) pending.emplace_back(cage_.opposite(h), posed_.opposite(g));
        }
        return true;
    }

    Connectivity cage_, posed_;
    std::map<Connectivity::Kind, std::vector<std::size_t>> posedOfKind_;
    Pairing halfEdges_, points_; ///< of the cage with those of the posed one
};

std::size_t triangleCount(const Mesh& mesh)
{
    return mesh.triangles.size() + 2 * mesh.quads.size();
}

std::string counts(const Mesh& mesh)
{
    return std::to_string(mesh.points.size()) + " points, " + std::to_string(mesh.triangles.size()) +
           " triangles and " + std::to_string(mesh.quads.size()) + " quads";
}

} // namespace

PosedPoints posedPoints(const Mesh& cage, const Mesh& posed)
{
    if (posed.points.size() != cage.points.size() || triangleCount(posed) != triangleCount(cage)) {
        throw InputError("posed cage", "it has " + counts(posed) + "; the cage has " + counts(cage));
    }
    const std::size_t others =
        std::max(otherFaces(posed, TriangleSet(everySplit(cage))), otherFaces(cage, TriangleSet(everySplit(posed))));
    if (others == 0) return {posed.points, false};
    const Mesh wholeCage = withWholeQuads(cage), wholePosed = withWholeQuads(posed);
    if (wholeCage.quads.size() != wholePosed.quads.size()) {
        throw InputError("posed cage", "its points are in another order than the cage's, and it has " +
                                           std::to_string(wholePosed.quads.size()) + " quads; the cage has " +
                                           std::to_string(wholeCage.quads.size()) + "; keep the quads, or the order");
    }
    Matching matching(wholeCage, wholePosed);
    switch (matching.find()) {
    case Matching::Found::nothing:
        throw InputError("posed cage", std::to_string(others) + " of its " + std::to_string(faceCount(posed)) +
                                           " faces are not the cage's, and no other order of its points makes them so");
    case Matching::Found::several:
        throw InputError("posed cage", "its points are in another order than the cage's, and its faces do not tell "
                                       "which is which; keep the order");
    case Matching::Found::one:
        break;
    }
    PosedPoints result{{}, true};
    for (std::size_t i = 0; i < cage.points.size(); ++i) result.points.push_back(posed.points[matching[i]]);
    return result;
}

} // namespace vdbcage
