// Based on: Akenine-Moller, Fast 3D Triangle-Box Overlap Testing, 2001; Schwarz and Seidel, Fast Parallel Surface and
// Solid Voxelization on GPUs, 2010.
// Differs: all tests are on integers and exact; each of the 13 separating axes bounds z in a column of voxels, so the
// touched voxels are one run of bits, found without visiting the voxels.
//
// A triangle and a cube meet unless one of 13 axes separates them: the cube's three, the triangle's normal, and the
// nine products of an edge and an axis of the cube. The nine are the edges of the triangle's projections along x, y
// and z, as half planes.
//
// Sizes. Coordinates and their differences are below 2^26 + 2^15 (resolution 4096), twice the area of a projection
// is at most 2^52, and so the value of a half plane is below 2^54: int64 does. The value of the plane is below
// 3 * 2^40 * (2^20 + 2^14) < 2^62 if no side of the triangle's box is longer than 2^20 (64 voxels), else below 2^80.
#include <vdbcage/voxelize/detail/face_scan.h>

#include <algorithm>
#include <cstdlib>

#include <vdbcage/voxelize/detail/frame.h>

namespace vdbcage::detail {

namespace {

using openvdb::Vec3i;
__extension__ using Int128 = __int128;

Span intersection(const Span& a, const Span& b)
{
    return {std::max(a.first, b.first), std::min(a.last, b.last)};
}

/// The bound to which quotients are clamped; no voxel has such an index.
constexpr int largestQuotient = 1 << 20;

/// Returns floor(value / divisor), clamped to +-largestQuotient; divisor > 0, and `inverse` is 1.0 / divisor.
///
/// value * inverse is rounded four times, so it is off by less than 2^-51 of itself, 2^-31 at most. Only where it is
/// nearer than 2^-30 to an integer is the division done on integers.
template <typename Integer>
int floorQuotient(Integer value, Integer divisor, double inverse)
{
    const double quotient = static_cast<double>(value) * inverse;
    if (quotient >= largestQuotient) return largestQuotient;
    if (quotient <= -largestQuotient) return -largestQuotient;
    const int truncated = static_cast<int>(quotient);
    const int floor = quotient < truncated ? truncated - 1 : truncated;
    const double fraction = quotient - floor;
    constexpr double margin = 0x1p-30;
    if (fraction > margin && fraction < 1 - margin) return floor;
    const Integer exact = value / divisor;
    return static_cast<int>(value % divisor < 0 ? exact - 1 : exact);
}

/// The half plane atOrigin + perFirst * u + perSecond * v >= 0, for voxel indices (u, v) of a projection.
struct HalfPlane {
    std::int64_t perFirst, perSecond;
    std::int64_t touched; ///< `atOrigin` for the voxel's square to touch the half plane
    std::int64_t centred; ///< `atOrigin` for the voxel's centre to lie in it
    double inverse;       ///< 1 / |perSecond| unless that is 0

    /// Removes from `span` the v that are not in the half plane; `value` is its left side at v = 0.
    void clip(Span& span, std::int64_t value) const
    {
        if (perSecond > 0) {
            span.first = std::max(span.first, -floorQuotient(value, perSecond, inverse));
        } else if (perSecond < 0) {
            span.last = std::min(span.last, floorQuotient(value, -perSecond, inverse));
        } else if (value < 0) {
            span = {};
        }
    }
};

/// The projection of a triangle on two axes, the first before the second in the order x, y, z.
class Projection {
public:
    /// Sets the projection. `area` is twice its signed area.
    void assign(const LatticeTriangle& triangle, int first, int second, std::int64_t area)
    {
        count_ = 0;
        for (int i = 0; i < 3; ++i) {
            const Vec3i &p = triangle.corners[i], &q = triangle.corners[(i + 1) % 3];
            const std::int64_t alongFirst = q[first] - p[first], alongSecond = q[second] - p[second];
            if (alongFirst == 0 && alongSecond == 0) continue;
            const std::int64_t sign = area < 0 ? -1 : 1;
            add(sign * alongFirst, sign * alongSecond, p[first], p[second]);
            if (area != 0) continue;
            add(-alongFirst, -alongSecond, p[first], p[second]);
            break; // a line: the other edges lie on it
        }
    }
    /// Returns the v of `within` where the square of voxel (u, v) touches the projection or, where the projection has
    /// no area, its line.
    Span touched(int u, Span within) const
    {
        for (int i = 0; i < count_; ++i) lines_[i].clip(within, lines_[i].touched + u * lines_[i].perFirst);
        return within;
    }
    /// Returns the v of `within` where the centre of voxel (u, v) lies in the projection, which must have an area. A
    /// centre on an edge counts as if it were moved by (e, e^2) for an infinitely small e > 0: of two triangles that
    /// share the edge and lie on its two sides, exactly one has it.
    Span centred(int u, Span within) const
    {
        for (int i = 0; i < count_; ++i) lines_[i].clip(within, lines_[i].centred + u * lines_[i].perFirst);
        return within;
    }

private:
    /// Adds the half plane to the left of the direction (du, dv) through (u, v).
    void add(std::int64_t du, std::int64_t dv, std::int64_t u, std::int64_t v)
    {
        HalfPlane& line = lines_[count_++];
        line.perFirst = -dv * latticeStep;
        line.perSecond = du * latticeStep;
        const std::int64_t atOrigin = dv * u - du * v;
        line.touched = atOrigin + latticeBound * (std::abs(du) + std::abs(dv));
        const bool keepsTies = dv < 0 || (dv == 0 && du > 0);
        line.centred = keepsTies ? atOrigin : atOrigin - 1;
        if (du != 0) line.inverse = 1 / static_cast<double>(std::abs(line.perSecond));
    }

    HalfPlane lines_[3];
    int count_ = 0;
};

/// A triangle in its box of voxels, positions and indices counted from the lowest of these.
struct Face {
    LatticeTriangle triangle;
    Vec3i lowest;           ///< index of the lowest voxel of the box
    Vec3i size;             ///< voxels of the box along x, y, z
    std::int64_t normal[3]; ///< twice the signed area of the projections along x, y, z; the last is not negative
    bool hasCentres[3];     ///< whether a plane of voxel centres cuts the triangle's own box, by axis

    explicit Face(const LatticeTriangle& absolute) : triangle(absolute)
    {
        Vec3i(&p)[3] = triangle.corners;
        for (int axis = 0; axis < 3; ++axis) {
            const int low = std::min({p[0][axis], p[1][axis], p[2][axis]});
            const int high = std::max({p[0][axis], p[1][axis], p[2][axis]});
            lowest[axis] = (low - latticeBound + latticeStep - 1) >> latticeBits;
            size[axis] = ((high + latticeBound) >> latticeBits) - lowest[axis] + 1;
            hasCentres[axis] = (low + latticeStep - 1) >> latticeBits <= high >> latticeBits;
            for (Vec3i& corner : triangle.corners) corner[axis] -= lowest[axis] * latticeStep;
        }
        for (int axis = 0; axis < 3; ++axis) {
            const int u = (axis + 1) % 3, v = (axis + 2) % 3;
            normal[axis] = std::int64_t(p[1][u] - p[0][u]) * (p[2][v] - p[0][v]) -
                           std::int64_t(p[1][v] - p[0][v]) * (p[2][u] - p[0][u]);
        }
        if (normal[2] < 0) {
            std::swap(p[1], p[2]);
            for (std::int64_t& component : normal) component = -component;
        }
    }

    void project(int axis, Projection& projection) const
    {
        // Along y the order (x, z) of the axes reverses the sense of rotation.
        projection.assign(triangle, axis == 0 ? 1 : 0, axis == 2 ? 1 : 2, axis == 1 ? -normal[axis] : normal[axis]);
    }
    /// Returns whether a ray through voxel centres along `axis` can cross it.
    bool canCross(int axis) const
    {
        return normal[axis] != 0 && hasCentres[(axis + 1) % 3] && hasCentres[(axis + 2) % 3];
    }
    /// Returns whether the edges of the projection along `axis` affect the touched voxels. Where the triangle is within
    /// one voxel along some axis, the projection along that axis decides alone; where it is so along two, its box does.
    bool edgesMatter(int axis) const { return size[(axis + 1) % 3] > 1 && size[(axis + 2) % 3] > 1; }
    bool anyEdgesMatter() const { return edgesMatter(0) || edgesMatter(1) || edgesMatter(2); }
    bool planeMatters() const { return size[0] > 1 && size[1] > 1 && size[2] > 1; }
    /// Returns half the distance between two crossings' planes.
    template <typename Wide>
    Wide halfCell(int axis) const
    {
        return Wide(std::abs(normal[axis])) * (latticeStep / 2);
    }
};

/// The linear function normal . (centre of voxel - corner), for the voxels of a face's box.
template <typename Wide>
class Plane {
public:
    explicit Plane(const Face& face)
    {
        for (int axis = 0; axis < 3; ++axis) {
            perVoxel_[axis] = Wide(face.normal[axis]) * latticeStep;
            atOrigin_ -= Wide(face.normal[axis]) * face.triangle.corners[0][axis];
        }
        if (perVoxel_[2] > 0) inverse_ = 1 / static_cast<double>(perVoxel_[2]);
    }
    /// Returns the value at voxel (x, y, 0).
    Wide value(int x, int y) const { return atOrigin_ + x * perVoxel_[0] + y * perVoxel_[1]; }
    /// Returns the z where a plane of value a at z = 0 is at least `lower` and one of value b at most `upper`.
    Span between(Wide lower, Wide a, Wide upper, Wide b) const
    {
        if (perVoxel_[2] == 0) return a >= lower && b <= upper ? Span{-largestQuotient, largestQuotient} : Span{};
        return {-floorQuotient(a - lower, perVoxel_[2], inverse_), floorQuotient(upper - b, perVoxel_[2], inverse_)};
    }
    Span between(Wide lower, Wide upper, Wide value) const { return between(lower, value, upper, value); }

private:
    Wide perVoxel_[3], atOrigin_ = 0;
    double inverse_ = 0;
};

/// Calls write(word, mask) for the words of a row with the bits of `span`.
template <typename Write>
void forEachWord(std::uint64_t* row, const Span& span, const Write& write)
{
    std::uint64_t *word = row + (span.first >> 6), *const end = row + (span.last >> 6);
    std::uint64_t mask = ~std::uint64_t(0) << (span.first & 63);
    for (; word != end; ++word, mask = ~std::uint64_t(0)) write(*word, mask);
    write(*word, mask & ~std::uint64_t(0) >> (63 - (span.last & 63)));
}

void setBits(std::uint64_t* row, const Span& span)
{
    forEachWord(row, span, [](std::uint64_t& word, std::uint64_t mask) { word |= mask; });
}

void flipBits(std::uint64_t* row, const Span& span)
{
    forEachWord(row, span, [](std::uint64_t& word, std::uint64_t mask) { word ^= mask; });
}

/// Returns the planes of the face's box that lie in the slab.
Span planesIn(const Face& face, const Span& planes)
{
    return intersection({0, face.size[0] - 1}, {planes.first - face.lowest[0], planes.last - face.lowest[0]});
}

std::size_t rowInSlab(const Face& face, const Slab& slab, int x, int y)
{
    return static_cast<std::size_t>(x + face.lowest[0] - slab.planes.first) *
               static_cast<std::size_t>(slab.rowsPerPlane) +
           static_cast<std::size_t>(y + face.lowest[1]);
}

/// Sets the whole box of the face.
void setBox(const Face& face, const Slab& slab)
{
    const Span xs = planesIn(face, slab.planes);
    for (int x = xs.first; x <= xs.last; ++x) {
        for (int y = 0; y < face.size[1]; ++y) {
            setBits(slab.surface + rowInSlab(face, slab, x, y) * static_cast<std::size_t>(slab.wordsPerRow),
                    {face.lowest[2], face.lowest[2] + face.size[2] - 1});
        }
    }
}

template <typename Wide>
std::size_t scan(const Face& face, bool counted, const Slab& slab, ScanBuffer& buffer)
{
    const Span xs = planesIn(face, slab.planes);
    if (xs.empty()) return 0;
    const Span ys{0, face.size[1] - 1}, zs{0, face.size[2] - 1};

    Projection projections[3];
    bool crosses[3];
    for (int axis = 0; axis < 3; ++axis) {
        crosses[axis] = counted && face.canCross(axis);
        if (crosses[axis] || face.edgesMatter(axis)) face.project(axis, projections[axis]);
    }
    const bool planeMatters = face.planeMatters();
    const Plane<Wide> plane(face);
    Wide touchLimit = 0, cell[3];
    for (int axis = 0; axis < 3; ++axis) {
        touchLimit += Wide(std::abs(face.normal[axis])) * latticeBound;
        cell[axis] = face.halfCell<Wide>(axis);
    }

    // The bounds of z from the projection along x depend only on y.
    buffer.resize(2 * static_cast<std::size_t>(face.size[1]));
    Span *const touchedByY = buffer.data(), *const centredByY = touchedByY + face.size[1];
    for (int y = 0; y <= ys.last; ++y) {
        touchedByY[y] = face.edgesMatter(0) ? projections[0].touched(y, zs) : zs;
        centredByY[y] = crosses[0] ? projections[0].centred(y, zs) : Span{};
    }

    std::size_t columns = 0;
    for (int x = xs.first; x <= xs.last; ++x) {
        const Span touchedY = face.edgesMatter(2) ? projections[2].touched(x, ys) : ys;
        const Span touchedZ = face.edgesMatter(1) ? projections[1].touched(x, zs) : zs;
        const Span centredY = crosses[2] ? projections[2].centred(x, ys) : Span{};
        const Span centredZ = crosses[1] ? projections[1].centred(x, zs) : Span{};
        columns += static_cast<std::size_t>(std::max(1, touchedY.last - touchedY.first));
        for (int y = touchedY.first; y <= touchedY.last; ++y) {
            const Wide value = plane.value(x, y);
            Span z = intersection(touchedZ, touchedByY[y]);
            if (planeMatters) z = intersection(z, plane.between(-touchLimit, touchLimit, value));
            if (z.empty()) continue;
            const std::size_t row = rowInSlab(face, slab, x, y);
            const std::size_t offset = row * static_cast<std::size_t>(slab.wordsPerRow);
            setBits(slab.surface + offset, {z.first + face.lowest[2], z.last + face.lowest[2]});

            // A voxel has a crossing if the plane's value at its centre is within half a cell of zero.
            const auto flip = [&](int axis, const Span& centred) {
                const Span at = intersection(centred, plane.between(-cell[axis], cell[axis] - 1, value));
                if (at.empty()) return;
                flipBits(slab.crossings[axis] + offset, {at.first + face.lowest[2], at.last + face.lowest[2]});
                slab.crossed[row] = static_cast<std::uint8_t>(slab.crossed[row] | 1 << axis);
            };
            if (!centredByY[y].empty()) flip(0, centredByY[y]);
            if (!centredZ.empty()) flip(1, centredZ);
            if (centredY.contains(y)) flip(2, zs);
        }
    }
    return columns;
}

template <typename Wide>
void scanAlongX(const Face& face, const Span& planes, std::uint64_t* bits, int wordsPerRow)
{
    const Span xs = planesIn(face, planes);
    if (xs.empty()) return;
    Projection projection;
    face.project(0, projection);
    const Plane<Wide> plane(face);
    const Wide cell = face.halfCell<Wide>(0);
    // The plane's value grows with x if the normal does; a crossing is in the planes if it is not before the first and
    // not beyond the last.
    const bool grows = face.normal[0] > 0;
    for (int y = 0; y < face.size[1]; ++y) {
        const Span centred = projection.centred(y, {0, face.size[2] - 1});
        if (centred.empty()) continue;
        const Span at = intersection(centred, plane.between(-cell, plane.value(grows ? xs.last : xs.first, y), cell - 1,
                                                            plane.value(grows ? xs.first : xs.last, y)));
        if (at.empty()) continue;
        flipBits(bits + static_cast<std::ptrdiff_t>(y + face.lowest[1]) * wordsPerRow,
                 {at.first + face.lowest[2], at.last + face.lowest[2]});
    }
}

/// Returns whether the plane's value fits int64: a box of 63 voxels is at most 64 wide.
bool isSmall(const Face& face)
{
    return face.size[0] < 64 && face.size[1] < 64 && face.size[2] < 64;
}

} // namespace

std::size_t scanSurface(const LatticeTriangle& triangle, bool counted, const Slab& slab, ScanBuffer& buffer)
{
    const Face face(triangle);
    if (!face.anyEdgesMatter() && !(counted && (face.canCross(0) || face.canCross(1) || face.canCross(2)))) {
        setBox(face, slab);
        return 1;
    }
    return isSmall(face) ? scan<std::int64_t>(face, counted, slab, buffer) : scan<Int128>(face, counted, slab, buffer);
}

void scanCrossingsAlongX(const LatticeTriangle& triangle, const Span& planes, std::uint64_t* plane, int wordsPerRow)
{
    const Face face(triangle);
    if (!face.canCross(0)) return;
    isSmall(face) ? scanAlongX<std::int64_t>(face, planes, plane, wordsPerRow)
                  : scanAlongX<Int128>(face, planes, plane, wordsPerRow);
}

} // namespace vdbcage::detail
