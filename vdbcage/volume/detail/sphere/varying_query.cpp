#include <vdbcage/volume/detail/sphere/varying_query.h>

#include <algorithm>
#include <limits>

#include <vdbcage/volume/detail/sphere/sphere_tables.h>

namespace vdbcage::detail {

namespace {

// Returns squared distances along one axis, from a voxel or an interval of them to each of the four entries of a part.
std::array<std::int32_t, 4> nearSquares(int lower, int upper)
{
    std::array<std::int32_t, 4> squares;
    for (int i = 0; i < 4; ++i) {
        const int distance = std::max({lower - (8 * i + 7), 8 * i - upper, 0});
        squares[static_cast<std::size_t>(i)] = distance * distance;
    }
    return squares;
}
std::array<std::int32_t, 4> farSquares(int position)
{
    std::array<std::int32_t, 4> squares;
    for (int i = 0; i < 4; ++i) {
        const int distance = std::max(8 * i + 7 - position, position - 8 * i);
        squares[static_cast<std::size_t>(i)] = distance * distance;
    }
    return squares;
}

using Squares = std::array<std::int32_t, 4>;

// Returns the entries where the squares along the axes add up to their limit or less.
std::uint64_t entriesWithin(const Squares& x, const Squares& y, const Squares& z,
                            const std::array<std::int32_t, 64>& limits)
{
    std::uint64_t mask = 0;
    for (std::size_t i = 0; i < 64; ++i) {
        mask |= std::uint64_t{x[i / 16] + y[i / 4 % 4] + z[i % 4] <= limits[i]} << i;
    }
    return mask;
}

// plane = min(plane, squared distance in the plane to (y, z), minus the square of that voxel's radius)
VDBCAGE_INLINE void lower(std::int32_t* plane, int siteY, int siteZ, std::int32_t square)
{
    std::int32_t alongZ[8];
    for (int z = 0; z < 8; ++z) alongZ[z] = (z - siteZ) * (z - siteZ) - square;
    for (int y = 0; y < 8; ++y) {
        const std::int32_t alongY = (y - siteY) * (y - siteY);
        for (int z = 0; z < 8; ++z) plane[8 * y + z] = std::min(plane[8 * y + z], alongY + alongZ[z]);
    }
}

// found |= plane + along <= limits
VDBCAGE_INLINE void compare(std::int32_t* found, const std::int32_t* plane, std::int32_t along,
                            const std::int32_t* limits)
{
    for (int i = 0; i < lanes; ++i) found[i] |= plane[i] + along <= limits[i] ? -1 : 0;
}

struct Leaf {
    int x, y, z; // of its first voxel, from the entry's first
    const VaryingQuery::Work::Site *first, *last;
};

// Adds a leaf. `most` is the largest limit.
VDBCAGE_INLINE void addLeaf(const Leaf& leaf, std::int32_t most, int span, VaryingQuery::Work& work)
{
    for (const auto* site = leaf.first; site != leaf.last; ++site) {
        const int x = leaf.x + site->x, y = leaf.y + site->y, z = leaf.z + site->z;
        const int gapX = gap(x, 0, 7), gapY = gap(y, 0, 7), gapZ = gap(z, 0, 7);
        if (gapX * gapX + gapY * gapY + gapZ * gapZ > most + site->square) continue;
        const auto index = static_cast<std::size_t>(x + span);
        std::int32_t* const plane = &work.planes[index * lanes];
        if (work.isUsed[index] == 0) {
            work.isUsed[index] = 1;
            work.used.push_back(x);
            std::fill_n(plane, lanes, std::numeric_limits<std::int32_t>::max() / 2);
        }
        lower(plane, y, z, site->square);
    }
}

VDBCAGE_INLINE void findWithin(const Words& open, const std::int32_t* limits, int span, VaryingQuery::Work& work,
                               Words& result)
{
    for (int x = 0; x < leafSize; ++x) {
        std::uint64_t bits = 0;
        if (open[static_cast<std::size_t>(x)] != 0) {
            std::int32_t found[lanes] = {};
            for (const int planeX : work.used) {
                compare(found, &work.planes[static_cast<std::size_t>(planeX + span) * lanes],
                        (x - planeX) * (x - planeX), limits + x * lanes);
            }
            for (int i = 0; i < lanes; ++i) bits |= std::uint64_t{found[i] != 0} << i;
        }
        result[static_cast<std::size_t>(x)] = bits & open[static_cast<std::size_t>(x)];
    }
}

// The same for each instruction set.
void addLeafPlain(const Leaf& leaf, std::int32_t most, int span, VaryingQuery::Work& work)
{
    addLeaf(leaf, most, span, work);
}
void findWithinPlain(const Words& open, const std::int32_t* limits, int span, VaryingQuery::Work& work, Words& result)
{
    findWithin(open, limits, span, work, result);
}
#if VDBCAGE_WITH_AVX
VDBCAGE_TARGET_AVX2 void addLeafAvx2(const Leaf& leaf, std::int32_t most, int span, VaryingQuery::Work& work)
{
    addLeaf(leaf, most, span, work);
}
VDBCAGE_TARGET_AVX2 void findWithinAvx2(const Words& open, const std::int32_t* limits, int span,
                                        VaryingQuery::Work& work, Words& result)
{
    findWithin(open, limits, span, work, result);
}
#endif

} // namespace

void VaryingQuery::startBlock(Work& work, std::size_t leaves) const
{
    work.starts.assign(leaves, 0);
    work.sites.resize(1);
}

void VaryingQuery::startPart(Work& work, const Coord& corner) const
{
    work.corner = corner;
    work.leastSquare.fill(0);
    work.mostSquare.fill(0);
    if (by_ == By::source) return;
    for (int i = 0; i < 64; ++i) {
        const auto range = field_.rangeOfEntry(corner.offsetBy(i / 16 * 8, i / 4 % 4 * 8, i % 4 * 8));
        const auto entry = static_cast<std::size_t>(i);
        work.leastSquare[entry] = field_.squareOf(static_cast<double>(range.least) * factor_);
        work.mostSquare[entry] = field_.squareOf(static_cast<double>(range.most) * factor_);
    }
}

std::uint64_t VaryingQuery::coveredEntries(const NearLeaf* near, std::size_t count, std::uint64_t wanted,
                                           const Work& work) const
{
    std::uint64_t covered = 0;
    for (std::size_t n = 0; n < count && (wanted & ~covered) != 0; ++n) {
        const NearLeaf& leaf = near[n];
        const Coord place(8 * leaf.x + leaf.sample[0], 8 * leaf.y + leaf.sample[1], 8 * leaf.z + leaf.sample[2]);
        auto limits = work.leastSquare;
        if (by_ == By::source) limits.fill(field_.square(work.corner + place, factor_));
        covered |= entriesWithin(farSquares(place.x()), farSquares(place.y()), farSquares(place.z()), limits);
    }
    return covered;
}

void VaryingQuery::nearEntries(NearLeaf* near, std::size_t count, const Work& work) const
{
    for (std::size_t n = 0; n < count; ++n) {
        NearLeaf& leaf = near[n];
        const int x = 8 * leaf.x, y = 8 * leaf.y, z = 8 * leaf.z;
        auto limits = work.mostSquare;
        if (by_ == By::source) {
            const auto most = field_.rangeOfEntry(work.corner.offsetBy(x, y, z)).most;
            limits.fill(field_.squareOf(static_cast<double>(most) * factor_));
        }
        leaf.entriesInRadius = entriesWithin(nearSquares(x + leaf.box.lower[0], x + leaf.box.upper[0]),
                                             nearSquares(y + leaf.box.lower[1], y + leaf.box.upper[1]),
                                             nearSquares(z + leaf.box.lower[2], z + leaf.box.upper[2]), limits);
    }
}

std::array<Words, 4> VaryingQuery::within(const SphereQuery::Pile& open, int pile, const NearLeaf* near,
                                          const SphereQuery::Leaves& leaves, Work& work) const
{
    std::array<Words, 4> result;
    for (std::size_t z = 0; z < open.size(); ++z) {
        if (open[z]) result[z] = withinEntry(*open[z], 4 * pile + static_cast<int>(z), near, leaves, work);
    }
    return result;
}

Words VaryingQuery::withinEntry(const Words& open, int entry, const NearLeaf* near, const SphereQuery::Leaves& leaves,
                                Work& work) const
{
    const Coord offset(entry / 16 * 8, entry / 4 % 4 * 8, entry % 4 * 8), origin = work.corner + offset;
    const int span = static_cast<int>(field_.largest()) + 16; // a leaf within the radius, and its far side
    const auto planes = static_cast<std::size_t>(2 * span + 1);
    work.planes.resize(planes * lanes);
    work.isUsed.resize(planes, 0);
    for (const int x : work.used) work.isUsed[static_cast<std::size_t>(x + span)] = 0;
    work.used.clear();
    for (std::size_t n = 0; n < leaves.ends.back(); ++n) {
        const NearLeaf& leaf = near[leaves.indices[n]];
        if ((leaf.entriesInRadius >> entry & 1) == 0) continue;
        const Coord place(8 * leaf.x, 8 * leaf.y, 8 * leaf.z);
        std::uint32_t& start = work.starts[leaf.id];
        if (start == 0) {
            start = static_cast<std::uint32_t>(work.sites.size());
            work.sites.push_back({});
            for (int x = 0; x < leafSize; ++x) {
                for (std::uint64_t word = (*leaf.words)[static_cast<std::size_t>(x)]; word != 0; word &= word - 1) {
                    const int bit = __builtin_ctzll(word);
                    const Coord voxel = work.corner + place + Coord(x, bit >> 3, bit & 7);
                    const std::int32_t square = by_ == By::source ? field_.square(voxel, factor_) : 0;
                    work.sites.push_back({x, bit >> 3, bit & 7, square});
                    ++work.sites[start].x;
                }
            }
        }
        const auto* const first = &work.sites[start];
        const Coord from = place - offset;
        const Leaf sites{from.x(), from.y(), from.z(), first + 1, first + 1 + first->x};
        const std::int32_t most = work.mostSquare[static_cast<std::size_t>(entry)];
#if VDBCAGE_WITH_AVX
        if (simd_ != Simd::plain) {
            addLeafAvx2(sites, most, span, work);
            continue;
        }
#endif
        addLeafPlain(sites, most, span, work);
    }
    std::array<std::int32_t, 512> limits{};
    if (by_ == By::target) {
        for (int x = 0; x < leafSize; ++x) {
            for (std::uint64_t word = open[static_cast<std::size_t>(x)]; word != 0; word &= word - 1) {
                const int bit = __builtin_ctzll(word);
                limits[static_cast<std::size_t>(x * lanes + bit)] =
                    field_.square(origin.offsetBy(x, bit >> 3, bit & 7), factor_);
            }
        }
    }
    Words result;
#if VDBCAGE_WITH_AVX
    if (simd_ != Simd::plain) {
        findWithinAvx2(open, limits.data(), span, work, result);
        return result;
    }
#endif
    findWithinPlain(open, limits.data(), span, work, result);
    return result;
}

} // namespace vdbcage::detail
