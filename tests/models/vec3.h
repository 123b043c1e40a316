#pragma once

// Arithmetic that gives the same bits on every machine: only + - * / and square root, which IEEE 754 rounds exactly.
// The sine and cosine of the C library differ in their last bit from one machine to the next; these do not.

#include <cfloat>
#include <cmath>

namespace data {

static_assert(FLT_EVAL_METHOD == 0, "doubles must be computed as doubles");

constexpr double pi = 3.14159265358979323846;

struct Vec3 {
    double x = 0, y = 0, z = 0;
};

inline Vec3 operator+(const Vec3& a, const Vec3& b)
{
    return {a.x + b.x, a.y + b.y, a.z + b.z};
}

inline Vec3 operator-(const Vec3& a, const Vec3& b)
{
    return {a.x - b.x, a.y - b.y, a.z - b.z};
}

inline Vec3 operator*(double s, const Vec3& a)
{
    return {s * a.x, s * a.y, s * a.z};
}

inline double dot(const Vec3& a, const Vec3& b)
{
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

inline Vec3 cross(const Vec3& a, const Vec3& b)
{
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

inline double length(const Vec3& a)
{
    return std::sqrt(dot(a, a));
}

inline Vec3 normalized(const Vec3& a)
{
    return (1 / length(a)) * a;
}

inline double lerp(double a, double b, double t)
{
    return a + t * (b - a);
}

inline Vec3 lerp(const Vec3& a, const Vec3& b, double t)
{
    return a + t * (b - a);
}

inline double clamp(double x, double low, double high)
{
    return x < low ? low : high < x ? high : x;
}

/// 0 below `a`, 1 above `b`, between them the cubic with level ends.
inline double smoothStep(double a, double b, double x)
{
    const double t = clamp((x - a) / (b - a), 0, 1);
    return t * t * (3 - 2 * t);
}

/// Sine and cosine of `x` radians by the Taylor series in the octant around a multiple of a quarter turn.
inline void sineCosine(double x, double& sine, double& cosine)
{
    const double quarters = std::floor(x / (pi / 2) + 0.5);
    const double r = x - quarters * (pi / 2);
    double s = 0;
    double c = 0;
    for (int n = 18; n >= 2; n -= 2) {
        s = -r * r * (1 + s) / (n * (n + 1));
        c = -r * r * (1 + c) / (n * (n - 1));
    }
    s = r * (1 + s);
    c = 1 + c;
    const int quadrant = static_cast<int>(quarters - 4 * std::floor(quarters / 4));
    sine = quadrant == 0 ? s : quadrant == 1 ? c : quadrant == 2 ? -s : -c;
    cosine = quadrant == 0 ? c : quadrant == 1 ? -s : quadrant == 2 ? -c : s;
}

inline double sine(double x)
{
    double s = 0;
    double c = 0;
    sineCosine(x, s, c);
    return s;
}

inline double cosine(double x)
{
    double s = 0;
    double c = 0;
    sineCosine(x, s, c);
    return c;
}

} // namespace data
