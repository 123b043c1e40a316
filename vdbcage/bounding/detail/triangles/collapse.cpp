// Based on: Garland, Heckbert, "Surface Simplification Using Quadric Error Metrics", 1997.
//           Sander, Gu, Gortler, Hoppe, Snyder, "Silhouette Clipping", 2000 (decimation that stays outside).
//           Hoppe, "Progressive Meshes", 1996 (a recorded sequence of collapses answers every number of faces).
// Differs: every collapse must pass the guard; its vertex is pushed outward until it does, and then moved along the
// planes of its contacts to where its quadric is least.

#include <vdbcage/bounding/detail/triangles/collapse.h>

#include <vdbcage/bounding/detail/guard/admissible.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <queue>
#include <utility>

#include <tbb/blocked_range.h>
#include <vdbcage/bounding/detail/triangles/vertex_quadrics.h>
#include <vdbcage/core/detail/parallel.h>

namespace vdbcage::detail {

namespace {

/// An edge u < v in a queue that has the cheapest in front; edge numbers break ties.
struct QueuedEdge {
    static constexpr std::uint32_t none = ~std::uint32_t(0);

    double cost;
    std::uint32_t u, v, stamp;
    std::uint32_t place =
        none; ///< its number; with none the cost is the best place's, allowed or not: it can only grow

    bool operator<(const QueuedEdge& o) const // std::priority_queue has its largest in front
    {
        if (cost != o.cost) return cost > o.cost;
        if (u != o.u) return u > o.u;
        return v > o.v;
    }
};

using Edge = std::pair<std::uint32_t, std::uint32_t>;

std::vector<Edge> allEdges(const GuardedMesh& surface)
{
    std::vector<Edge> edges;
    for (std::uint32_t u = 0; u < surface.vertices(); ++u) {
        for (const std::uint32_t v : surface.neighbours(u)) {
            if (u < v) edges.emplace_back(u, v);
        }
    }
    return edges;
}

class QuadricCollapser {
public:
    explicit QuadricCollapser(GuardedMesh& surface)
        : surface_(surface), quadrics_(surface), stamp_(surface.vertices(), 0)
    {
    }

    /// Collapses until `faces` are left.
    void run(std::size_t faces, Interrupter* interrupter)
    {
        while (surface_.liveFaces() > faces && refillIfEmpty()) {
            throwIfInterrupted(interrupter);
            const std::size_t collapsesLeft = (surface_.liveFaces() - faces + 1) / 2;
            collapseBatch(std::min(collapsesLeft, batchSize()), true, [](const StarChange&, const Vec3d&) {});
        }
    }

    /// Collapses batches until at most `faces` of the `first` faces are left. Calls made(star, place) for each collapse
    /// and ended() after each batch. A batch has the same edges, whatever comes after.
    template <typename Made, typename Ended>
    void runBatches(std::size_t first, std::size_t faces, Interrupter* interrupter, const Made& made,
                    const Ended& ended)
    {
        while (surface_.liveFaces() > faces) {
            throwIfInterrupted(interrupter, static_cast<int>(100 * (first - surface_.liveFaces()) / (first - faces)));
            if (!refillIfEmpty()) return;
            collapseBatch(batchSize(), false, made);
            ended();
        }
    }

private:
    struct Proposal {
        QueuedEdge edge;
        std::optional<Vec3d> place;
        StarChange star;
    };

    /// Refills the queue: blocked collapses may be allowed since their surroundings changed. Returns false if nothing
    /// changed.
    bool refillIfEmpty()
    {
        if (!queue_.empty()) return true;
        if (surface_.liveFaces() == facesAtLastFill_) return false;
        facesAtLastFill_ = surface_.liveFaces();
        push(allEdges(surface_));
        return !queue_.empty();
    }

    /// Returns the size of a batch: few edges where few are left, so that their order matters more.
    std::size_t batchSize() const { return std::clamp<std::size_t>(surface_.liveFaces() / 200, 4, 64); }

    template <typename Made>
    void collapseBatch(std::size_t size, bool slides, const Made& made)
    {
        std::vector<Proposal> proposals;
        while (proposals.size() < size && !queue_.empty()) {
            const QueuedEdge& edge = queue_.top();
            if (isCurrent(edge)) {
                const bool hasPlace = edge.place != QueuedEdge::none;
                proposals.push_back({edge, hasPlace ? std::optional<Vec3d>(places_[edge.place]) : std::nullopt, {}});
            }
            queue_.pop();
        }
        parallelFor(std::size_t(0), proposals.size(), [&](std::size_t i) { find(proposals[i], slides); });
        std::stable_sort(proposals.begin(), proposals.end(),
                         [](const Proposal& a, const Proposal& b) { return b.edge < a.edge; });
        Batch batch(surface_);
        std::vector<std::uint32_t> kept;
        for (const Proposal& p : proposals) {
            QueuedEdge edge = p.edge;
            if (!p.place || !isCurrent(edge)) continue;
            const bool isWorse = !queue_.empty() && queue_.top().cost < edge.cost;
            if (isWorse || !batch.apply(p.star, *p.place)) {
                edge.place = static_cast<std::uint32_t>(places_.size());
                places_.push_back(*p.place);
                queue_.push(edge);
                continue;
            }
            made(p.star, *p.place);
            quadrics_.merge(edge.u, edge.v);
            ++stamp_[edge.u];
            ++stamp_[edge.v];
            kept.push_back(edge.u);
        }
        std::vector<Edge> edges;
        for (const std::uint32_t u : kept) {
            for (const std::uint32_t w : surface_.neighbours(u)) edges.push_back(std::minmax(u, w));
        }
        std::sort(edges.begin(), edges.end());
        edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
        push(edges);
    }

    /// Returns a number that stays the same only as long as no edge at either end changes: both stamps only grow.
    std::uint32_t stamp(std::uint32_t u, std::uint32_t v) const { return stamp_[u] + stamp_[v]; }

    bool isCurrent(const QueuedEdge& edge) const
    {
        return edge.stamp == stamp(edge.u, edge.v) && surface_.isVertex(edge.u) && surface_.isVertex(edge.v);
    }

    void push(const std::vector<Edge>& edges)
    {
        std::vector<double> costs(edges.size());
        parallelFor(tbb::blocked_range<std::size_t>(0, edges.size(), 32), [&](const auto& range) {
            std::array<Quadric, 4> quadrics;
            std::array<Vec3d, 4> places;
            for (std::size_t first = range.begin(); first < range.end(); first += quadrics.size()) {
                const std::size_t count = std::min(quadrics.size(), range.end() - first);
                for (std::size_t i = 0; i < count; ++i) {
                    quadrics[i] = quadrics_.sum(edges[first + i].first, edges[first + i].second);
                }
                const auto found = Quadric::bestPlaces(quadrics, VertexQuadrics::stiffness, places);
                for (std::size_t i = 0; i < count; ++i) {
                    const auto [u, v] = edges[first + i];
                    costs[first + i] = quadrics_.cost(quadrics[i], quadrics_.optimum(found[i], places[i], u, v));
                }
            }
        });
        for (std::size_t i = 0; i < edges.size(); ++i) {
            const auto [u, v] = edges[i];
            queue_.push({costs[i], u, v, stamp(u, v)});
        }
    }

    /// Finds a proposal's star and an allowed place with its cost, or removes its place.
    void find(Proposal& proposal, bool slides) const
    {
        QueuedEdge& edge = proposal.edge;
        std::optional<Vec3d>& place = proposal.place;
        if (!starOfCollapse(surface_, edge.u, edge.v, proposal.star)) {
            place.reset();
            return;
        }
        if (place && allows(surface_, proposal.star, *place)) return;
        const Quadric q = quadrics_.sum(edge.u, edge.v);
        place = quadrics_.findPlace(proposal.star, q, slides);
        if (place) edge.cost = quadrics_.cost(q, *place);
    }

    GuardedMesh& surface_;
    VertexQuadrics quadrics_;
    std::vector<std::uint32_t> stamp_; // grows when an edge at the vertex changes: older queue entries become void
    std::priority_queue<QueuedEdge> queue_;
    std::vector<Vec3d> places_; // allowed when they were found, of edges that went back into the queue
    std::size_t facesAtLastFill_ = 0;
};

} // namespace

void collapseByQuadrics(GuardedMesh& surface, std::size_t faces, Interrupter* interrupter)
{
    QuadricCollapser(surface).run(faces, interrupter);
}

void collapseInBatches(GuardedMesh& surface, std::size_t faces, Interrupter* interrupter)
{
    QuadricCollapser(surface).runBatches(
        surface.liveFaces(), faces, interrupter, [](const StarChange&, const Vec3d&) {}, [] {});
}

class CollapseSequence::Recorder {
public:
    explicit Recorder(GuardedMesh start)
        : start_(std::move(start)), end_(start_), collapser_(end_), stops_{{0, start_.liveFaces()}}
    {
    }

    GuardedMesh at(std::size_t faces, Interrupter* interrupter)
    {
        collapser_.runBatches(
            start_.liveFaces(), faces, interrupter,
            [&](const StarChange& star, const Vec3d& place) {
                collapses_.push_back({star.centre, star.removed, place});
            },
            [&] {
                stops_.push_back({collapses_.size(), end_.liveFaces()});
            });
        if (end_.liveFaces() > faces) return end_;
        const auto hasMore = [&](const Stop& stop) { return stop.faces > faces; };
        const auto stop = std::partition_point(stops_.begin(), stops_.end(), hasMore);
        if (stop->collapses == collapses_.size()) return end_;
        GuardedMesh surface = start_;
        StarChange star;
        for (std::size_t i = 0; i < stop->collapses; ++i) {
            starOfCollapse(surface, collapses_[i].kept, collapses_[i].removed, star);
            surface.apply(star, collapses_[i].place);
        }
        return surface;
    }

private:
    struct Collapse {
        std::uint32_t kept, removed;
        Vec3d place;
    };
    struct Stop {
        std::size_t collapses, faces; // made so far, left
    };

    const GuardedMesh start_;
    GuardedMesh end_;
    QuadricCollapser collapser_; // of end_
    std::vector<Collapse> collapses_;
    std::vector<Stop> stops_; // the start and the end of each batch
};

CollapseSequence::CollapseSequence(GuardedMesh start) : recorder_(std::make_unique<Recorder>(std::move(start)))
{
}
CollapseSequence::~CollapseSequence() = default;
CollapseSequence::CollapseSequence(CollapseSequence&&) noexcept = default;
CollapseSequence& CollapseSequence::operator=(CollapseSequence&&) noexcept = default;

GuardedMesh CollapseSequence::at(std::size_t faces, Interrupter* interrupter)
{
    return recorder_->at(faces, interrupter);
}

} // namespace vdbcage::detail
