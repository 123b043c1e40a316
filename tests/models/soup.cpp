// What no modeller means to make and every importer meets: parts that run through each other, some inside out, with
// faces turned, doubled, missing or without area, edges with more than two faces, and points of no face.

#include <cstdint>

#include "model.h"

namespace data {

namespace {

/// Knuth's linear congruential generator (MMIX): the same numbers everywhere.
class Random {
public:
    /// In [0, 1).
    double number()
    {
        state_ = state_ * 6364136223846793005U + 1442695040888963407U;
        return static_cast<double>(state_ >> 11) / 9007199254740992.0;
    }

    double between(double low, double high) { return low + (high - low) * number(); }
    bool oneIn(int n) { return number() * n < 1; }

    /// Evenly in the unit ball.
    Vec3 inBall()
    {
        Vec3 p;
        do {
            p = {between(-1, 1), between(-1, 1), between(-1, 1)};
        } while (dot(p, p) > 1 || dot(p, p) < 0.01);
        return p;
    }

private:
    std::uint64_t state_ = 20261121;
};

/// A box of quads, `n` by `n` on a side; its corners drawn towards a ball by `round` from 0 to 1. The sides share no
/// points.
Model makeBox(int n, double round)
{
    Model model;
    for (int side = 0; side < 6; ++side) {
        const int first = static_cast<int>(model.points.size());
        for (int j = 0; j <= n; ++j) {
            for (int i = 0; i <= n; ++i) {
                const double a = 2.0 * i / n - 1;
                const double b = 2.0 * j / n - 1;
                const double c = side < 3 ? 1 : -1;
                // The negative side runs the other way round, so that both look outward.
                const Vec3 p = side % 3 == 0   ? Vec3{c, c * a, b}
                               : side % 3 == 1 ? Vec3{b, c, c * a}
                                               : Vec3{c * a, b, c};
                model.addPoint(lerp(p, normalized(p), round));
            }
        }
        for (int j = 0; j < n; ++j) {
            for (int i = 0; i < n; ++i) {
                const int a = first + j * (n + 1) + i;
                model.addQuad(a, a + 1, a + n + 2, a + n + 1);
            }
        }
    }
    return model;
}

Model makeTetrahedron()
{
    Model model;
    model.points = {{1, 1, 1}, {1, -1, -1}, {-1, 1, -1}, {-1, -1, 1}};
    for (const Face& face : {Face{0, 1, 2, -1}, Face{0, 3, 1, -1}, Face{0, 2, 3, -1}, Face{1, 3, 2, -1}})
        model.faces.push_back(face);
    return model;
}

/// `blades` triangles around one common edge.
Model makeFan(int blades)
{
    Model model;
    model.points = {{0, -1, 0}, {0, 1, 0}};
    for (int i = 0; i < blades; ++i) {
        const double turn = 2 * pi * i / blades;
        model.addTriangle(0, 1, model.addPoint({cosine(turn), 0.2 * i - 0.4, sine(turn)}));
    }
    return model;
}

/// A sheet bent to a saddle; its corners are not shared from one quad to the next.
Model makeSheet(int n)
{
    Model model;
    const auto at = [n](int i, int j) {
        const double x = 2.0 * i / n - 1;
        const double z = 2.0 * j / n - 1;
        return Vec3{x, 0.5 * (x * x - z * z), z};
    };
    for (int i = 0; i < n; ++i) {
        for (int j = 0; j < n; ++j) {
            int corners[4];
            for (int c = 0; c < 4; ++c) corners[c] = model.addPoint(at(i + (c == 1 || c == 2), j + (c > 1)));
            model.addQuad(corners[0], corners[3], corners[2], corners[1]);
        }
    }
    return model;
}

/// Sizes, turns and moves a part.
void scatter(Model& part, Random& random, double reach)
{
    const Vec3 x = normalized(random.inBall());
    const Vec3 y = normalized(cross(x, random.inBall()));
    const Vec3 z = cross(x, y);
    const Vec3 size{random.between(0.7, 2.4), random.between(0.7, 2.4), random.between(0.4, 1.6)};
    const Vec3 center = reach * random.inBall() + Vec3{0, 7, 0};
    for (Vec3& p : part.points) p = center + (size.x * p.x) * x + (size.y * p.y) * y + (size.z * p.z) * z;
}

Face turned(Face face)
{
    if (face[3] < 0) return {face[0], face[2], face[1], -1};
    return {face[0], face[3], face[2], face[1]};
}

} // namespace

Model makeSoup()
{
    Random random;
    Model soup;
    Model core = makeBox(6, 0.9);
    for (Vec3& p : core.points) p = 3.6 * p + Vec3{0, 7, 0};
    soup.append(core);
    for (int i = 0; i < 48; ++i) {
        Model part;
        switch (i % 6) {
        case 0:
            part = makeBox(2, 0);
            break;
        case 1:
            part = makeTetrahedron();
            break;
        case 2:
            part = makeFan(3 + i % 4);
            break;
        case 3:
            part = makeSheet(3);
            break;
        case 4:
            part = makeBox(3, 0.8);
            break;
        default:
            part = makeBox(1, 0);
            break;
        }
        scatter(part, random, 4.6);
        if (random.oneIn(4)) // inside out
            for (Face& face : part.faces) face = turned(face);
        soup.append(part);
    }

    const std::vector<Face> good = soup.faces;
    soup.faces.clear();
    for (const Face& face : good) {
        if (random.oneIn(40)) continue;                                    // a hole
        soup.faces.push_back(random.oneIn(12) ? turned(face) : face);      // turned
        if (random.oneIn(25)) soup.faces.push_back(face);                  // doubled
        if (random.oneIn(25)) soup.faces.push_back(turned(face));          // doubled and turned
        if (random.oneIn(40)) soup.addTriangle(face[0], face[1], face[1]); // a corner twice
        if (random.oneIn(40)) {                                            // a spike: three points of a line
            const Vec3 a = soup.points[static_cast<std::size_t>(face[0])];
            const int b = soup.addPoint(a + Vec3{0.25, 0.5, 0});
            const int c = soup.addPoint(a + Vec3{0.5, 1, 0});
            soup.addTriangle(face[0], b, c);
        }
        if (random.oneIn(40)) { // three points in one place
            const Vec3 a = soup.points[static_cast<std::size_t>(face[2])];
            const int b = soup.addPoint(a);
            const int c = soup.addPoint(a);
            soup.addTriangle(face[2], b, c);
        }
    }
    for (int i = 0; i < 12; ++i) soup.addPoint(5.0 * random.inBall() + Vec3{0, 7, 0}); // points of no face
    return soup;
}

} // namespace data
