#pragma once

// Arithmetic on several doubles at a time, for sources compiled for one instruction set each. All is local to the
// source, so that no other source runs instructions that its processor lacks. Every operation is one of IEEE 754 on
// each lane alone: all instruction sets, of any width, return the same bits.

#include <cstdint>

#if defined(__SSE2__)
#include <immintrin.h>
#endif

#include <vdbcage/core/detail/pi.h>

namespace vdbcage::detail {
namespace {

#if defined(__AVX512F__)
constexpr int width = 8;
#elif defined(__AVX2__)
constexpr int width = 4;
#else
constexpr int width = 2;
#endif

typedef double Lanes __attribute__((vector_size(8 * width)));
typedef std::int64_t Mask __attribute__((vector_size(8 * width))); // all bits of a lane, or none

inline Lanes all(double value)
{
    return Lanes{} + value;
}

inline Lanes load(const double* from)
{
    Lanes lanes;
    __builtin_memcpy(&lanes, from, sizeof lanes);
    return lanes;
}

inline void store(Lanes lanes, double* to)
{
    __builtin_memcpy(to, &lanes, sizeof lanes);
}

inline void add(Lanes lanes, double* to)
{
    store(load(to) + lanes, to);
}

inline Lanes select(Mask mask, Lanes yes, Lanes no)
{
    return mask ? yes : no;
}

inline Lanes abs(Lanes lanes)
{
    return (Lanes)((Mask)lanes & INT64_MAX);
}

/// Returns `lanes`, with the sign flipped where `sign` is negative.
inline Lanes signedBy(Lanes lanes, Lanes sign)
{
    return (Lanes)((Mask)lanes ^ ((Mask)sign & INT64_MIN));
}

inline Lanes least(Lanes a, Lanes b)
{
    return a < b ? a : b;
}

inline Lanes most(Lanes a, Lanes b)
{
    return a > b ? a : b;
}

inline Lanes squareRoot(Lanes lanes)
{
#if defined(__AVX512F__)
    return _mm512_maskz_sqrt_pd(0xFF, lanes); // the plain one warns in g++ 12
#elif defined(__AVX2__)
    return _mm256_sqrt_pd(lanes);
#elif defined(__SSE2__)
    return _mm_sqrt_pd(lanes);
#else
    for (int i = 0; i < width; ++i) lanes[i] = __builtin_sqrt(lanes[i]);
    return lanes;
#endif
}

/// Returns a bit for each lane.
inline unsigned bits(Mask mask)
{
#if defined(__AVX512F__)
    return _mm512_cmplt_epi64_mask((__m512i)mask, _mm512_setzero_si512());
#elif defined(__AVX2__)
    return static_cast<unsigned>(_mm256_movemask_pd((__m256d)mask));
#elif defined(__SSE2__)
    return static_cast<unsigned>(_mm_movemask_pd((__m128d)mask));
#else
    unsigned bits = 0;
    for (int i = 0; i < width; ++i) bits |= static_cast<unsigned>(mask[i] & 1) << i;
    return bits;
#endif
}

inline bool any(Mask mask)
{
    return bits(mask) != 0;
}

struct Vector {
    Lanes x, y, z;
};

inline Vector operator+(Vector a, Vector b)
{
    return {a.x + b.x, a.y + b.y, a.z + b.z};
}

inline Vector operator*(Lanes s, Vector a)
{
    return {s * a.x, s * a.y, s * a.z};
}

/// Returns the vectors from each lane's point to one place.
inline Vector towards(const double (&place)[3], Vector from)
{
    return {place[0] - from.x, place[1] - from.y, place[2] - from.z};
}

inline Lanes dot(Vector a, Vector b)
{
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

inline Lanes dot(const double (&a)[3], Vector b)
{
    return a[0] * b.x + a[1] * b.y + a[2] * b.z;
}

inline Vector cross(Vector a, Vector b)
{
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

/// Returns the angle, 0 to pi, whose tangent is y / x; y is not negative. It is off by about 1e-16.
///
/// It first subtracts pi / 4 or pi / 2, so that the rest has a tangent of at most tan(pi / 8). The polynomial
/// interpolates atan(t) / t at the Chebyshev points of t^2 and is off by 4e-17.
inline Lanes angleOf(Lanes y, Lanes x)
{
    constexpr double tangent = 0.41421356237309504880; // of pi / 8
    constexpr double c[] = {0.99999999999999996532,   -0.33333333333328438572,  0.19999999998855110133,
                            -0.14285714180976466754,  0.1111110618045594214,    -0.090907730748083422369,
                            0.076899534963058498403,  -0.066402339304206526316, 0.056883492267631898886,
                            -0.043480522155840866441, 0.021135373156072050305};
    const Lanes right = abs(x);
    const Mask beyondEighth = y > tangent * right, beyondQuarter = y * tangent > right;
    const Lanes above = select(beyondQuarter, -right, select(beyondEighth, y - right, y));
    const Lanes below = select(beyondQuarter, y, select(beyondEighth, y + right, right));
    const Lanes start = select(beyondQuarter, all(0.5 * pi), select(beyondEighth, all(0.25 * pi), all(0)));
    const Lanes t = above / most(below, all(1e-300)), z = t * t, z2 = z * z, z4 = z2 * z2;
    const Lanes low = (c[0] + z * c[1]) + z2 * (c[2] + z * c[3]);
    const Lanes middle = (c[4] + z * c[5]) + z2 * (c[6] + z * c[7]);
    const Lanes high = (c[8] + z * c[9]) + z2 * c[10];
    const Lanes angle = start + t * (low + z4 * (middle + z4 * high));
    return select(x < 0, pi - angle, angle);
}

/// The largest quotient that areaTangent() takes.
constexpr double mostQuotient = 0.99927;

/// Returns atanh(n / d), for 0 <= n <= mostQuotient d. It is off by a few units in the last place of the quotient's
/// distance from 1.
///
/// It first subtracts a multiple of 0.88, so that the rest has a tanh of at most tanh(0.44). The polynomial
/// interpolates as in angleOf() and is off by 1e-17.
inline Lanes areaTangent(Lanes n, Lanes d)
{
    struct Part {
        double from, tangent, value; // it begins at this quotient; its middle's quotient and value
    };
    constexpr Part parts[] = {{0.41364444218713516018, 0.70641932039723523504, 0.88},
                              {0.86678392884981867301, 0.94250300814692005344, 1.76},
                              {0.97574313003145152041, 0.98986674133306748913, 2.64},
                              {0.99578439787591349642, 0.99824928072714152527, 3.52}};
    constexpr double c[] = {0.99999999999999999171,  0.33333333333334728367,   0.1999999999961244604,
                            0.14285714327776085854,  0.11111108759440581203,   0.090909863932485323734,
                            0.076907043257803690802, 0.06688415330093643862,   0.056875277731437956552,
                            0.063963165129871982528, 0.0072158141831536347238, 0.11933139004761497282};
    Lanes tangent = all(0), start = all(0);
    for (const Part& part : parts) {
        const Mask beyond = n > part.from * d;
        tangent = select(beyond, all(part.tangent), tangent);
        start = select(beyond, all(part.value), start);
    }
    const Lanes t = (n - tangent * d) / (d - tangent * n), z = t * t, z2 = z * z, z4 = z2 * z2;
    const Lanes low = (c[0] + z * c[1]) + z2 * (c[2] + z * c[3]);
    const Lanes middle = (c[4] + z * c[5]) + z2 * (c[6] + z * c[7]);
    const Lanes high = (c[8] + z * c[9]) + z2 * (c[10] + z * c[11]);
    return start + t * (low + z4 * (middle + z4 * high));
}

} // namespace
} // namespace vdbcage::detail
