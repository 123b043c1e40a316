// Based on: Tarini, Pietroni, Cignoni, Panozzo, Puppo, "Practical Quad Mesh Simplification", 2010 (local operations,
//           one after the other).
// Differs: under a guard, and kept only where distance, shape and valences together are better.

#include <vdbcage/bounding/detail/quads/quad_cleanup.h>

#include <algorithm>
#include <array>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include <vdbcage/bounding/detail/guard/admissible.h>
#include <vdbcage/bounding/detail/quads/quad_change.h>
#include <vdbcage/bounding/detail/quads/quad_relax.h>
#include <vdbcage/bounding/detail/triangles/relax.h>

namespace vdbcage::detail {

namespace {

using Vertices = std::vector<std::uint32_t>;

void sortOut(Vertices& list)
{
    std::sort(list.begin(), list.end());
    list.erase(std::unique(list.begin(), list.end()), list.end());
}

int moreFaces(QuadChange::Kind kind)
{
    if (kind == QuadChange::Kind::rotation) return 0;
    return kind == QuadChange::Kind::split ? 1 : -1;
}

class Cleaner {
public:
    Cleaner(GuardedMesh& surface, QuadTable& table, std::size_t faces, Interrupter* interrupter)
        : surface_(surface), table_(table), most_(faces), interrupter_(interrupter), sample_(areaPerSample(surface)),
          perFace_(distancePerPolygon(surface, table, sample_, interrupter)),
          meanDistance_(perFace_ * static_cast<double>(faceCount()) / area(surface)),
          rough_(table, scaled({2, 0.1, 0, 2, unfitWeight}, perFace_)),
          fine_(table, scaled({0.5, 0.15, 0, 0.35, unfitWeight}, perFace_)), measure_(surface, sample_),
          least_(std::min(faceCount(), most_ - most_ / 20)), triesLeft_(faceCount() + faceCount() / 2)
    {
    }

    void run()
    {
        constexpr int passes = 8;
        constexpr double forAFace = -1.5; // the loss that is allowed while there are too many faces
        for (int pass = 0; pass < passes; ++pass) {
            touched_.assign(surface_.vertices(), 0);
            tries_.assign(surface_.vertices(), 0);
            bool isChanged = false;
            for (const QuadChange& change : quadChanges(surface_, table_, hasTooMany() ? forAFace : alike)) {
                throwIfInterrupted(interrupter_);
                isChanged = tryChange(change) || isChanged;
            }
            if (!isChanged) return;
        }
    }

private:
    static constexpr double alike = -0.1; // changes with a gain above this leave valences about as good

    std::size_t faceCount() const { return surface_.liveFaces() - table_.count(); }
    bool hasTooMany() const { return faceCount() > most_; }
    /// Returns whether a vertex is touched; those made since the pass began are.
    bool isTouched(std::uint32_t v) const { return v >= touched_.size() || touched_[v] != 0; }
    std::size_t lastChange(std::uint32_t v) const { return v < changedAt_.size() ? changedAt_[v] : 0; }

    bool tryChange(const QuadChange& change)
    {
        constexpr int mostTries = 6; // of a vertex in a pass
        const std::uint32_t named = change.vertices[0];
        const int more = moreFaces(change.kind);
        if (isTouched(named) || tries_[named] >= mostTries) return false;
        if (more > 0 ? faceCount() >= most_ : more < 0 && faceCount() <= least_) return false;
        if (hasTooMany() ? triesLeft_ == 0 && more >= 0 : triesLeft_ == 0) return false;
        if (change.gain <= alike && !(more < 0 && hasTooMany())) return false;
        const auto key = std::make_pair(change.kind, change.vertices);
        const auto known = failedAt_.find(key);
        if (known != failedAt_.end() && std::all_of(change.vertices.begin(), change.vertices.end(),
                                                    [&](std::uint32_t v) { return lastChange(v) < known->second; })) {
            return false;
        }
        std::optional<PlannedChange> plan = planned(surface_, table_, change);
        if (!plan) return false;
        const auto& vertices = plan->vertices;
        if (std::any_of(vertices.begin(), vertices.end(), [&](std::uint32_t v) { return isTouched(v); })) return false;
        ++tries_[named];
        ++time_;
        if (triesLeft_ > 0) --triesLeft_;
        if (make(*plan, more)) return true;
        if (change.kind == QuadChange::Kind::rotation) {
            // The same change, with the other end of the new edge as the centre.
            const auto [a, b, c, d] = change.vertices;
            plan = planned(surface_, table_, {change.kind, {a, b, d, c}, change.gain});
            if (plan && make(*plan, more)) return true;
        }
        failedAt_[key] = ++time_;
        return false;
    }

    /// Makes a change and relaxes the vertices around it, or leaves all as it was. Returns whether it was made.
    bool make(const PlannedChange& plan, int more)
    {
        constexpr std::array heights{0.0, 0.03, 0.1, 0.25};
        const StarChange& star = plan.star;
        Vertices around = plan.vertices;
        for (const auto& edge : star.link) around.insert(around.end(), edge.begin(), edge.end());
        sortOut(around);
        const double limit = energy(around) - price(more);
        const GuardedMesh::Saved saved = surface_.saved(star);
        const QuadTable::Saved quads = table_.saved(around);
        const double length = (surface_.point(star.link.front()[0]) - plan.place).length();
        if (!applyNear(surface_, star, plan.place, length, heights)) return false;
        apply(table_, plan);
        Vertices now = around;
        now.push_back(star.centre);
        now.erase(std::remove(now.begin(), now.end(), star.removed), now.end());
        sortOut(now);
        std::vector<GuardedMesh::Saved> places;
        for (const std::uint32_t v : now) places.push_back(surface_.saved(starOf(surface_, v)));
        if (relaxBelow(limit, now)) {
            touched_.resize(surface_.vertices(), 1);
            changedAt_.resize(surface_.vertices(), 0);
            for (const std::uint32_t v : plan.vertices) touched_[v] = 1;
            for (const std::uint32_t v : now) changedAt_[v] = time_;
            return true;
        }
        for (const GuardedMesh::Saved& place : places) surface_.restore(place);
        table_.restore(quads);
        surface_.restore(saved);
        return false;
    }

    /// Returns the cost of `more` faces. A face is worth its distance where there may be no more; below that number,
    /// one less is a loss.
    double price(int more) const
    {
        constexpr double ofFree = -0.3;
        return (faceCount() >= most_ ? 1 : ofFree) * more * perFace_;
    }

    /// Relaxes vertices. Returns whether that brings the energy below a limit.
    bool relaxBelow(double limit, const Vertices& vertices)
    {
        constexpr double push = 0.3; // of the mean distance: room for turning
        constexpr int straightenings = 3, sweeps = 3;
        constexpr double hopeless = 4; // faces' distance; more than the last sweeps gain
        inflate(surface_, vertices, push * meanDistance_, interrupter_);
        for (int i = 0; i < straightenings; ++i) straighten(surface_, table_, vertices, interrupter_);
        tighten(surface_, vertices, 1, sample_, interrupter_, &rough_);
        if (!(energy(vertices) < limit + hopeless * perFace_)) return false;
        tighten(surface_, vertices, sweeps, sample_, interrupter_, &fine_);
        return energy(vertices) < limit;
    }

    /// Returns the energy to be reduced, as far as it depends on these vertices. Infinite where two polygons share two
    /// edges: then a vertex has no third edge.
    double energy(const Vertices& vertices) const
    {
        constexpr double ofValences = 1.5;
        Vertices faces, quads;
        double valences = 0;
        for (const std::uint32_t v : vertices) {
            faces.insert(faces.end(), surface_.facesOf(v).begin(), surface_.facesOf(v).end());
            quads.insert(quads.end(), table_.quadsOf(v).begin(), table_.quadsOf(v).end());
            valences += (surface_.isOnPlane(v) ? 0.5 : 1) * irregularity(polygonValence(surface_, table_, v));
        }
        sortOut(faces);
        sortOut(quads);
        double sum = ofValences * perFace_ * valences;
        std::uint32_t seed = TriangleBvh::none;
        for (const std::uint32_t f : faces) sum += measure_.integral(surface_.corners(f), seed);
        for (const std::uint32_t q : quads) sum += fine_.of(surface_, q);
        return sum;
    }

    GuardedMesh& surface_;
    QuadTable& table_;
    const std::size_t most_;
    Interrupter* const interrupter_;
    const double sample_, perFace_, meanDistance_;
    const QuadShapeTerm rough_, fine_;
    const DistanceMeasure measure_;
    const std::size_t least_; // faces
    std::size_t triesLeft_, time_ = 0;
    std::vector<char> touched_; // by vertex: changed in this pass
    std::vector<int> tries_;    // by vertex: in this pass
    // The times when a vertex changed, and when a change failed: it is not tried again before its vertices change.
    std::vector<std::size_t> changedAt_;
    std::map<std::pair<QuadChange::Kind, std::array<std::uint32_t, 4>>, std::size_t> failedAt_;
};

} // namespace

void cleanUp(GuardedMesh& surface, QuadTable& table, std::size_t faces, Interrupter* interrupter)
{
    if (surface.liveFaces() > 0) Cleaner(surface, table, faces, interrupter).run();
}

} // namespace vdbcage::detail
