#include <vdbcage/bounding/fit.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <string>
#include <tuple>

#include <vdbcage/bounding/detail/fit/align.h>
#include <vdbcage/bounding/detail/fit/drawn_shape.h>
#include <vdbcage/bounding/detail/fit/grow.h>
#include <vdbcage/bounding/detail/fit/untangle.h>
#include <vdbcage/bounding/detail/triangles/relax.h>
#include <vdbcage/bounding/detail/triangles/sweep.h>
#include <vdbcage/bounding/detail/triangles/tightening.h>
#include <vdbcage/core/error.h>
#include <vdbcage/mesh/detail/half_edges.h>
#include <vdbcage/mesh/topology.h>

namespace vdbcage {

namespace {

using namespace detail;

Vec3I sorted(Vec3I t)
{
    std::sort(&t[0], &t[0] + 3);
    return t;
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
        for (const int i : {0, 1, 2}) {
            for (const int j : {0, 1, 2}) {
                if (s[i] != t[(j + 1) % 3] || s[(i + 1) % 3] != t[j]) continue;
                const std::uint32_t a = s[(i + 2) % 3], b = t[(j + 2) % 3];
                return isAlternative(a, b, s[i]) && isAlternative(a, b, s[(i + 1) % 3]);
            }
        }
        return false;
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

/// A cage in the guard's units, whose points at one place of a seam are one. Points that meet elsewhere stay apart: an
/// artist drew them onto each other.
class WeldedCage {
public:
    enum class Splits { lessFolded, other }; ///< of quads into the triangles that they are until they are quads

    WeldedCage(const Mesh& cage, const GuardModel& guard, Splits splits)
        : splits_(splits), cage_(cage), guard_(guard), vertexOf_(cage.points.size())
    {
        const std::vector<char> isAtSeam = pointsOfBoundaries(cage);
        std::vector<std::uint32_t> order(cage.points.size());
        std::iota(order.begin(), order.end(), 0U);
        std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
            return std::tie(cage.points[a], isAtSeam[a], a) < std::tie(cage.points[b], isAtSeam[b], b);
        });
        for (std::size_t i = 0; i < order.size(); ++i) {
            const bool isSame = i > 0 && isAtSeam[order[i]] && isAtSeam[order[i - 1]] &&
                                cage.points[order[i]] == cage.points[order[i - 1]];
            vertexOf_[order[i]] = isSame ? vertexOf_[order[i - 1]] : order[i];
        }
        for (const Vec3d& p : cage.points) drawn_.push_back(guard.rounded(guard.scaled(p)));
        const std::vector<char> isHalf = halvesOfConcaveQuads(cage);
        for (std::size_t i = 0; i < cage.triangles.size(); ++i) {
            if (!isHalf[i]) addTriangle(cage.triangles[i], i);
        }
        firstOfQuads_ = static_cast<std::uint32_t>(triangles_.size());
        for (std::size_t i = 0; i < cage.triangles.size(); ++i) {
            if (isHalf[i]) addTriangle(cage.triangles[i], i);
        }
        for (std::size_t i = 0; i < cage.quads.size(); ++i) addQuad(cage.quads[i], cage.triangles.size() + i);
    }
    const std::vector<Vec3d>& drawn() const { return drawn_; }
    /// Returns triangles by numbers of vertices: those of the cage that are in no quad, then two of each quad.
    const std::vector<Vec3I>& triangles() const { return triangles_; }
    std::uint32_t firstOfQuads() const { return firstOfQuads_; }
    std::uint32_t vertexOf(std::size_t point) const { return vertexOf_[point]; }
    /// Returns the number of the cage's face that a triangle belongs to.
    std::size_t faceOf(std::size_t triangle) const { return faceOf_[triangle]; }
    /// Returns the triangles as a mesh in world units, with these places of the vertices.
    Mesh inWorld(const std::vector<Vec3d>& places) const
    {
        Mesh mesh{{}, triangles_, {}};
        for (const Vec3d& p : places) mesh.points.push_back(guard_.unscaled(p));
        return mesh;
    }
    /// Returns the cage with these places of the vertices. Coordinates that are as drawn keep their bits.
    template <typename Place>
    Mesh cageWith(const Place& place) const
    {
        Mesh cage = cage_;
        for (std::size_t i = 0; i < cage.points.size(); ++i) {
            const Vec3d p = place(vertexOf_[i]), moved = guard_.unscaled(p);
            for (int k = 0; k < 3; ++k) {
                if (p[k] != drawn_[vertexOf_[i]][k]) cage.points[i][k] = moved[k];
            }
        }
        return cage;
    }

private:
    void addTriangle(const Vec3I& t, std::size_t face)
    {
        triangles_.emplace_back(vertexOf_[t[0]], vertexOf_[t[1]], vertexOf_[t[2]]);
        faceOf_.push_back(face);
    }
    void addQuad(const Vec4I& q, std::size_t face)
    {
        const auto cosine = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) {
            const Vec3d diagonal = drawn_[c] - drawn_[a];
            const Vec3d n = (drawn_[b] - drawn_[a]).cross(diagonal), m = diagonal.cross(drawn_[d] - drawn_[a]);
            const double lengths = n.length() * m.length();
            return lengths > 0 ? n.dot(m) / lengths : -1;
        };
        const bool isFirst = cosine(q[0], q[1], q[2], q[3]) >= cosine(q[1], q[2], q[3], q[0]);
        const Vec4I corners = isFirst != (splits_ == Splits::lessFolded) ? Vec4I(q[1], q[2], q[3], q[0]) : q;
        addTriangle(Vec3I(corners[0], corners[1], corners[2]), face);
        addTriangle(Vec3I(corners[0], corners[2], corners[3]), face);
    }

    Splits splits_;
    const Mesh& cage_;
    const GuardModel& guard_;
    std::vector<std::uint32_t> vertexOf_; // by point: the first at the same place
    std::vector<Vec3d> drawn_;            // by point
    std::vector<Vec3I> triangles_;
    std::vector<std::size_t> faceOf_; // by triangle
    std::uint32_t firstOfQuads_ = 0;
};

void requireClosed(const Mesh& triangles)
{
    const MeshTopology topology = analyzeTopology(triangles);
    if (topology.boundaryEdges + topology.nonManifoldEdges + topology.misorientedEdges + topology.nonManifoldVertices >
        0) {
        throw InputError("cage", "it is not a closed, oriented 2-manifold (" + std::to_string(topology.boundaryEdges) +
                                     " boundary edges, " + std::to_string(topology.nonManifoldEdges) +
                                     " edges of more than two faces, " + std::to_string(topology.misorientedEdges) +
                                     " edges whose faces disagree, " + std::to_string(topology.nonManifoldVertices) +
                                     " points where surfaces touch); vdbcage repair may help");
    }
    const Vec3d& origin = triangles.points[triangles.triangles.front()[0]];
    double volume = 0;
    for (const Vec3I& t : triangles.triangles) {
        const Vec3d a = triangles.points[t[0]] - origin, b = triangles.points[t[1]] - origin;
        volume += a.dot(b.cross(triangles.points[t[2]] - origin));
    }
    if (volume < 0) throw InputError("cage", "it faces inward; turn its faces around");
}

std::vector<std::size_t> unique(std::vector<std::size_t> list)
{
    std::sort(list.begin(), list.end());
    list.erase(std::unique(list.begin(), list.end()), list.end());
    return list;
}

/// An attempt to make a cage bound.
class Attempt {
public:
    struct Way {
        GrowthPace pace;
        bool aligns; ///< the cage as a whole comes first
    };
    Attempt(const Mesh& cage, const GuardModel& model, WeldedCage::Splits splits)
        : cage_(cage, model, splits), model_(model)
    {
    }
    /// Returns whether the cage bounds.
    bool succeeds(const MoveLimits& limits, const Way& way, DemandFinder& finder, Interrupter* interrupter)
    {
        places_ = cage_.drawn();
        const bool isFree = std::none_of(limits.begin(), limits.end(), [](const auto& limit) { return limit; });
        if (!untangle(places_, cage_.triangles(), limits, model_, interrupter)) return false;
        if (isFree && way.aligns) {
            align(places_, cage_.triangles(), finder, interrupter);
            for (Vec3d& p : places_) p = model_.rounded(p);
        }
        surface_.emplace(cage_.inWorld(places_), model_);
        for (std::uint32_t v = 0; v < limits.size(); ++v) {
            if (limits[v]) surface_->limit(v, *limits[v]);
        }
        return grow(*surface_, cage_.firstOfQuads(), way.pace, finder, interrupter);
    }
    const WeldedCage& cage() const { return cage_; }
    /// \pre it succeeded
    GuardedMesh& surface() { return *surface_; }
    /// Returns the cage as it is, with the faces that keep it from bounding.
    /// \pre it did not succeed
    Fit failed() const
    {
        if (!surface_) return {cageAt(places_), Fit::Obstacle::itself, crossing()};
        const Mesh cage = cage_.cageWith([&](std::uint32_t v) { return surface_->point(v); });
        std::vector<std::size_t> faces = cutting();
        if (!faces.empty()) return {cage, Fit::Obstacle::model, std::move(faces)};
        return {cage, Fit::Obstacle::quads, unmadeQuads()};
    }

private:
    Mesh cageAt(const std::vector<Vec3d>& places) const
    {
        return cage_.cageWith([&](std::uint32_t v) { return places[v]; });
    }
    std::vector<std::size_t> crossing() const
    {
        std::vector<std::size_t> faces;
        for (const std::uint32_t t : crossingTriangles(places_, cage_.triangles(), model_))
            faces.push_back(cage_.faceOf(t));
        return unique(std::move(faces));
    }
    std::vector<std::size_t> cutting() const
    {
        std::vector<std::size_t> faces;
        for (std::uint32_t f = 0; f < cage_.triangles().size(); ++f) {
            bool cuts = surface_->mayCut(f);
            if (surface_->isInQuad(f)) {
                for (const std::uint32_t o : surface_->alternatesIn(f)) cuts = cuts || surface_->mayCut(o);
            }
            if (cuts) faces.push_back(cage_.faceOf(f));
        }
        return unique(std::move(faces));
    }
    std::vector<std::size_t> unmadeQuads() const
    {
        std::vector<std::size_t> faces;
        for (std::uint32_t f = cage_.firstOfQuads(); f < cage_.triangles().size(); ++f) {
            if (!surface_->isInQuad(f)) faces.push_back(cage_.faceOf(f));
        }
        return unique(std::move(faces));
    }

    WeldedCage cage_;
    const GuardModel& model_;
    std::vector<Vec3d> places_;          // of vertices, before growth
    std::optional<GuardedMesh> surface_; // during and after it
};

/// Returns the limits of vertices.
/// \throw InputError for a point that the cage has not
MoveLimits limitsOf(const WeldedCage& cage, const GuardModel& model, std::size_t points, const FitOptions& options)
{
    const Vec3d size = model.tree().box().hi - model.tree().box().lo;
    const double longestSide = std::max({size[0], size[1], size[2]});
    MoveLimits limits(points);
    const auto limitAt = [&](std::size_t vertex) -> MoveLimit& {
        if (!limits[vertex]) {
            limits[vertex].emplace();
            limits[vertex]->home = cage.drawn()[vertex];
            limits[vertex]->radius = options.mostWay * longestSide;
        }
        return *limits[vertex];
    };
    const auto vertexOf = [&](std::size_t point) {
        if (point >= points) {
            throw InputError("kept points", std::to_string(point) + " is not allowed; the cage has " +
                                                std::to_string(points) + " points");
        }
        return cage.vertexOf(point);
    };
    if (std::isfinite(options.mostWay)) {
        for (std::size_t v = 0; v < points; ++v) limitAt(v);
    }
    for (const std::size_t point : options.keptPoints) limitAt(vertexOf(point)).radius = 0;
    for (const FitOptions::Rail& rail : options.rails) {
        MoveLimit& limit = limitAt(vertexOf(rail.point));
        for (const std::size_t i : {0U, 1U, 2U}) limit.mayMove[i] = limit.mayMove[i] && rail.mayMove[i];
    }
    return limits;
}

std::vector<std::size_t> holdingPoints(const Mesh& cage, const std::vector<std::size_t>& faces,
                                       const FitOptions& options)
{
    std::vector<char> holds(cage.points.size(), 0);
    for (const std::size_t point : options.keptPoints) holds[point] = 1;
    for (const FitOptions::Rail& rail : options.rails) holds[rail.point] = 1;
    std::vector<std::size_t> points;
    const auto take = [&](std::uint32_t point) {
        if (holds[point]) points.push_back(point);
    };
    for (const std::size_t face : faces) {
        const bool isTriangle = face < cage.triangles.size();
        for (int i = 0; isTriangle && i < 3; ++i) take(cage.triangles[face][i]);
        for (int i = 0; !isTriangle && i < 4; ++i) take(cage.quads[face - cage.triangles.size()][i]);
    }
    return unique(std::move(points));
}

} // namespace

GuardOptions fitGuardOptions(Precision precision)
{
    GuardOptions options;
    options.minAngleDegrees = 1;
    options.spacing = 2.5e-4; // an eighth of the usual: TetGen fills cages of sheets down to this
    options.precision = precision;
    return options;
}

Mesh placeCage(Mesh cage, const BoundingGuard& guard, PlaceTurns turns, Interrupter* interrupter)
{
    requireUsable(cage, "cage");
    const GuardModel& model = modelOf(guard);
    for (Vec3d& p : cage.points) p = model.scaled(p);
    DemandFinder finder(model, interrupter);
    place(cage.points, triangulate(cage), model.tree().box(), turns == PlaceTurns::quarters, finder, interrupter);
    for (Vec3d& p : cage.points) p = model.unscaled(model.rounded(p));
    return cage;
}

Fit fitCage(const Mesh& cage, const BoundingGuard& guard, const FitOptions& options, Interrupter* interrupter)
{
    requireWithin(FitOptions::tightnesses, options.tightness, "tightness");
    requireWithin(FitOptions::ways, options.mostWay, "most way");
    requireValid(options.tightening);
    requireUsable(cage, "cage");
    const GuardModel& model = modelOf(guard);
    if (model.symmetry()) throw InputError("guard", "it has a plane of symmetry, which a fit does not keep");
    using Splits = WeldedCage::Splits;
    Attempt first(cage, model, Splits::lessFolded);
    const MoveLimits limits = limitsOf(first.cage(), model, cage.points.size(), options);
    requireClosed(first.cage().inWorld(first.cage().drawn()));
    std::optional<Stage> stage(std::in_place, interrupter, StageName::fit);
    DemandFinder finder(model, interrupter);
    // Each works where others sometimes fail.
    constexpr Attempt::Way patient{{25, 3}, true}, quick{{12, 1}, false};
    Attempt other(cage, model, Splits::other);
    Attempt* found = nullptr;
    Fit failed;
    for (const auto& [attempt, way] :
         {std::pair(&first, patient), std::pair(&other, patient), std::pair(&first, quick), std::pair(&other, quick)}) {
        const bool succeeds = attempt->succeeds(limits, way, finder, interrupter);
        if (succeeds) found = attempt;
        if (succeeds) break;
        if (failed.heldFaces.empty()) failed = attempt->failed();
    }
    if (!found) {
        failed.holdingPoints = holdingPoints(cage, failed.heldFaces, options);
        return failed;
    }
    GuardedMesh& surface = found->surface();
    const WeldedCage& welded = found->cage();
    moveBack(surface, welded.drawn(), interrupter);
    stage.reset();
    if (options.tightness > 0) {
        Stage tightening(interrupter, StageName::tighten);
        constexpr double weight = 1; // at a tightness of .5
        std::optional<DrawnShapeTerm> shape;
        if (options.tightness < 1)
            shape.emplace(surface, welded.drawn(), weight * (1 - options.tightness) / options.tightness);
        tightenAndPerturb(surface, options.tightening, interrupter, shape ? &*shape : nullptr);
    }
    return {welded.cageWith([&](std::uint32_t v) { return surface.point(v); })};
}

} // namespace vdbcage
