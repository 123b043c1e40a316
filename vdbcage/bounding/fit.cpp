#include <vdbcage/bounding/fit.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>

#include <vdbcage/bounding/detail/fit/align.h>
#include <vdbcage/bounding/detail/fit/drawn_shape.h>
#include <vdbcage/bounding/detail/fit/grow.h>
#include <vdbcage/bounding/detail/fit/untangle.h>
#include <vdbcage/bounding/detail/fit/welded_cage.h>
#include <vdbcage/bounding/detail/triangles/relax.h>
#include <vdbcage/bounding/detail/triangles/sweep.h>
#include <vdbcage/bounding/detail/triangles/tightening.h>
#include <vdbcage/core/detail/longest_side.h>
#include <vdbcage/core/error.h>
#include <vdbcage/mesh/topology.h>

namespace vdbcage {

namespace {

using namespace detail;

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

std::vector<Vec3d> placesOn(const GuardedMesh& surface)
{
    std::vector<Vec3d> places;
    for (std::uint32_t v = 0; v < surface.vertices(); ++v) places.push_back(surface.point(v));
    return places;
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
        cage_.mirror(places_);
        if (model_.symmetry() && !crossingTriangles(places_, cage_.triangles(), model_).empty()) return false;
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
        if (!surface_) return {cage_.cageWith(places_), Fit::Obstacle::itself, crossing()};
        const Mesh cage = cage_.cageWith(placesOn(*surface_));
        std::vector<std::size_t> faces = cutting();
        if (!faces.empty()) return {cage, Fit::Obstacle::model, std::move(faces)};
        return {cage, Fit::Obstacle::quads, unmadeQuads()};
    }

private:
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
        for (std::uint32_t f = 0; f < cage_.guardedTriangles(); ++f) {
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
        for (std::uint32_t f = cage_.firstOfQuads(); f < cage_.guardedTriangles(); ++f) {
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
    MoveLimits limits(points);
    const auto limitAt = [&](std::size_t vertex) -> MoveLimit& {
        if (!limits[vertex]) {
            limits[vertex].emplace();
            limits[vertex]->home = cage.drawn()[vertex];
            limits[vertex]->radius = options.mostWay * longestSide(model.box()) * model.scale();
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
    // Mirror images are kept along.
    for (const std::size_t point : options.keptPoints) {
        const std::uint32_t v = vertexOf(point);
        limitAt(v).radius = limitAt(cage.partnerOf(v)).radius = 0;
    }
    for (const FitOptions::Rail& rail : options.rails) {
        const std::uint32_t v = vertexOf(rail.point);
        for (MoveLimit* limit : {&limitAt(v), &limitAt(cage.partnerOf(v))}) {
            for (const std::size_t i : {0U, 1U, 2U}) limit->mayMove[i] = limit->mayMove[i] && rail.mayMove[i];
        }
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
    const Box box{model.scaled(model.box().min()), model.scaled(model.box().max())};
    place(cage.points, triangulate(cage), box, turns == PlaceTurns::quarters, finder, interrupter);
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
    return {welded.cageWith(placesOn(surface))};
}

} // namespace vdbcage
