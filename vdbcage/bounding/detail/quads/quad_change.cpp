// Based on: Tarini, Pietroni, Cignoni, Panozzo, Puppo, "Practical Quad Mesh Simplification", 2010 (rotations of edges,
//           diagonal collapses); Bozzo, Panozzo, Puppo, Pietroni, Rocca, "Adaptive Quad Mesh Simplification", 2010
//           (vertex splits).
// Differs: triangles among the quads; every change is one star of triangles, for a guard.

#include <vdbcage/bounding/detail/quads/quad_change.h>

#include <algorithm>
#include <limits>
#include <tuple>
#include <utility>
#include <vector>

#include <vdbcage/bounding/detail/guard/face_queries.h>

namespace vdbcage::detail {

namespace {

using Ring = std::vector<std::uint32_t>;

/// Returns the corners of the quad or triangle with a side from a to b, from a on; empty beyond the plane of symmetry.
Ring polygonAt(const GuardedMesh& surface, const QuadTable& table, std::uint32_t a, std::uint32_t b)
{
    const std::uint32_t q = table.quadAt(a, b);
    if (q != QuadTable::none) {
        const Vec4I& ids = table.corners(q);
        const int i = table.sideOf(q, a, b);
        return {ids[i], ids[(i + 1) % 4], ids[(i + 2) % 4], ids[(i + 3) % 4]};
    }
    const std::uint32_t f = faceAt(surface, a, b);
    if (f == GuardedMesh::none) return {};
    return {a, b, cornerOpposite(surface, f, a, b)};
}

bool hasDiagonalAt(const GuardedMesh& surface, const Vec4I& ids, int i)
{
    const std::uint32_t a = ids[i], b = ids[(i + 1) % 4];
    return cornerOpposite(surface, faceAt(surface, a, b), a, b) == ids[(i + 2) % 4];
}

/// Returns the neighbours of v along edges of polygons, each with the polygon after it around v, all around v or from
/// plane to plane.
std::vector<Ring> polygonsAround(const GuardedMesh& surface, const QuadTable& table, std::uint32_t v)
{
    std::vector<Ring> polygons;
    std::uint32_t first = GuardedMesh::none;
    if (table.quadsOf(v).empty()) {
        const Vec3I& t = surface.face(surface.facesOf(v)[0]);
        first = t[0] == v ? t[1] : t[1] == v ? t[2] : t[0];
    } else {
        const Vec4I& ids = table.corners(table.quadsOf(v)[0]);
        int i = 0;
        while (ids[i] != v) ++i;
        first = ids[(i + 1) % 4];
    }
    for (std::uint32_t next = first;;) {
        Ring polygon = polygonAt(surface, table, v, next);
        if (polygon.empty()) return polygons; // the plane
        next = polygon.back();
        polygons.push_back(std::move(polygon));
        if (next == first) return polygons;
    }
}

/// The valences of all vertices, and the gain of changing them.
class Valences {
public:
    Valences(const GuardedMesh& surface, const QuadTable& table) : surface_(surface), of_(surface.vertices(), 0)
    {
        for (std::uint32_t v = 0; v < surface.vertices(); ++v) {
            if (surface.isVertex(v)) of_[v] = static_cast<int>(polygonValence(surface, table, v));
        }
    }

    int operator[](std::uint32_t v) const { return of_[v]; }
    /// Returns the gain of `edges` more edges off the plane, or polygons on it, at v.
    double gain(std::uint32_t v, int edges) const
    {
        return gainTo(v, of_[v] + (surface_.isOnPlane(v) ? 2 : 1) * edges);
    }
    double gainTo(std::uint32_t v, int valence) const { return weigh(v, of_[v]) - weigh(v, valence); }
    /// Returns the irregularity of a valence at a vertex like v: half where v is on the plane.
    double weigh(std::uint32_t v, int valence) const
    {
        return (surface_.isOnPlane(v) ? 0.5 : 1) * irregularity(static_cast<std::size_t>(std::max(valence, 0)));
    }

private:
    const GuardedMesh& surface_;
    std::vector<int> of_;
};

/// Returns the outline of the two polygons at an edge: b, ..., a, ...; empty if there are not two, or they meet
/// elsewhere.
Ring ringAround(const GuardedMesh& surface, const QuadTable& table, std::uint32_t a, std::uint32_t b)
{
    const Ring p = polygonAt(surface, table, a, b), q = polygonAt(surface, table, b, a);
    if (p.empty() || q.empty()) return {};
    Ring ring(p.begin() + 1, p.end());
    ring.push_back(a);
    ring.insert(ring.end(), q.begin() + 2, q.end());
    Ring sorted = ring;
    std::sort(sorted.begin(), sorted.end());
    if (std::adjacent_find(sorted.begin(), sorted.end()) != sorted.end()) return {};
    return ring;
}

class Finder {
public:
    Finder(const GuardedMesh& surface, const QuadTable& table, double least)
        : surface_(surface), table_(table), valences_(surface, table), least_(least)
    {
    }

    std::vector<QuadChange> find()
    {
        for (std::uint32_t v = 0; v < surface_.vertices(); ++v) {
            if (!surface_.isVertex(v)) continue;
            const std::vector<Ring> polygons = polygonsAround(surface_, table_, v);
            for (const Ring& polygon : polygons) {
                if (v < polygon[1]) rotations(v, polygon[1]);
            }
            if (!surface_.isOnPlane(v)) splits(v, polygons);
        }
        for (std::uint32_t q = 0; q < table_.quads(); ++q) {
            if (!table_.isQuad(q)) continue;
            for (const int i : {0, 1}) collapse(table_.corners(q), i);
        }
        std::sort(found_.begin(), found_.end(), [](const QuadChange& a, const QuadChange& b) {
            return std::tie(b.gain, a.kind, a.vertices) < std::tie(a.gain, b.kind, b.vertices);
        });
        return std::move(found_);
    }

private:
    void add(QuadChange::Kind kind, const std::array<std::uint32_t, 4>& vertices, double gain)
    {
        if (gain > least_) found_.push_back({kind, vertices, gain});
    }

    void rotations(std::uint32_t a, std::uint32_t b)
    {
        const Ring ring = ringAround(surface_, table_, a, b);
        const std::size_t n = ring.size();
        if (n == 4) add(QuadChange::Kind::merge, {a, b, 0, 0}, valences_.gain(a, -1) + valences_.gain(b, -1));
        for (std::size_t i = 0; n > 4 && i < n; ++i) {
            for (std::size_t j = i + 2; j < std::min(n, n + i - 1); ++j) {
                if (n == 6 && j != i + 3) continue;
                const std::uint32_t c = ring[i], d = ring[j];
                if ((c == a || c == b) && (d == a || d == b)) continue;
                double gain = 0;
                for (const std::uint32_t v : {a, b}) gain += v == c || v == d ? 0 : valences_.gain(v, -1);
                for (const std::uint32_t v : {c, d}) gain += v == a || v == b ? 0 : valences_.gain(v, 1);
                add(QuadChange::Kind::rotation, {a, b, c, d}, gain);
            }
        }
    }

    void collapse(const Vec4I& ids, int i)
    {
        std::uint32_t kept = ids[i], removed = ids[i + 2];
        if (surface_.isOnPlane(removed)) std::swap(kept, removed);
        if (surface_.isOnPlane(removed)) return;
        const int sides = surface_.isOnPlane(kept) ? 2 : 1;
        const int both = valences_[kept] / sides + valences_[removed] - 2;
        const double gain = valences_.gainTo(kept, sides * both) + valences_.weigh(removed, valences_[removed]) +
                            valences_.gain(ids[i + 1], -1) + valences_.gain(ids[(i + 3) % 4], -1);
        add(QuadChange::Kind::collapse, {kept, removed, 0, 0}, gain);
    }

    void splits(std::uint32_t v, const std::vector<Ring>& polygons)
    {
        const std::size_t n = polygons.size();
        if (n < 5) return;
        for (std::size_t i = 0; i < n; ++i) {
            for (std::size_t k = 2; k <= n - 2; ++k) {
                const std::uint32_t x = polygons[i][1], y = polygons[(i + k) % n][1];
                const double gain = valences_.gainTo(v, static_cast<int>(n - k + 1)) - irregularity(k + 1) +
                                    valences_.gain(x, 1) + valences_.gain(y, 1);
                add(QuadChange::Kind::split, {v, x, y, 0}, gain);
            }
        }
    }

    const GuardedMesh& surface_;
    const QuadTable& table_;
    const Valences valences_;
    const double least_;
    std::vector<QuadChange> found_;
};

void addFaces(const GuardedMesh& surface, std::uint32_t v, StarChange::Faces& faces)
{
    for (const std::uint32_t f : surface.facesOf(v)) {
        if (std::find(faces.begin(), faces.end(), f) == faces.end()) faces.push_back(f);
    }
}

std::optional<PlannedChange> plannedRotation(const GuardedMesh& surface, const QuadTable& table,
                                             const std::array<std::uint32_t, 4>& vertices)
{
    const auto [a, b, c, d] = vertices;
    const Ring ring = ringAround(surface, table, a, b);
    const auto at = [&](std::uint32_t v) {
        return static_cast<std::size_t>(std::find(ring.begin(), ring.end(), v) - ring.begin());
    };
    const std::size_t n = ring.size(), from = at(c), to = at(d);
    if (n < 5 || from == n || to == n) return std::nullopt;
    const std::size_t first = (to + n - from) % n, second = n - first; // sides of the ring on either side
    if (first < 2 || second < 2 || (n == 6 && first != 3)) return std::nullopt;
    PlannedChange plan;
    StarChange::Faces faces;
    addFaces(surface, c, faces);
    std::vector<std::uint32_t> old;
    for (const auto& [s, t] : {std::pair(a, b), std::pair(b, a)}) {
        const std::uint32_t q = table.quadAt(s, t);
        const auto add = [&](std::uint32_t f) {
            if (std::find(faces.begin(), faces.end(), f) == faces.end()) faces.push_back(f);
        };
        add(faceAt(surface, s, t));
        if (q == QuadTable::none) continue;
        old.push_back(q);
        const Vec4I& ids = table.corners(q);
        add(faceAt(surface, ids[0], ids[1]));
        add(faceAt(surface, ids[2], ids[3]));
    }
    if (!starOfPatch(surface, c, StarChange::none, faces, plan.star)) return std::nullopt;
    for (const auto& [start, sides] : {std::pair(from, first), std::pair(to, second)}) {
        if (sides != 3) continue;
        const Vec4I quad(ring[start], ring[(start + 1) % n], ring[(start + 2) % n], ring[(start + 3) % n]);
        plan.replaced.emplace_back(old.back(), quad);
        old.pop_back();
    }
    plan.vertices.assign(ring.begin(), ring.end());
    plan.place = surface.point(c);
    return plan;
}

std::optional<PlannedChange> plannedMerge(const GuardedMesh& surface, const QuadTable& table, std::uint32_t a,
                                          std::uint32_t b)
{
    const Ring ring = ringAround(surface, table, a, b);
    if (ring.size() != 4) return std::nullopt;
    const auto& quads = table.quadsOf(a);
    const bool isDiagonal = std::any_of(quads.begin(), quads.end(), [&](std::uint32_t q) {
        const Vec4I& ids = table.corners(q);
        return ids[0] == b || ids[1] == b || ids[2] == b || ids[3] == b;
    });
    if (isDiagonal) return std::nullopt; // they are a quad
    PlannedChange plan;
    plan.star = starOf(surface, a);
    plan.place = surface.point(a);
    plan.vertices.assign(ring.begin(), ring.end());
    plan.replaced.emplace_back(QuadTable::none, Vec4I(ring[0], ring[1], ring[2], ring[3]));
    return plan;
}

std::optional<PlannedChange> plannedCollapse(const GuardedMesh& surface, const QuadTable& table, std::uint32_t kept,
                                             std::uint32_t removed)
{
    PlannedChange plan;
    for (const std::uint32_t q : table.quadsOf(removed)) {
        const Vec4I& ids = table.corners(q);
        for (int i = 0; i < 4; ++i) {
            if (ids[i] == kept) plan.removed.push_back(q);
        }
    }
    if (plan.removed.size() != 1) return std::nullopt;
    const Vec4I& ids = table.corners(plan.removed[0]);
    if (!(ids[0] == kept && ids[2] == removed) && !(ids[2] == kept && ids[0] == removed) &&
        !(ids[1] == kept && ids[3] == removed) && !(ids[3] == kept && ids[1] == removed)) {
        return std::nullopt;
    }
    StarChange::Faces faces;
    addFaces(surface, kept, faces);
    addFaces(surface, removed, faces);
    if (!starOfPatch(surface, kept, removed, faces, plan.star)) return std::nullopt;
    for (const std::uint32_t q : table.quadsOf(removed)) {
        if (q == plan.removed[0]) continue;
        Vec4I corners = table.corners(q);
        for (int i = 0; i < 4; ++i) {
            if (corners[i] == removed) corners[i] = kept;
        }
        plan.replaced.emplace_back(q, corners);
    }
    for (const std::uint32_t q : table.quadsOf(removed)) {
        for (int i = 0; i < 4; ++i) plan.vertices.push_back(table.corners(q)[i]);
    }
    std::sort(plan.vertices.begin(), plan.vertices.end());
    plan.vertices.erase(std::unique(plan.vertices.begin(), plan.vertices.end()), plan.vertices.end());
    const bool isOnPlane = surface.isOnPlane(kept);
    plan.place = isOnPlane ? surface.point(kept) : 0.5 * (surface.point(kept) + surface.point(removed));
    return plan;
}

std::optional<PlannedChange> plannedSplit(const GuardedMesh& surface, const QuadTable& table, std::uint32_t v,
                                          std::uint32_t x, std::uint32_t y)
{
    constexpr double share = 0.4; // of the way from the old vertex to the middle of the new one's polygons
    if (!surface.isVertex(v) || surface.isOnPlane(v)) return std::nullopt;
    const std::vector<Ring> polygons = polygonsAround(surface, table, v);
    const auto at = [&](std::uint32_t w) {
        return static_cast<std::size_t>(
            std::find_if(polygons.begin(), polygons.end(), [&](const Ring& p) { return p[1] == w; }) -
            polygons.begin());
    };
    const std::size_t n = polygons.size(), from = at(x), to = at(y);
    if (from == n || to == n) return std::nullopt;
    const std::size_t count = (to + n - from) % n;
    if (count < 2 || count + 2 > n) return std::nullopt;
    PlannedChange plan;
    StarChange::Faces faces;
    const std::uint32_t made = surface.vertices();
    Vec3d middle(0.0);
    std::size_t corners = 0;
    plan.vertices = {v};
    for (std::size_t k = 0; k < count; ++k) {
        const Ring& polygon = polygons[(from + k) % n];
        for (std::size_t i = 1; i < polygon.size(); ++i) {
            middle += surface.point(polygon[i]);
            plan.vertices.push_back(polygon[i]);
            ++corners;
        }
        faces.push_back(faceAt(surface, v, polygon[1]));
        if (polygon.size() == 3) continue;
        const std::uint32_t q = table.quadAt(v, polygon[1]);
        if (hasDiagonalAt(surface, table.corners(q), table.sideOf(q, v, polygon[1])))
            faces.push_back(faceAt(surface, polygon[3], v));
        plan.replaced.emplace_back(q, Vec4I(made, polygon[1], polygon[2], polygon[3]));
    }
    plan.replaced.emplace_back(QuadTable::none, Vec4I(v, x, made, y));
    if (!starOfFaces(surface, faces, false, plan.star)) return std::nullopt;
    const Vec3d& p = surface.point(v);
    plan.place = p + share * (middle / static_cast<double>(corners) - p);
    std::sort(plan.vertices.begin(), plan.vertices.end());
    plan.vertices.erase(std::unique(plan.vertices.begin(), plan.vertices.end()), plan.vertices.end());
    return plan;
}

} // namespace

double irregularity(std::size_t valence)
{
    constexpr double six = 2.2; // more than two vertices of five
    if (valence < 3) return std::numeric_limits<double>::infinity();
    if (valence == 6) return six;
    return valence == 3 ? 1 : valence < 6 ? static_cast<double>(valence - 4) : static_cast<double>(valence - 3);
}

std::size_t polygonValence(const GuardedMesh& surface, const QuadTable& table, std::uint32_t v)
{
    std::size_t polygons = surface.facesOf(v).size();
    for (const std::uint32_t q : table.quadsOf(v)) {
        const Vec4I& ids = table.corners(q);
        int i = 0;
        while (ids[i] != v) ++i;
        if (hasDiagonalAt(surface, ids, i)) --polygons;
    }
    return (surface.isOnPlane(v) ? 2 : 1) * polygons;
}

std::vector<QuadChange> quadChanges(const GuardedMesh& surface, const QuadTable& table, double least)
{
    return Finder(surface, table, least).find();
}

std::optional<PlannedChange> planned(const GuardedMesh& surface, const QuadTable& table, const QuadChange& change)
{
    const auto& vertices = change.vertices;
    if (change.kind == QuadChange::Kind::rotation) return plannedRotation(surface, table, vertices);
    if (change.kind == QuadChange::Kind::merge) return plannedMerge(surface, table, vertices[0], vertices[1]);
    if (change.kind == QuadChange::Kind::collapse) return plannedCollapse(surface, table, vertices[0], vertices[1]);
    return plannedSplit(surface, table, vertices[0], vertices[1], vertices[2]);
}

void apply(QuadTable& table, const PlannedChange& plan)
{
    for (const std::uint32_t q : plan.removed) table.remove(q);
    for (const auto& [q, corners] : plan.replaced) {
        if (q == QuadTable::none) {
            table.add(corners);
        } else {
            table.replace(q, corners);
        }
    }
}

} // namespace vdbcage::detail
