// Based on: the normal of Newell (Sutherland, Sproull, Schumacker 1974) and the clipping of ears (Meisters 1975).
// Differs: a fan is tried first; corners that could lie in an ear are in a tree, so that few are examined; the work is
// bounded.

#include <vdbcage/mesh/io/polygon_splitter.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

namespace vdbcage::detail {

namespace {

/// Moves and scales the corners relative to the first one, by a power of two, to lie in [-1, 1]: nothing overflows or
/// underflows below, for any units, and the differences of corners are rounded at most once.
void scaleToUnit(const std::vector<openvdb::Vec3d>& points, const openvdb::Index32* face, std::size_t count,
                 std::vector<openvdb::Vec3d>& local)
{
    local.resize(count);
    double largest = 0;
    const openvdb::Vec3d origin = points[face[0]] * 0.5;
    for (std::size_t i = 0; i < count; ++i) {
        local[i] = points[face[i]] * 0.5 - origin; // halves: the difference of two doubles may be infinite
        largest = std::max({largest, std::abs(local[i].x()), std::abs(local[i].y()), std::abs(local[i].z())});
    }
    int exponent = 0;
    std::frexp(largest, &exponent);
    const double scale = std::ldexp(1.0, std::min(-exponent, 1023));
    for (openvdb::Vec3d& p : local) p *= scale;
}

constexpr std::size_t obstaclesPerLeaf = 8;
constexpr std::size_t noNode = ~std::size_t(0);

// Triangles of fans are as long as the face. Those of more corners overlap in every tree, which takes minutes for a
// million: larger faces are split into triangles of all sizes. A cylinder's cap has fewer corners.
constexpr std::size_t mostCornersOfFan = 4096;

// The bound of the work for ears, in nodes and corners examined in the tree. A test for an ear counts as
// `workOfAsking`: faces that do not cross themselves test up to 3 times a corner and examine 30 to 130 (a million
// random spikes: 1000), so a search beyond 32 and 2048 is futile. A million corners take 0.4 to 7 s. Faces of up to a
// thousand are never cut short.
constexpr std::size_t workOfAsking = 64, workPerCorner = 2048, leastWork = std::size_t(1) << 25U;

openvdb::Vec3d newellNormal(const std::vector<openvdb::Vec3d>& loop)
{
    openvdb::Vec3d normal(0, 0, 0);
    for (std::size_t i = 0; i < loop.size(); ++i) normal += loop[i].cross(loop[i + 1 == loop.size() ? 0 : i + 1]);
    return normal;
}

} // namespace

void PolygonSplitter::split(const openvdb::Index32* face, std::size_t count, std::vector<openvdb::Vec3I>& triangles,
                            std::vector<openvdb::Vec4I>& quads)
{
    scaleToUnit(points_, face, count, local_);
    if (count == 4) {
        splitQuad(face, triangles, quads);
        return;
    }
    project();
    // Beyond this many corners, trying each as the apex would cost more than ear clipping.
    constexpr std::size_t fewCorners = 64;
    const std::size_t apexes = count <= fewCorners ? count : count <= mostCornersOfFan ? 1 : 0;
    for (std::size_t apex = 0; apex < apexes; ++apex) {
        if (isFanApex(apex)) {
            fan(face, apex, triangles);
            return;
        }
    }
    clipEars(face, triangles);
}

void PolygonSplitter::splitByEars(const openvdb::Index32* face, std::size_t count,
                                  std::vector<openvdb::Vec3I>& triangles)
{
    scaleToUnit(points_, face, count, local_);
    project();
    clipEars(face, triangles);
}

void PolygonSplitter::splitQuad(const openvdb::Index32* face, std::vector<openvdb::Vec3I>& triangles,
                                std::vector<openvdb::Vec4I>& quads)
{
    const openvdb::Vec3d normal = (local_[2] - local_[0]).cross(local_[3] - local_[1]);
    // A triangle below this share of the face counts as no better than a degenerate one.
    const double least = 1e-10 * normal.dot(normal);
    const auto keepsOrientation = [&](std::size_t tip) { // the triangle that the diagonal cuts off at corner `tip`
        const openvdb::Vec3d& p = local_[tip];
        const openvdb::Vec3d in = p - local_[(tip + 3) % 4];
        const openvdb::Vec3d out = local_[(tip + 1) % 4] - p;
        return normal.dot(in.cross(out)) > least;
    };
    const bool by02 = keepsOrientation(1) && keepsOrientation(3);
    const bool by13 = keepsOrientation(0) && keepsOrientation(2);
    if (by02 == by13) {
        quads.emplace_back(face[0], face[1], face[2], face[3]);
    } else if (by02) {
        triangles.emplace_back(face[0], face[1], face[2]);
        triangles.emplace_back(face[0], face[2], face[3]);
    } else {
        triangles.emplace_back(face[1], face[2], face[3]);
        triangles.emplace_back(face[1], face[3], face[0]);
    }
}

/// Drops the coordinate in which the normal is longest: the face keeps its shape up to a linear map, and the other
/// coordinates keep their exact values.
void PolygonSplitter::project()
{
    const openvdb::Vec3d normal = newellNormal(local_);
    int dropped = 2;
    for (int axis = 0; axis < 2; ++axis) {
        if (std::abs(normal[axis]) > std::abs(normal[dropped])) dropped = axis;
    }
    int u = (dropped + 1) % 3;
    int v = (dropped + 2) % 3;
    if (normal[dropped] < 0) std::swap(u, v);
    const std::size_t count = local_.size();
    loop_.resize(count);
    for (std::size_t i = 0; i < count; ++i) {
        loop_[i] = {local_[i][u], local_[i][v], (i + count - 1) % count, (i + 1) % count, 0, noNode, false, false};
    }
}

/// Returns twice the signed area of a triangle of projected corners.
double PolygonSplitter::area(std::size_t a, std::size_t b, std::size_t c) const
{
    const Corner& p = loop_[a];
    const Corner& q = loop_[b];
    const Corner& r = loop_[c];
    return (q.x - p.x) * (r.y - p.y) - (q.y - p.y) * (r.x - p.x);
}

bool PolygonSplitter::isFanApex(std::size_t apex) const
{
    std::size_t corner = loop_[apex].next;
    for (std::size_t next = loop_[corner].next; next != apex; corner = next, next = loop_[next].next) {
        if (area(apex, corner, next) <= 0) return false;
    }
    return true;
}

/// Splits all that is not clipped yet as a fan.
void PolygonSplitter::fan(const openvdb::Index32* face, std::size_t apex, std::vector<openvdb::Vec3I>& triangles) const
{
    std::size_t corner = loop_[apex].next;
    for (std::size_t next = loop_[corner].next; next != apex; corner = next, next = loop_[next].next) {
        triangles.emplace_back(face[apex], face[corner], face[next]);
    }
}

/// Splits the `left` corners that are not clipped yet: cuts off every second one, again and again.
void PolygonSplitter::fold(const openvdb::Index32* face, std::size_t corner, std::size_t left,
                           std::vector<openvdb::Vec3I>& triangles)
{
    for (; left > 3; --left) {
        const std::size_t middle = loop_[corner].next, after = loop_[middle].next;
        triangles.emplace_back(face[corner], face[middle], face[after]);
        loop_[corner].next = after;
        corner = after;
    }
    fan(face, corner, triangles);
}

bool PolygonSplitter::isEar(std::size_t corner)
{
    work_ += workOfAsking;
    if (!loop_[corner].pointed) return false;
    if (obstacles_.empty()) return true;
    const Corner &a = loop_[loop_[corner].previous], &b = loop_[corner], &c = loop_[loop_[corner].next];
    const Box box{std::min({a.x, b.x, c.x}), std::max({a.x, b.x, c.x}), std::min({a.y, b.y, c.y}),
                  std::max({a.y, b.y, c.y})};
    return !isBlocked(corner, box, 0, 0, obstacles_.size());
}

/// Returns whether one of a node's obstacles lies in the triangle of `corner` and its neighbours, whose box is `box`.
bool PolygonSplitter::isBlocked(std::size_t corner, const Box& box, std::size_t node, std::size_t begin,
                                std::size_t end)
{
    ++work_;
    if (nodes_[node].left == 0 || !mayOverlap(corner, box, nodes_[node].box)) return false;
    if (end - begin > obstaclesPerLeaf) {
        const std::size_t middle = begin + (end - begin) / 2;
        return isBlocked(corner, box, 2 * node + 1, begin, middle) || isBlocked(corner, box, 2 * node + 2, middle, end);
    }
    const std::size_t before = loop_[corner].previous, after = loop_[corner].next;
    const auto samePlace = [](const Corner& p, const Corner& q) { return p.x == q.x && p.y == q.y; };
    const auto blocks = [&](std::size_t i) {
        ++work_;
        const Corner& p = loop_[i];
        if (p.clipped || p.pointed) return false;
        // Corners in the same place are the two sides of a cut that joins a hole to the outline.
        if (samePlace(p, loop_[before]) || samePlace(p, loop_[corner]) || samePlace(p, loop_[after])) return false;
        return area(before, corner, i) >= 0 && area(corner, after, i) >= 0 && area(after, before, i) >= 0;
    };
    return std::any_of(obstacles_.begin() + static_cast<std::ptrdiff_t>(begin),
                       obstacles_.begin() + static_cast<std::ptrdiff_t>(end), blocks);
}

/// Returns whether the triangle may overlap a box; never false if it does: coordinates are up to 1 (see scaleToUnit),
/// areas of the corners of `other` are rounded by less than 1e-14.
bool PolygonSplitter::mayOverlap(std::size_t corner, const Box& box, const Box& other) const
{
    if (other.left > box.right || other.right < box.left || other.bottom > box.top || other.top < box.bottom) {
        return false;
    }
    const auto isBehind = [&](const Corner& p, const Corner& q) {
        const double x = q.x - p.x, y = q.y - p.y;
        return x * ((x > 0 ? other.top : other.bottom) - p.y) - y * ((y > 0 ? other.left : other.right) - p.x) < -1e-14;
    };
    const Corner &a = loop_[loop_[corner].previous], &b = loop_[corner], &c = loop_[loop_[corner].next];
    return !isBehind(a, b) && !isBehind(b, c) && !isBehind(c, a);
}

/// Halves the range across the longer side of its box until few are left.
void PolygonSplitter::growTree(std::size_t node, std::size_t begin, std::size_t end)
{
    if (nodes_.size() <= node) nodes_.resize(node + 1);
    const auto range = [&](std::size_t i) { return obstacles_.begin() + static_cast<std::ptrdiff_t>(i); };
    const auto [left, right] = std::minmax_element(
        range(begin), range(end), [&](std::size_t i, std::size_t k) { return loop_[i].x < loop_[k].x; });
    const auto [bottom, top] = std::minmax_element(
        range(begin), range(end), [&](std::size_t i, std::size_t k) { return loop_[i].y < loop_[k].y; });
    const Box box{loop_[*left].x, loop_[*right].x, loop_[*bottom].y, loop_[*top].y};
    nodes_[node] = {box, end - begin};
    if (end - begin <= obstaclesPerLeaf) {
        for (std::size_t i = begin; i < end; ++i) loop_[obstacles_[i]].node = node;
        return;
    }
    const std::size_t middle = begin + (end - begin) / 2;
    const bool isWide = box.right - box.left > box.top - box.bottom;
    std::nth_element(range(begin), range(middle), range(end), [&](std::size_t i, std::size_t k) {
        return isWide ? loop_[i].x < loop_[k].x : loop_[i].y < loop_[k].y;
    });
    growTree(2 * node + 1, begin, middle);
    growTree(2 * node + 2, middle, end);
}

/// Removes an obstacle. \param corner was clipped
void PolygonSplitter::dropObstacle(std::size_t corner)
{
    if (loop_[corner].node == noNode) return;
    for (std::size_t node = loop_[corner].node;; node = (node - 1) / 2) {
        --nodes_[node].left;
        if (node == 0) return;
    }
}

void PolygonSplitter::clip(std::size_t corner, const openvdb::Index32* face, std::vector<openvdb::Vec3I>& triangles)
{
    const std::size_t before = loop_[corner].previous;
    const std::size_t after = loop_[corner].next;
    triangles.emplace_back(face[before], face[corner], face[after]);
    loop_[corner].clipped = true;
    dropObstacle(corner);
    loop_[before].next = after;
    loop_[after].previous = before;
    for (const std::size_t i : {before, after}) {
        loop_[i].pointed = area(loop_[i].previous, i, loop_[i].next) > 0;
        // Their turn comes in the next round, even if it were due in this one: clipping every second corner of a chain
        // makes fewer slivers than clipping one after another.
        if (loop_[i].round > round_) continue;
        loop_[i].round = round_ + 1;
        nextCandidates_.push_back(i);
    }
}

/// Clips in rounds over the corners whose neighbours changed in the last one; when none is left, over all.
void PolygonSplitter::clipEars(const openvdb::Index32* face, std::vector<openvdb::Vec3I>& triangles)
{
    const std::size_t count = loop_.size();
    for (std::size_t i = 0; i < count; ++i) loop_[i].pointed = area(loop_[i].previous, i, loop_[i].next) > 0;
    obstacles_.clear();
    for (std::size_t i = 0; i < count; ++i) {
        if (!loop_[i].pointed) obstacles_.push_back(i);
    }
    nodes_.clear();
    if (!obstacles_.empty()) growTree(0, 0, obstacles_.size());
    work_ = 0;
    const std::size_t mostWork = std::max(leastWork, workPerCorner * count);

    std::size_t left = count;
    std::size_t start = 0; // a corner that is left
    bool all = false;
    round_ = 0;
    nextCandidates_.clear();
    while (left > 3 && work_ < mostWork) {
        const bool none = nextCandidates_.empty();
        if (none && all) {
            // No ear is left. A corner without area may be clipped, since the outline stays the same.
            std::size_t flat = start;
            do {
                flat = loop_[flat].next;
                work_ += workOfAsking;
            } while (flat != start && area(loop_[flat].previous, flat, loop_[flat].next) != 0);
            if (area(loop_[flat].previous, flat, loop_[flat].next) != 0) break;
            start = loop_[flat].next;
            clip(flat, face, triangles);
            --left;
            all = false;
            continue;
        }
        all = none;
        ++round_;
        candidates_.swap(nextCandidates_);
        nextCandidates_.clear();
        if (all) {
            candidates_.clear();
            std::size_t corner = start;
            do {
                loop_[corner].round = round_;
                candidates_.push_back(corner);
                corner = loop_[corner].next;
            } while (corner != start);
        }
        for (const std::size_t corner : candidates_) {
            if (loop_[corner].clipped || loop_[corner].round != round_ || !isEar(corner)) continue;
            start = loop_[corner].next;
            clip(corner, face, triangles);
            if (--left == 3 || work_ >= mostWork) break;
        }
    }
    allWork_ += work_;
    // The last triangle; or, where no corner is an ear, a face that crosses itself and has no right division.
    if (left <= mostCornersOfFan) {
        fan(face, start, triangles);
    } else {
        fold(face, start, left, triangles);
    }
}

namespace {

constexpr std::size_t mostForTriples = 8;

} // namespace

std::size_t alternativesOf(std::size_t count)
{
    if (count <= mostForTriples) return count * (count - 1) * (count - 2) / 6;
    return count <= mostCornersWithAlternates ? count * (count - 2) : 0;
}

void addFirstFan(const openvdb::Index32* face, std::size_t count, std::vector<openvdb::Vec3I>& triangles)
{
    for (std::size_t i = 2; i < count; ++i) triangles.emplace_back(face[0], face[i - 1], face[i]);
}

void addAlternatives(const openvdb::Index32* face, std::size_t count, std::vector<openvdb::Vec3I>& triangles)
{
    if (count <= mostForTriples) {
        for (std::size_t i = 0; i < count; ++i) {
            for (std::size_t j = i + 1; j < count; ++j) {
                for (std::size_t k = j + 1; k < count; ++k) triangles.emplace_back(face[i], face[j], face[k]);
            }
        }
    } else if (count <= mostCornersWithAlternates) {
        for (std::size_t apex = 0; apex < count; ++apex) {
            for (std::size_t i = 1; i + 1 < count; ++i) {
                triangles.emplace_back(face[apex], face[(apex + i) % count], face[(apex + i + 1) % count]);
            }
        }
    }
}

} // namespace vdbcage::detail
