#include <vdbcage/volume/detail/sphere/sphere_query.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

#if defined(__x86_64__)
#include <emmintrin.h>
#endif

#include <vdbcage/core/detail/word_bits.h>
#include <vdbcage/volume/detail/sphere/sphere_tables.h>

namespace vdbcage::detail {

namespace {

using Tables = SphereTables;

// A vector of a native width.
template <class T, int bytes>
struct VectorOf {
    typedef T type __attribute__((vector_size(bytes)));
};

template <class T, int bytes>
struct Columns { // one T for each column of an entry
    using Vector = typename VectorOf<T, bytes>::type;
    static constexpr int count = lanes * static_cast<int>(sizeof(T)) / bytes;
    Vector v[count];

    VDBCAGE_INLINE void load(const T* from)
    {
        for (int i = 0; i < count; ++i) std::memcpy(&v[i], from + i * bytes / static_cast<int>(sizeof(T)), bytes);
    }
    VDBCAGE_INLINE void store(T* to) const
    {
        for (int i = 0; i < count; ++i) std::memcpy(to + i * bytes / static_cast<int>(sizeof(T)), &v[i], bytes);
    }
    VDBCAGE_INLINE void fill(T value)
    {
        for (int i = 0; i < count; ++i) v[i] = Vector{} + value;
    }
};

// Vectors are passed by reference: by value they would change the ABI.
template <class Vector>
VDBCAGE_INLINE void raiseTo(Vector& a, const Vector& b)
{
    a = a > b ? a : b;
}
template <class Vector>
VDBCAGE_INLINE void lowerTo(Vector& a, const Vector& b)
{
    a = a < b ? a : b;
}
template <class Vector>
VDBCAGE_INLINE bool isAny(const Vector& v)
{
    typedef std::uint64_t Pair __attribute__((vector_size(16)));
    Pair pairs[sizeof(Vector) / 16];
    std::memcpy(pairs, &v, sizeof v);
    for (std::size_t i = 1; i < sizeof(Vector) / 16; ++i) pairs[0] |= pairs[i];
    return (pairs[0][0] | pairs[0][1]) != 0;
}

// Finds the voxels of a leaf that no other one hides from an entry (all except a few that one further along x hides). A
// voxel is hidden if another voxel is ahead of it. Ahead is towards the entry along the axes where `side` is not 0, and
// the same place along the others.
template <int bytes>
VDBCAGE_INLINE void frontVoxels(const Words& words, int sideX, int sideY, int sideZ, std::uint64_t* front)
{
    typedef std::uint64_t Quads __attribute__((vector_size(bytes)));
    constexpr int count = 64 / bytes, perVector = bytes / 8;
    constexpr std::uint64_t firstZ = 0x0101010101010101ULL;
    // Shifts away from the entry; one of the two of an axis is 0.
    const int downZ = sideZ > 0, upZ = sideZ<0, downY = sideY> 0 ? 8 : 0, upY = sideY < 0 ? 8 : 0;
    const std::uint64_t maskY = sideY != 0 ? ~0ULL : 0, maskX = sideX != 0 ? ~0ULL : 0;
    const auto maskZ = [&](unsigned down, unsigned up) {
        return sideZ > 0 ? down * firstZ : sideZ < 0 ? up * firstZ : 0;
    };
    const std::uint64_t z1 = maskZ(0x7F, 0xFE), z2 = maskZ(0x3F, 0xFC), z4 = maskZ(0x0F, 0xF0);
    std::uint64_t cones[8 + 2]; // each voxel spread over itself and all voxels that it hides; without x
    cones[0] = cones[9] = 0;
    Quads own[count], hidden[count];
    for (int i = 0; i < count; ++i) {
        std::memcpy(&own[i], words.data() + i * perVector, bytes);
        Quads w = own[i];
        w |= (w >> downZ << upZ) & z1;
        w |= (w >> 2 * downZ << 2 * upZ) & z2;
        w |= (w >> 4 * downZ << 4 * upZ) & z4;
        w |= (w >> downY << upY) & maskY;
        w |= (w >> 2 * downY << 2 * upY) & maskY;
        w |= (w >> 4 * downY << 4 * upY) & maskY;
        hidden[i] = ((w >> downZ << upZ) & z1) | ((w >> downY << upY) & maskY);
        std::memcpy(cones + 1 + i * perVector, &w, bytes);
    }
    for (int i = 0; i < count; ++i) {
        Quads ahead;
        std::memcpy(&ahead, cones + 1 + sideX + i * perVector, bytes);
        ahead = own[i] & ~(hidden[i] | (ahead & maskX));
        std::memcpy(front + i * perVector, &ahead, bytes);
    }
}

// Adds the front to `fronts` and returns its place.
template <int bytes>
VDBCAGE_INLINE std::uint32_t findFront(int stride, const Words& words, int sideX, int sideY, int sideZ,
                                       SphereQuery::Work& fronts)
{
    std::uint64_t front[8];
    frontVoxels<bytes>(words, sideX, sideY, sideZ, front);
    const std::size_t start = fronts.size;
    if (fronts.voxels.size() < start + 1 + lanes) fronts.voxels.resize(2 * start + 1 + lanes);
    auto* const first = &fronts.voxels[start];
    auto* next = first;
    for (int x = 0; x < 8; ++x) {
        for (std::uint64_t word = front[x]; word != 0;) {
            const int bit = __builtin_ctzll(word), y = bit >> 3;
            if (sideZ == 0) {
                *++next = {-x * stride - 8 * y, static_cast<std::int32_t>(word >> (8 * y) & 0xFF)};
                word &= ~(0xFFULL << (8 * y));
            } else { // a column's front is one voxel
                *++next = {-x * stride - 8 * y, bit & 7};
                word &= word - 1;
            }
        }
    }
    first->place = static_cast<std::int32_t>(next - first);
    fronts.size += static_cast<std::size_t>(next - first) + 1;
    return static_cast<std::uint32_t>(start);
}

VDBCAGE_INLINE int sideOf(int offset)
{
    return (offset > 0) - (offset < 0);
}

using Fronts = SphereQuery::Work;

struct PileQuery {
    const SphereQuery::Pile& open;
    int x, y;                 // of the pile, in entries
    int entryPlace, rowPlace; // of it in the tables, from the part's first
    const NearLeaf* near;
    const SphereQuery::Leaves& leaves;
    Fronts& fronts;
};

template <class T, int bytes>
class Kernel {
public:
    static VDBCAGE_INLINE void within(const Tables& tables, const PileQuery& query, Words* result)
    {
        C open[levels]; // the voxels still open
        for (std::size_t z = 0; z < levels; ++z) {
            query.open[z] ? load(*query.open[z], open[z]) : open[z].fill(0);
        }
        if (vertical(tables, query, 1, open) && vertical(tables, query, -1, open)) {
            for (std::size_t z = 0; z < levels; ++z) {
                if (query.open[z]) lateral(tables, query, z, open[z]);
            }
        }
        for (std::size_t z = 0; z < levels; ++z) {
            if (!query.open[z]) continue;
            store(open[z], result[z]);
            for (std::size_t x = 0; x < 8; ++x) result[z][x] ^= (*query.open[z])[x];
        }
    }

private:
    using C = Columns<T, bytes>;
    using Vector = typename C::Vector;
    static constexpr std::size_t levels = 4; // of a pile

    // Convert from and to one number for each column; bit z of it is voxel z.
    static VDBCAGE_INLINE void load(const Words& words, C& columns)
    {
        Words byColumn = words;
        transposeBytes(byColumn); // now word y, byte x, bit z
        T numbers[lanes];
        for (std::size_t i = 0; i < lanes; ++i) numbers[i] = reinterpret_cast<const std::uint8_t*>(byColumn.data())[i];
        columns.load(numbers);
    }
    static VDBCAGE_INLINE void store(const C& columns, Words& words)
    {
        T numbers[lanes];
        columns.store(numbers);
        for (std::size_t i = 0; i < lanes; ++i)
            reinterpret_cast<std::uint8_t*>(words.data())[i] = static_cast<std::uint8_t>(numbers[i]);
        transposeBytes(words);
    }
    static VDBCAGE_INLINE void load(Vector& v, const T* row, int i)
    {
        std::memcpy(&v, row + i * bytes / static_cast<int>(sizeof(T)), bytes);
    }
    static VDBCAGE_INLINE bool isAny(const C& columns)
    {
        Vector all = columns.v[0];
        for (int i = 1; i < C::count; ++i) all |= columns.v[i];
        return detail::isAny<Vector>(all);
    }

    // Returns the front of a leaf towards the pile.
    static VDBCAGE_INLINE const Fronts::Voxel* frontOf(const Tables& tables, const PileQuery& query, std::size_t leaf,
                                                       int sideZ)
    {
        const NearLeaf& near = query.near[leaf];
        const int sideX = sideOf(query.x - near.x), sideY = sideOf(query.y - near.y);
        std::uint32_t& start =
            query.fronts
                .starts[std::size_t{near.id} * 27 + static_cast<std::size_t>(9 * sideX + 3 * sideY + sideZ + 13)];
        if (start == 0) start = findFront<bytes>(tables.rowStride(), *near.words, sideX, sideY, sideZ, query.fronts);
        return &query.fronts.voxels[start];
    }

    // Returns a leaf near an entry, by their entries: the nearest of a few. After it others have less to add.
    static VDBCAGE_INLINE std::size_t nearest(const PileQuery& query, int z, std::size_t begin, std::size_t end)
    {
        constexpr std::size_t few = 8;
        int least = std::numeric_limits<int>::max();
        std::size_t found = begin;
        const std::size_t stride = (end - begin) / few + 1;
        for (std::size_t n = begin; n < end; n += stride) {
            const NearLeaf& near = query.near[query.leaves.indices[n]];
            const int dx = query.x - near.x, dy = query.y - near.y, dz = z - near.z,
                      distance = dx * dx + dy * dy + dz * dz;
            found = distance < least ? n : found;
            least = std::min(least, distance);
        }
        return found;
    }

    // By column, the heights up to the first open voxel and up to the last one, of an entry and all entries behind it.
    struct Heights {
        C first, last;
    };
    static constexpr T never = static_cast<T>(std::numeric_limits<T>::max() - 8 * static_cast<int>(levels));
    // Computes them from those of the entry behind.
    static VDBCAGE_INLINE void stepBack(Heights& heights)
    {
        for (int i = 0; i < C::count; ++i) {
            heights.first.v[i] += static_cast<T>(leafSize);
            heights.last.v[i] += reinterpret_cast<Vector>(heights.last.v[i] > none<T>) & static_cast<T>(leafSize);
        }
    }
    static VDBCAGE_INLINE void include(const C& open, int side, Heights& heights)
    {
        for (int i = 0; i < C::count; ++i) {
            for (int k = 7; k >= 0; --k) {
                const T bit = static_cast<T>(side > 0 ? 1 << k : 128 >> k), before = static_cast<T>(none<T> + k),
                        after = static_cast<T>(before + 1);
                const Vector isOpen = reinterpret_cast<Vector>((open.v[i] & bit) != 0);
                heights.first.v[i] = (isOpen & before) | (~isOpen & heights.first.v[i]);
                raiseTo<Vector>(heights.last.v[i], isOpen & after);
            }
        }
    }

    // Covers voxels entry by entry from the leaves below (side 1) or above (-1). Returns whether any voxels are left
    // open.
    static VDBCAGE_INLINE bool vertical(const Tables& tables, const PileQuery& query, int side, C* open)
    {
        const auto levelAt = [&](std::size_t step) { return side > 0 ? step : levels - 1 - step; };
        Heights heights[levels];                      // by step
        std::size_t firstStep = levels, lastStep = 0; // with open voxels
        for (std::size_t step = levels; step-- > 0;) {
            const C& here = open[levelAt(step)];
            const bool isOpen = isAny(here);
            if (firstStep < levels) {
                heights[step] = heights[step + 1];
                stepBack(heights[step]);
            } else if (isOpen) {
                heights[step].first.fill(never);
                heights[step].last.fill(none<T>);
                lastStep = step;
            }
            if (!isOpen) continue;
            include(here, side, heights[step]);
            firstStep = step;
        }
        if (firstStep == levels) return false;
        C top = heights[firstStep].first;
        const auto& ends = query.leaves.ends;
        for (std::size_t step = firstStep; step <= lastStep; ++step) {
            const std::size_t level = levelAt(step);
            // The leaves before the first entry, then those beside the entry before.
            const std::size_t begin = side < 0 ? ends[level + 1] : step == firstStep ? 0 : ends[level - 1];
            const std::size_t end = side > 0 ? ends[level] : step == firstStep ? ends[levels + 1] : ends[level + 2];
            if (step > firstStep) {
                for (int i = 0; i < C::count; ++i) {
                    top.v[i] -= static_cast<T>(leafSize);
                    raiseTo<Vector>(top.v[i], heights[step].first.v[i]);
                }
            }
            if (begin < end) raise(tables, query, static_cast<int>(level), side, begin, end, heights[step].last, top);
            if (!isAny(open[level])) continue;
            for (int i = 0; i < C::count; ++i) {
                Vector bits{};
                for (int k = 0; k < 8; ++k) {
                    const T bit = static_cast<T>(side > 0 ? 1 << k : 128 >> k), before = static_cast<T>(none<T> + k);
                    bits |= reinterpret_cast<Vector>(top.v[i] > before) & bit;
                }
                open[level].v[i] &= ~bits;
            }
        }
        for (std::size_t level = 0; level < levels; ++level) {
            if (isAny(open[level])) return true;
        }
        return false;
    }

    // Raises `top` to the heights above the listed leaves, no higher than needed.
    static VDBCAGE_INLINE void raise(const Tables& tables, const PileQuery& query, int z, int side, std::size_t begin,
                                     std::size_t end, const C& needed, C& top)
    {
        const T* const entries = tables.entries<T>() + query.entryPlace;
        const T* const rows = tables.rows<T>() + query.rowPlace;
        const std::uint64_t entry = std::uint64_t{1} << (16 * query.x + 4 * query.y + z);
        const std::size_t first = nearest(query, z, begin, end);
        for (std::size_t n = begin; n <= end; ++n) {
            const std::size_t index = query.leaves.indices[n == begin ? first : n - 1];
            const NearLeaf& near = query.near[index];
            if ((near.entriesInRadius & entry) == 0) continue; // so it is not in those behind it either
            // The distance below the entry's first voxel (above the last) of the leaf's z = 0.
            const int base = side > 0 ? 8 * (z - near.z) : 8 * (near.z - z) - 7;
            const T least = static_cast<T>(side > 0 ? base - near.box.upper[2] : base + near.box.lower[2]);
            const T* const best = entries + near.entryPlace;
            Vector gain{};
            for (int i = 0; i < C::count; ++i) {
                Vector most;
                load(most, best, i);
                most -= least;
                lowerTo<Vector>(most, needed.v[i]);
                raiseTo<Vector>(most, top.v[i]);
                gain |= most ^ top.v[i];
            }
            if (!detail::isAny<Vector>(gain)) continue;
            const Fronts::Voxel* front = frontOf(tables, query, index, side);
            const T* const corner = rows + near.rowPlace;
            const Fronts::Voxel* const last = front + front->place;
            while (front != last) {
                ++front;
                const T depth = static_cast<T>(side > 0 ? base - front->z : base + front->z);
                for (int i = 0; i < C::count; ++i) {
                    Vector height;
                    load(height, corner + front->place, i);
                    raiseTo<Vector>(top.v[i], height - depth);
                }
            }
        }
    }

    // Covers voxels from the leaves beside the entry.
    static VDBCAGE_INLINE void lateral(const Tables& tables, const PileQuery& query, std::size_t z, C& open)
    {
        using S = std::make_signed_t<T>;
        using Signed = typename VectorOf<S, bytes>::type; // heights keep their order as signed numbers
        const T* const entries = tables.entries<T>() + query.entryPlace;
        const T* const rows = tables.rows<T>() + query.rowPlace;
        for (std::size_t n = query.leaves.ends[z]; n < query.leaves.ends[z + 1]; ++n) {
            const std::size_t index = query.leaves.indices[n];
            const NearLeaf& near = query.near[index];
            const T* const best = entries + near.entryPlace;
            Vector gain{};
            for (int i = 0; i < C::count; ++i) {
                Vector most;
                load(most, best, i);
                gain |= reinterpret_cast<Vector>(most != none<T>) & open.v[i];
            }
            if (!detail::isAny<Vector>(gain)) continue;
            const Fronts::Voxel* front = frontOf(tables, query, index, 0);
            const T* const corner = rows + near.rowPlace;
            const Fronts::Voxel* const end = front + front->place + 1;
            for (++front; front != end; ++front) {
                Signed heights[C::count];
                std::memcpy(&heights, corner + front->place, sizeof heights);
                // Most columns are covered completely or not at all.
                Vector some{};
                for (int i = 0; i < C::count; ++i) {
                    const Vector isWhole = reinterpret_cast<Vector>(heights[i] > static_cast<S>(none<T> + 7));
                    open.v[i] &= ~isWhole;
                    some |= reinterpret_cast<Vector>(heights[i] > static_cast<S>(none<T>)) & open.v[i];
                }
                if (!detail::isAny<Vector>(some)) continue;
                // Each more voxel of height covers one more voxel up and down.
                auto byte = static_cast<unsigned>(front->z);
                for (int height = 0;; ++height) {
                    const S least = static_cast<S>(none<T> + height);
                    const T bits = static_cast<T>(byte);
                    for (int i = 0; i < C::count; ++i)
                        open.v[i] &= ~(reinterpret_cast<Vector>(heights[i] > least) & bits);
                    if (byte == 0xFF) break;
                    byte |= (byte << 1 | byte >> 1) & 0xFF;
                }
            }
        }
    }
};

// Returns the sign of lane i as bit i.
VDBCAGE_INLINE unsigned signBits(const std::int16_t* lanes16)
{
#if defined(__x86_64__)
    const auto* const halves = reinterpret_cast<const __m128i*>(lanes16);
    return static_cast<unsigned>(
        _mm_movemask_epi8(_mm_packs_epi16(_mm_loadu_si128(halves), _mm_loadu_si128(halves + 1))));
#else
    unsigned bits = 0;
    for (int i = 0; i < 16; ++i) bits |= static_cast<unsigned>(lanes16[i] < 0) << i;
    return bits;
#endif
}

template <int bytes>
struct MaskKernel {
    using Vector = typename VectorOf<std::int16_t, bytes>::type;
    static constexpr int count = 32 / bytes;

    // Returns the entries where the squares along the three axes add up to the limit or less. `y` has each of its four
    // values four times.
    static VDBCAGE_INLINE std::uint64_t within(const std::int16_t* x, const Vector* y, std::uint64_t z,
                                               std::int16_t limit)
    {
        typedef std::uint64_t Quads __attribute__((vector_size(bytes)));
        const Vector along = reinterpret_cast<Vector>(Quads{} + z);
        std::uint64_t mask = 0;
        Vector sum[count];
        for (int i = 0; i < count; ++i) sum[i] = y[i] + along - limit - std::int16_t(1);
        for (int k = 0; k < 4; ++k) {
            alignas(32) std::int16_t signs[16];
            for (int i = 0; i < count; ++i) {
                const Vector s = sum[i] + x[k];
                std::memcpy(signs + i * bytes / 2, &s, bytes);
            }
            mask |= static_cast<std::uint64_t>(signBits(signs)) << (16 * k);
        }
        return mask;
    }

    static VDBCAGE_INLINE std::uint64_t quad(const std::array<std::int16_t, 4>& values)
    {
        std::uint64_t word;
        std::memcpy(&word, values.data(), sizeof word);
        return word;
    }

    static VDBCAGE_INLINE void entriesInRadius(const Tables& tables, NearLeaf* near, std::size_t total)
    {
        for (std::size_t n = 0; n < total; ++n) {
            NearLeaf& leaf = near[n];
            const int x = 8 * leaf.x, y = 8 * leaf.y, z = 8 * leaf.z;
            const auto &lowX = tables.squares(x + leaf.box.lower[0]), &highX = tables.squares(x + leaf.box.upper[0]);
            const auto &lowZ = tables.squares(z + leaf.box.lower[2]), &highZ = tables.squares(z + leaf.box.upper[2]);
            const auto &lowY = tables.wideSquares(y + leaf.box.lower[1]),
                       &highY = tables.wideSquares(y + leaf.box.upper[1]);
            // One of the two is 0.
            const std::uint64_t nearX = quad(lowX.below) | quad(highX.above);
            Vector nearY[count];
            for (int i = 0; i < count; ++i) {
                Vector a, b;
                std::memcpy(&a, lowY.below.data() + i * bytes / 2, bytes);
                std::memcpy(&b, highY.above.data() + i * bytes / 2, bytes);
                nearY[i] = a | b;
            }
            std::int16_t alongX[4];
            std::memcpy(alongX, &nearX, sizeof alongX);
            leaf.entryPlace = tables.entryPlace(-leaf.x, -leaf.y);
            leaf.rowPlace = tables.rowPlace(-x, -y);
            leaf.entriesInRadius = within(alongX, nearY, quad(lowZ.below) | quad(highZ.above), tables.limit);
        }
    }

    static VDBCAGE_INLINE std::uint64_t covered(const Tables& tables, const NearLeaf* near, std::size_t total,
                                                std::uint64_t wanted)
    {
        std::uint64_t result = 0;
        for (std::size_t n = 0; n < total && (wanted & ~result) != 0; ++n) {
            const NearLeaf& leaf = near[n];
            const auto &farX = tables.squares(8 * leaf.x + leaf.sample[0]),
                       &farZ = tables.squares(8 * leaf.z + leaf.sample[2]);
            const auto& farY = tables.wideSquares(8 * leaf.y + leaf.sample[1]);
            Vector alongY[count];
            for (int i = 0; i < count; ++i) std::memcpy(&alongY[i], farY.far.data() + i * bytes / 2, bytes);
            result |= within(farX.far.data(), alongY, quad(farZ.far), tables.limit);
        }
        return result;
    }
};

using WithinFunction = void (*)(const Tables&, const PileQuery&, Words*);

template <class T>
void withinPlain(const Tables& tables, const PileQuery& query, Words* result)
{
    Kernel<T, 16>::within(tables, query, result);
}
void nearPlain(const Tables& tables, NearLeaf* near, std::size_t count)
{
    MaskKernel<16>::entriesInRadius(tables, near, count);
}
std::uint64_t coveredPlain(const Tables& tables, const NearLeaf* near, std::size_t count, std::uint64_t wanted)
{
    return MaskKernel<16>::covered(tables, near, count, wanted);
}
#if VDBCAGE_WITH_AVX
template <class T>
VDBCAGE_TARGET_AVX2 void withinAvx2(const Tables& tables, const PileQuery& query, Words* result)
{
    Kernel<T, 32>::within(tables, query, result);
}
VDBCAGE_TARGET_AVX2 void nearAvx2(const Tables& tables, NearLeaf* near, std::size_t count)
{
    MaskKernel<32>::entriesInRadius(tables, near, count);
}
VDBCAGE_TARGET_AVX2 std::uint64_t coveredAvx2(const Tables& tables, const NearLeaf* near, std::size_t count,
                                              std::uint64_t wanted)
{
    return MaskKernel<32>::covered(tables, near, count, wanted);
}
template <class T>
VDBCAGE_TARGET_AVX512 void withinAvx512(const Tables& tables, const PileQuery& query, Words* result)
{
    Kernel<T, 64>::within(tables, query, result);
}
#endif

WithinFunction withinFunction(Simd simd, bool isSmall)
{
#if VDBCAGE_WITH_AVX
    if (simd == Simd::avx512) return isSmall ? withinAvx512<std::uint8_t> : withinAvx512<std::int16_t>;
    if (simd == Simd::avx2) return isSmall ? withinAvx2<std::uint8_t> : withinAvx2<std::int16_t>;
#endif
    (void)simd;
    return isSmall ? withinPlain<std::uint8_t> : withinPlain<std::int16_t>;
}

} // namespace

SphereQuery::SphereQuery(std::int64_t squaredRadius, Simd simd, const Progress& progress)
    : tables_(std::make_unique<Tables>(squaredRadius, progress)), simd_(simd)
{
}
SphereQuery::~SphereQuery() = default;

void SphereQuery::nearEntries(NearLeaf* near, std::size_t count, const Work& /*work*/) const
{
#if VDBCAGE_WITH_AVX
    if (simd_ != Simd::plain) return nearAvx2(*tables_, near, count);
#endif
    nearPlain(*tables_, near, count);
}
std::uint64_t SphereQuery::coveredEntries(const NearLeaf* near, std::size_t count, std::uint64_t wanted,
                                          const Work& /*work*/) const
{
#if VDBCAGE_WITH_AVX
    if (simd_ != Simd::plain) return coveredAvx2(*tables_, near, count, wanted);
#endif
    return coveredPlain(*tables_, near, count, wanted);
}

void SphereQuery::startBlock(Work& work, std::size_t leaves) const
{
    work.starts.assign(leaves * 27, 0);
    work.size = 1;
}
void SphereQuery::startPart(Work& /*work*/, const Coord& /*corner*/) const
{
}

std::array<Words, 4> SphereQuery::within(const Pile& open, int pile, const NearLeaf* near, const Leaves& leaves,
                                         Work& work) const
{
    const int x = pile >> 2, y = pile & 3;
    const int entryPlace = x * tables_->entryStride() + y * lanes, rowPlace = 8 * (x * tables_->rowStride() + 8 * y);
    std::array<Words, 4> result;
    withinFunction(simd_, tables_->isSmall)(*tables_, {open, x, y, entryPlace, rowPlace, near, leaves, work},
                                            result.data());
    return result;
}

} // namespace vdbcage::detail
