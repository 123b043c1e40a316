// Based on: the normal of Newell (Sutherland, Sproull, Schumacker 1974) and the clipping of ears (Meisters 1975).
// Differs: a fan is tried first; corners that could lie in an ear are sorted into a grid, so that few are looked at.

#include <vdbcage/mesh/detail/polygon_splitter.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace vdbcage::detail {

namespace {

/// The corners relative to the first one, scaled by a power of two to lie in [-1, 1]: nothing overflows or underflows
/// below, whatever the units, and the differences of corners are rounded once at most.
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
    // Beyond this many corners trying each as the apex would cost more than clipping ears does.
    constexpr std::size_t fewCorners = 64;
    const std::size_t apexes = count <= fewCorners ? count : 1;
    for (std::size_t apex = 0; apex < apexes; ++apex) {
        if (isFanApex(apex)) {
            fan(face, apex, triangles);
            return;
        }
    }
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

/// Drops the coordinate in which the normal is longest: the face keeps its shape up to a linear map, and each
/// coordinate that is left keeps its exact value.
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
        loop_[i] = {local_[i][u], local_[i][v], (i + count - 1) % count, (i + 1) % count, 0, false, false};
    }
}

/// Twice the signed area of a triangle of projected corners.
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

/// All that is not clipped yet, as a fan.
void PolygonSplitter::fan(const openvdb::Index32* face, std::size_t apex, std::vector<openvdb::Vec3I>& triangles) const
{
    std::size_t corner = loop_[apex].next;
    for (std::size_t next = loop_[corner].next; next != apex; corner = next, next = loop_[next].next) {
        triangles.emplace_back(face[apex], face[corner], face[next]);
    }
}

bool PolygonSplitter::isEar(std::size_t corner) const
{
    const std::size_t before = loop_[corner].previous;
    const std::size_t after = loop_[corner].next;
    if (!loop_[corner].pointed) return false;
    const Corner& a = loop_[before];
    const Corner& b = loop_[corner];
    const Corner& c = loop_[after];
    const auto samePlace = [](const Corner& p, const Corner& q) { return p.x == q.x && p.y == q.y; };
    const auto blocks = [&](std::size_t i) {
        const Corner& p = loop_[i];
        if (p.clipped || p.pointed) return false;
        // Corners in the same place are the two sides of a cut that joins a hole to the outline.
        if (samePlace(p, a) || samePlace(p, b) || samePlace(p, c)) return false;
        return area(before, corner, i) >= 0 && area(corner, after, i) >= 0 && area(after, before, i) >= 0;
    };
    const std::size_t lastX = cellIndex(std::max({a.x, b.x, c.x}) - cellX_);
    const std::size_t lastY = cellIndex(std::max({a.y, b.y, c.y}) - cellY_);
    const std::size_t firstY = cellIndex(std::min({a.y, b.y, c.y}) - cellY_);
    for (std::size_t x = cellIndex(std::min({a.x, b.x, c.x}) - cellX_); x <= lastX; ++x) {
        // The cells of one x lie one behind another.
        const std::size_t end = cellBegin_[x * side_ + lastY + 1];
        for (std::size_t i = cellBegin_[x * side_ + firstY]; i < end; ++i) {
            if (blocks(obstacles_[i])) return false;
        }
    }
    return true;
}

/// Grows with the distance, so that a corner within an ear's box is in one of the box's cells, however it is rounded.
std::size_t PolygonSplitter::cellIndex(double distance) const
{
    return std::min(static_cast<std::size_t>(std::max(distance * cellsPerUnit_, 0.0)), side_ - 1);
}

/// Into about as many cells as there are obstacles, by counting.
void PolygonSplitter::sortObstacles()
{
    std::size_t count = 0;
    double right = loop_[0].x, top = loop_[0].y;
    cellX_ = right;
    cellY_ = top;
    for (const Corner& p : loop_) {
        if (!p.pointed) ++count;
        cellX_ = std::min(cellX_, p.x);
        cellY_ = std::min(cellY_, p.y);
        right = std::max(right, p.x);
        top = std::max(top, p.y);
    }
    side_ = static_cast<std::size_t>(std::sqrt(double(count))) + 1;
    const double extent = std::max(right - cellX_, top - cellY_);
    cellsPerUnit_ = extent > 0 ? double(side_) / extent : 0; // corners lie in [-1, 1]; see scaleToUnit
    const auto cellOf = [&](const Corner& p) { return cellIndex(p.x - cellX_) * side_ + cellIndex(p.y - cellY_); };
    cellBegin_.assign(side_ * side_ + 1, 0);
    for (const Corner& p : loop_) {
        if (!p.pointed) ++cellBegin_[cellOf(p) + 1];
    }
    std::partial_sum(cellBegin_.begin(), cellBegin_.end(), cellBegin_.begin());
    obstacles_.resize(count);
    std::vector<std::size_t> next(cellBegin_.begin(), cellBegin_.end() - 1);
    for (std::size_t i = 0; i < loop_.size(); ++i) {
        if (!loop_[i].pointed) obstacles_[next[cellOf(loop_[i])]++] = i;
    }
}

void PolygonSplitter::clip(std::size_t corner, const openvdb::Index32* face, std::vector<openvdb::Vec3I>& triangles)
{
    const std::size_t before = loop_[corner].previous;
    const std::size_t after = loop_[corner].next;
    triangles.emplace_back(face[before], face[corner], face[after]);
    loop_[corner].clipped = true;
    loop_[before].next = after;
    loop_[after].previous = before;
    for (const std::size_t i : {before, after}) {
        loop_[i].pointed = area(loop_[i].previous, i, loop_[i].next) > 0;
        // Their turn comes in the next round, also if it were due in this one: clipping every second corner of a chain
        // makes fewer slivers than clipping one after another.
        if (loop_[i].round > round_) continue;
        loop_[i].round = round_ + 1;
        nextCandidates_.push_back(i);
    }
}

/// In rounds over the corners whose neighbours changed in the last one; when they are used up, over all.
void PolygonSplitter::clipEars(const openvdb::Index32* face, std::vector<openvdb::Vec3I>& triangles)
{
    const std::size_t count = loop_.size();
    for (std::size_t i = 0; i < count; ++i) loop_[i].pointed = area(loop_[i].previous, i, loop_[i].next) > 0;
    sortObstacles();

    std::size_t left = count;
    std::size_t start = 0; // a corner that is left
    bool all = false;
    round_ = 0;
    nextCandidates_.clear();
    while (left > 3) {
        const bool none = nextCandidates_.empty();
        if (none && all) {
            // No ear is left. A corner without area may go, as it changes nothing of the outline.
            std::size_t flat = start;
            do flat = loop_[flat].next;
            while (flat != start && area(loop_[flat].previous, flat, loop_[flat].next) != 0);
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
            if (--left == 3) break;
        }
    }
    // The last triangle; or, where no corner is an ear, a face that crosses itself and has no right division.
    fan(face, start, triangles);
}

void addAlternatives(const openvdb::Index32* face, std::size_t count, std::vector<openvdb::Vec3I>& triangles)
{
    constexpr std::size_t mostForTriples = 8, mostForFans = 64;
    if (count <= mostForTriples) {
        for (std::size_t i = 0; i < count; ++i) {
            for (std::size_t j = i + 1; j < count; ++j) {
                for (std::size_t k = j + 1; k < count; ++k) triangles.emplace_back(face[i], face[j], face[k]);
            }
        }
    } else if (count <= mostForFans) {
        for (std::size_t apex = 0; apex < count; ++apex) {
            for (std::size_t i = 1; i + 1 < count; ++i) {
                triangles.emplace_back(face[apex], face[(apex + i) % count], face[(apex + i + 1) % count]);
            }
        }
    }
}

} // namespace vdbcage::detail
