#include <vdbcage/check/detail/enclosure.h>

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <limits>
#include <vector>

#include <tbb/blocked_range.h>
#include <vdbcage/check/detail/predicates.h>
#include <vdbcage/core/detail/parallel.h>

namespace vdbcage::detail {

namespace {

using Range = tbb::blocked_range<std::size_t>;

bool liesOnCage(const CageFaces& cage, const Vec3d& p)
{
    return !cage.tree.inBox(Box::of(p),
                            [&](const BoxTree::Item& item) { return !contains(cage.corners(item.triangle), p); });
}

// Returns whether p is inside. `crossed` gets the quads between whose diagonals p is. \pre p does not lie on the cage
//
// The winding number counts one diagonal of every quad. Another choice of diagonals changes it exactly if p lies in the
// tetrahedron of such a quad, so p must be in none. The ray crosses the tetrahedron's four triangles once if p is in
// it, twice or never if not.
bool liesInside(const CageFaces& cage, const Vec3d& p, std::vector<std::uint32_t>& crossed)
{
    int winding = 0;
    crossed.clear();
    const Box ray{p, {std::numeric_limits<double>::infinity(), p[1], p[2]}};
    cage.tree.inBox(ray, [&](const BoxTree::Item& item) {
        const int crossing = rayCrossing(cage.corners(item.triangle), p);
        if (crossing == 0) return true;
        if (cage.faces.ofFirstDiagonal(item.triangle)) winding += crossing;
        if (cage.faces.ofQuad(item.triangle)) crossed.push_back(cage.faces.face(item.triangle));
        return true;
    });
    std::sort(crossed.begin(), crossed.end());
    auto between = crossed.begin();
    for (auto face = crossed.begin(); face != crossed.end();) {
        const auto next = std::upper_bound(face, crossed.end(), *face);
        const std::uint32_t quad = *face;
        if ((next - face) % 2 == 1) *between++ = quad;
        face = next;
    }
    crossed.erase(between, crossed.end());
    return winding == 1 && crossed.empty();
}

} // namespace

std::size_t countContacts(CageFaces& cage, const CheckedModel::View& view, Flags& touched, Interrupter* interrupter)
{
    const CheckedModel& model = view.model;
    std::atomic<std::size_t> result{0};
    parallelFor(Range(0, cage.faces.faces(), 1), [&](const Range& range) {
        for (std::size_t face = range.begin(); face < range.end(); ++face) {
            throwIfInterrupted(interrupter);
            bool contact = false;
            for (std::size_t t = cage.faces.first(face); t < cage.faces.first(face + 1); ++t) {
                const Corners corners = cage.corners(t);
                const Box box = Box::of(corners);
                model.candidates.near(corners, view.maxDistance(), [&](const BoxTree::Item& item) {
                    std::atomic<bool>& part = touched[model.partOfPoint[item.corners[0]]];
                    if (contact && isSet(part)) return true; // nothing left to learn from this pair
                    const Corners other = view.corners(item);
                    if (!box.meets(Box::of(other)) || !trianglesMeet(corners, other)) return true;
                    contact = true;
                    set(part);
                    return true;
                });
            }
            if (!contact) continue;
            ++result;
            set(cage.bad[face]);
        }
    });
    return result;
}

std::size_t countOutside(CageFaces& cage, const CheckedModel::View& view, const Flags& touched,
                         Interrupter* interrupter)
{
    // A part is connected: its triangles share vertices. If it does not meet the cage (under either diagonal of any
    // quad), no path within it crosses the cage or the tetrahedron of a quad. All its vertices are then on the same
    // side of everything, and one stands for all.
    const CheckedModel& model = view.model;
    struct Question {
        std::uint32_t vertex;
        std::size_t weight;
        bool onCage; // may lie on it
    };
    std::vector<Question> questions;
    for (std::size_t part = 0; part < model.parts(); ++part) {
        const std::size_t begin = model.partFirst[part], end = model.partFirst[part + 1];
        if (!isSet(touched[part])) {
            questions.push_back({model.partVertices[begin], end - begin, false});
            continue;
        }
        for (std::size_t i = begin; i < end; ++i) questions.push_back({model.partVertices[i], 1, true});
    }
    std::atomic<std::size_t> result{0};
    parallelFor(Range(0, questions.size(), 64), [&](const Range& range) {
        std::vector<std::uint32_t> crossed;
        std::size_t outside = 0;
        for (std::size_t i = range.begin(); i < range.end(); ++i) {
            throwIfInterrupted(interrupter);
            const Question& question = questions[i];
            const Vec3d p = view.point(question.vertex);
            if (question.onCage && liesOnCage(cage, p)) {
                outside += question.weight;
                continue;
            }
            if (!liesInside(cage, p, crossed)) outside += question.weight;
            for (const std::uint32_t quad : crossed) set(cage.bad[quad]);
        }
        result += outside;
    });
    return result;
}

std::size_t countLooseOutside(const CageFaces& cage, const CheckedModel::View& view, Interrupter* interrupter)
{
    const std::vector<std::uint32_t>& points = view.model.loosePoints;
    std::atomic<std::size_t> result{0};
    parallelFor(Range(0, points.size(), 64), [&](const Range& range) {
        std::vector<std::uint32_t> crossed;
        std::size_t outside = 0;
        for (std::size_t i = range.begin(); i < range.end(); ++i) {
            throwIfInterrupted(interrupter);
            const Vec3d p = view.point(points[i]);
            if (!p.isFinite() || liesOnCage(cage, p) || !liesInside(cage, p, crossed)) ++outside;
        }
        result += outside;
    });
    return result;
}

} // namespace vdbcage::detail
