#include <vdbcage/bounding/detail/fit/grow.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

#include <vdbcage/bounding/detail/guard/face_queries.h>
#include <vdbcage/bounding/detail/triangles/sweep.h>

namespace vdbcage::detail {

namespace {

/// The demands on each vertex of a surface.
class VertexDemands {
public:
    VertexDemands(const GuardedMesh& surface, std::vector<Demand> list)
        : list_(std::move(list)), of_(surface.vertices())
    {
        constexpr double leastWeight = 1e-3;
        for (std::uint32_t i = 0; i < list_.size(); ++i) {
            for (const int k : {0, 1, 2}) {
                if (list_[i].weights[k] > leastWeight) of_[list_[i].corners[k]].push_back({i, k});
            }
        }
    }
    /// Returns the sum of squares that the demands on a vertex lack with it at `p`; adds its change to `change`.
    double cost(const GuardedMesh& surface, std::uint32_t v, const Vec3d& p, Quadratic* change = nullptr) const
    {
        double sum = 0;
        for (const auto& [number, corner] : of_[v]) {
            const Demand& d = list_[number];
            const double b = d.weights[corner];
            const double lack = d.lack(surface) - b * d.normal.dot(p - surface.point(v));
            if (!(lack > 0)) continue;
            sum += lack * lack;
            if (!change) continue;
            for (int i = 0; i < 3; ++i) {
                for (int j = 0; j < 3; ++j) change->curvature[i][j] += 2 * b * b * d.normal[i] * d.normal[j];
                change->slope[i] -= 2 * b * lack * d.normal[i];
            }
        }
        return sum;
    }
    /// Returns the longest way of a vertex that one of its demands asks for; 0 if there is none.
    double farthest(const GuardedMesh& surface, std::uint32_t v) const
    {
        double most = 0;
        for (const auto& [number, corner] : of_[v])
            most = std::max(most, list_[number].lack(surface) / list_[number].weights[corner]);
        return most;
    }

private:
    struct Share {
        std::uint32_t demand;
        int corner;
    };
    std::vector<Demand> list_;
    std::vector<std::vector<Share>> of_;
};

/// The quads around each vertex, made or not, and how far they are from parallelograms.
class QuadsAround {
public:
    QuadsAround(const GuardedMesh& surface, std::uint32_t firstOfQuads) : of_(surface.vertices())
    {
        for (std::uint32_t f = firstOfQuads; f < surface.faces(); f += 2) {
            quads_.push_back(surface.quadOf(f, f + 1));
            for (const int k : {0, 1, 2, 3})
                of_[quads_.back()[k]].push_back({static_cast<std::uint32_t>(quads_.size() - 1), k});
        }
    }
    std::size_t count() const { return quads_.size(); }
    const Vec4I& corners(std::size_t quad) const { return quads_[quad]; }
    /// Returns the step of a corner to where the quad is a parallelogram, if all corners do their part.
    Vec3d step(const GuardedMesh& surface, std::size_t quad, int corner) const
    {
        const std::array<Vec3d, 4> p = pointsOf(surface, quads_[quad]);
        return (corner % 2 == 0 ? -0.25 : 0.25) * (p[0] - p[1] + p[2] - p[3]);
    }
    /// Returns the sum of squares of the steps of a vertex with it at `p`, times `weight`; adds its change to `change`.
    double cost(const GuardedMesh& surface, std::uint32_t v, const Vec3d& p, double weight,
                Quadratic* change = nullptr) const
    {
        double sum = 0;
        for (const auto& [quad, corner] : of_[v]) {
            const Vec3d left = step(surface, quad, corner) - 0.25 * (p - surface.point(v));
            sum += weight * left.lengthSqr();
            if (!change) continue;
            for (int i = 0; i < 3; ++i) {
                change->curvature[i][i] += weight / 8;
                change->slope[i] -= weight * left[i] / 2;
            }
        }
        return sum;
    }

private:
    struct Corner {
        std::uint32_t quad;
        int corner;
    };
    std::vector<Vec4I> quads_;
    std::vector<std::vector<Corner>> of_;
};

double radiusOf(const GuardedMesh& surface, const StarChange& star)
{
    double longest2 = 0;
    for (const auto& edge : star.link) {
        longest2 = std::max(longest2, (surface.point(edge[0]) - surface.point(star.centre)).lengthSqr());
    }
    return std::sqrt(longest2);
}

Vec3d meanOf(const GuardedMesh& surface, const GuardedMesh::Vertices& vertices)
{
    Vec3d sum(0.0);
    for (const std::uint32_t v : vertices) sum += surface.point(v);
    return sum / static_cast<double>(vertices.size());
}

/// Grows a surface, round by round.
class Growth {
public:
    Growth(GuardedMesh& surface, std::uint32_t firstOfQuads, const GrowthPace& pace, DemandFinder& finder,
           Interrupter* interrupter)
        : surface_(surface), firstOfQuads_(firstOfQuads), pace_(pace), finder_(finder), interrupter_(interrupter),
          quads_(surface, firstOfQuads), vertices_(allVertices(surface)), lacks_(surface.vertices(), 0),
          waits_(surface.vertices(), 0), loosened_(surface.vertices(), 0)
    {
        for (std::uint32_t v = 0; v < surface.vertices(); ++v) rest_.push_back(surface.point(v));
        for (std::uint32_t f = 0; f < surface.faces(); ++f) surface.letCut(f, true);
        for (std::uint32_t q = 0; q < quads_.count(); ++q) unmade_.push_back({q, 0});
        makeQuads(20);
    }

    /// Returns whether the surface bounds the model and has all its quads; if not, brings it nearer to that.
    /// \param mayLoosen smooth places that do not get on
    bool isDoneAfterRound(bool mayLoosen)
    {
        makeQuads(2);
        std::vector<Demand> list = finder_.ofSamples(surface_);
        const bool isSettled = !letUnsettledCut(list);
        if (isSettled && unmade_.empty()) return true;
        const std::vector<Demand> contacts = finder_.ofContacts(surface_);
        list.insert(list.end(), contacts.begin(), contacts.end());
        const VertexDemands demands(surface_, std::move(list));
        place(demands);
        if (mayLoosen) loosen();
        return false;
    }

private:
    /// A quad that is two triangles for now, and the rounds since then; if negative, it is not tried yet.
    struct Unmade {
        std::uint32_t quad;
        int rounds;
    };
    std::uint32_t faceOf(std::uint32_t quad) const { return firstOfQuads_ + 2 * quad; }

    void makeQuads(int sweeps);
    bool tryToMake(std::uint32_t quad);
    bool letUnsettledCut(const std::vector<Demand>& demands);
    void place(const VertexDemands& demands);
    std::optional<Vec3d> placeOf(std::uint32_t v, const StarChange& star, const VertexDemands& demands) const;
    void splitQuadsAround(const std::vector<char>& isStuck);
    void loosen();
    std::vector<char> ringsAround(std::vector<char> is, int rings) const;

    GuardedMesh& surface_;
    std::uint32_t firstOfQuads_;
    GrowthPace pace_;
    DemandFinder& finder_;
    Interrupter* interrupter_;
    QuadsAround quads_;
    std::vector<std::uint32_t> vertices_;
    std::vector<Vec3d> rest_;   // by vertex: moves from there are to be smooth
    std::vector<int> lacks_;    // by vertex: rounds in which demands on it were not met, one after the other
    std::vector<int> waits_;    // by vertex: rounds in which it found no place, since its quads were split
    std::vector<int> loosened_; // by vertex: times
    std::vector<Unmade> unmade_;
};

/// Makes a quad of its two triangles. Its other split may cut the model, as long as it is a demand to mend.
bool Growth::tryToMake(std::uint32_t quad)
{
    const std::uint32_t f = faceOf(quad), g = f + 1;
    const bool first = surface_.mayCut(f), second = surface_.mayCut(g);
    surface_.letCut(f, true);
    surface_.letCut(g, true);
    const bool made = makeQuad(surface_, f, g);
    surface_.letCut(f, first);
    surface_.letCut(g, second);
    return made;
}

/// Makes those quads that are allowed, and moves the corners of the others to where they are nearer to parallelograms.
void Growth::makeQuads(int sweeps)
{
    constexpr double smoothness = 0.1;
    for (Unmade& u : unmade_) ++u.rounds;
    for (int i = 0; i < sweeps; ++i) {
        const auto isMade = [&](const Unmade& u) { return u.rounds > 0 && tryToMake(u.quad); };
        unmade_.erase(std::remove_if(unmade_.begin(), unmade_.end(), isMade), unmade_.end());
        std::vector<Vec3d> step(surface_.vertices(), Vec3d(0.0));
        std::vector<int> count(surface_.vertices(), 0);
        for (const auto& [quad, rounds] : unmade_) {
            if (rounds < 0) continue;
            for (const int k : {0, 1, 2, 3}) {
                step[quads_.corners(quad)[k]] += quads_.step(surface_, quad, k);
                ++count[quads_.corners(quad)[k]];
            }
        }
        std::vector<std::uint32_t> corners;
        for (const std::uint32_t v : vertices_) {
            if (count[v] > 0) corners.push_back(v);
        }
        if (corners.empty()) return;
        sweep(surface_, corners, interrupter_, [&](std::uint32_t v, const StarChange& star) {
            const Vec3d& p = surface_.point(v);
            const Vec3d toMean = meanOf(surface_, surface_.neighbours(v)) - p;
            return towards(surface_, star, p + step[v] / static_cast<double>(count[v]) + smoothness * toMean,
                           {1.0, 0.5, 0.2});
        });
    }
}

/// Lets those faces cut the model that come too near to it, or that a part of it is outside of: the others have arrived
/// and stay clear. Returns whether there are any.
bool Growth::letUnsettledCut(const std::vector<Demand>& demands)
{
    std::vector<char> cuts(surface_.faces(), 0);
    for (const Demand& d : demands) cuts[d.face] = 1;
    parallelFor(std::uint32_t(0), surface_.faces(), [&](std::uint32_t f) {
        const bool isUsed = surface_.isFace(f) || surface_.isInQuad(f);
        if (isUsed && !cuts[f]) cuts[f] = !surface_.guard().clear(surface_.corners(f), TriangleBvh::none, nullptr);
    });
    for (std::uint32_t f = 0; f < surface_.faces(); ++f) surface_.letCut(f, cuts[f] != 0);
    return std::find(cuts.begin(), cuts.end(), 1) != cuts.end();
}

std::vector<char> Growth::ringsAround(std::vector<char> is, int rings) const
{
    for (int ring = 0; ring < rings; ++ring) {
        const std::vector<char> inner = is;
        for (const std::uint32_t v : vertices_) {
            if (!inner[v]) continue;
            for (const std::uint32_t w : surface_.neighbours(v)) is[w] = 1;
        }
    }
    return is;
}

std::vector<std::uint32_t> listed(const std::vector<char>& is)
{
    std::vector<std::uint32_t> list;
    for (std::uint32_t v = 0; v < is.size(); ++v) {
        if (is[v]) list.push_back(v);
    }
    return list;
}

/// Moves the vertices that demands ask for, and those next to them, to where demands, a smooth change and the shape of
/// quads agree best.
void Growth::place(const VertexDemands& demands)
{
    constexpr int sweeps = 2, patience = 5;
    std::vector<char> isAsked(surface_.vertices(), 0);
    for (const std::uint32_t v : vertices_) {
        isAsked[v] = demands.cost(surface_, v, surface_.point(v)) > 0;
        lacks_[v] = isAsked[v] ? lacks_[v] + 1 : 0;
    }
    const std::vector<std::uint32_t> active = listed(ringsAround(isAsked, 1));
    std::vector<char> isStuck(surface_.vertices(), 0);
    for (int i = 0; i < sweeps; ++i) {
        sweep(surface_, active, interrupter_, [&](std::uint32_t v, const StarChange& star) {
            const std::optional<Vec3d> place = placeOf(v, star, demands);
            isStuck[v] = !place && lacks_[v] >= patience;
            return place;
        });
    }
    for (const std::uint32_t v : active) {
        if (isStuck[v]) ++waits_[v];
        isStuck[v] = isStuck[v] && waits_[v] >= 2;
        if (isStuck[v]) waits_[v] = -patience;
    }
    for (const auto& [quad, rounds] : unmade_) {
        if (rounds < patience || rounds % patience != 0) continue;
        for (const int k : {0, 1, 2, 3}) isStuck[quads_.corners(quad)[k]] = 1;
    }
    splitQuadsAround(isStuck);
}

std::optional<Vec3d> Growth::placeOf(std::uint32_t v, const StarChange& star, const VertexDemands& demands) const
{
    // The shape gives way to demands that stay.
    constexpr double smoothness = 0.02, squareness = 0.2, decay = 0.7, leastShape = 1e-4, mostWays = 4,
                     dampingShare = 0.05;
    const double shape = std::max(std::pow(decay, std::max(0, lacks_[v] - 1)), leastShape);
    const double stiffness = smoothness * shape;
    const Vec3d& p = surface_.point(v);
    Vec3d moves(0.0);
    const GuardedMesh::Vertices around = surface_.neighbours(v);
    for (const std::uint32_t w : around) moves += surface_.point(w) - rest_[w];
    const Vec3d smooth = rest_[v] + moves / static_cast<double>(around.size());
    const auto cost = [&](const Vec3d& x, Quadratic* change) {
        return demands.cost(surface_, v, x, change) + 0.5 * stiffness * (x - smooth).lengthSqr() +
               quads_.cost(surface_, v, x, squareness * shape, change);
    };
    Quadratic change;
    const double before = cost(p, &change);
    // Demands leave moves along the surface free, which would take up all of a short step.
    const double damping = dampingShare * change.curvature.trace();
    for (int i = 0; i < 3; ++i) {
        change.curvature[i][i] += stiffness + damping;
        change.slope[i] += stiffness * (p - smooth)[i];
    }
    if (star.onPlane) change.slope[surface_.guard().symmetry()->axis] = 0;
    const double way = demands.farthest(surface_, v), radius = radiusOf(surface_, star);
    Vec3d place = p;
    const bool found =
        descend(surface_, star, place, change, {way > 0 ? std::min(radius, mostWays * way) : radius, 1.0, 1e-5},
                [&](const Vec3d& x) { return cost(x, nullptr) < before * (1 - 1e-4); });
    if (!found) return std::nullopt;
    return place;
}

/// Makes the quads around stuck vertices triangles for some rounds: that they have to stay convex is what mostly stops
/// these.
void Growth::splitQuadsAround(const std::vector<char>& isStuck)
{
    constexpr int wait = 2;
    for (std::uint32_t q = 0; q < quads_.count(); ++q) {
        const Vec4I& ids = quads_.corners(q);
        const bool isAround = isStuck[ids[0]] || isStuck[ids[1]] || isStuck[ids[2]] || isStuck[ids[3]];
        if (!isAround || !surface_.isInQuad(faceOf(q))) continue;
        surface_.splitQuad(faceOf(q));
        unmade_.push_back({q, -wait});
    }
}

/// Smooths the surroundings of places that do not get on, whether the model is in the way or not: creases that the
/// model cuts from both sides, and quads that find no room to be convex.
void Growth::loosen()
{
    constexpr int sweeps = 3;
    std::vector<char> isLoose(surface_.vertices(), 0);
    int rings = 0;
    const auto take = [&](std::uint32_t v) {
        isLoose[v] = 1;
        lacks_[v] = 0;
        rings = std::max(rings, std::min(++loosened_[v], pace_.mostRings));
    };
    for (const std::uint32_t v : vertices_) {
        if (lacks_[v] >= pace_.patience) take(v);
    }
    for (Unmade& u : unmade_) {
        if (u.rounds < pace_.patience) continue;
        u.rounds = 0;
        for (const int k : {0, 1, 2, 3}) take(quads_.corners(u.quad)[k]);
    }
    if (rings == 0) return;
    const std::vector<std::uint32_t> vertices = listed(ringsAround(isLoose, rings - 1));
    for (const std::uint32_t v : vertices) {
        for (const auto* faces : {&surface_.facesOf(v), &surface_.alternatesOf(v)}) {
            for (const std::uint32_t f : *faces) surface_.letCut(f, true);
        }
    }
    for (int i = 0; i < sweeps; ++i) {
        // Creases go, and what is smooth stays where it is.
        std::vector<Vec3d> toMean(surface_.vertices(), Vec3d(0.0));
        for (const std::uint32_t v : vertices_)
            toMean[v] = meanOf(surface_, surface_.neighbours(v)) - surface_.point(v);
        sweep(surface_, vertices, interrupter_, [&](std::uint32_t v, const StarChange& star) {
            Vec3d around(0.0);
            const auto ring = surface_.neighbours(v);
            for (const std::uint32_t w : ring) around += toMean[w];
            around /= static_cast<double>(ring.size());
            return towards(surface_, star, surface_.point(v) + 0.7 * (toMean[v] - around), {1.0, 0.5, 0.2});
        });
    }
    makeQuads(12); // while nothing is in the way
    for (const std::uint32_t v : vertices) rest_[v] = surface_.point(v);
}

} // namespace

bool grow(GuardedMesh& surface, std::uint32_t firstOfQuads, const GrowthPace& pace, DemandFinder& finder,
          Interrupter* interrupter)
{
    constexpr int rounds = 150;
    Growth growth(surface, firstOfQuads, pace, finder, interrupter);
    for (int i = 0; i < rounds; ++i) {
        throwIfInterrupted(interrupter, 100 * i / rounds);
        // Places that are loosened late have time to come back.
        if (growth.isDoneAfterRound(i + pace.patience < rounds)) return true;
    }
    return false;
}

} // namespace vdbcage::detail
