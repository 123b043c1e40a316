// Based on: S. Gibson, "Constrained Elastic SurfaceNets", 1998.
// Differs: the net is not held by its cells but moved back onto the surface by Newton steps.

#include "implicit.h"

#include <algorithm>
#include <map>

namespace data {

namespace {

constexpr double gradientStep = 1e-4;

Vec3 gradient(const Field& field, const Vec3& p)
{
    // Four corners of a tetrahedron give the three slopes.
    const double h = gradientStep;
    const double a = field({p.x + h, p.y - h, p.z - h});
    const double b = field({p.x - h, p.y - h, p.z + h});
    const double c = field({p.x - h, p.y + h, p.z - h});
    const double d = field({p.x + h, p.y + h, p.z + h});
    return (1 / (4 * h)) * Vec3{a - b - c + d, -a - b + c + d, -a + b - c + d};
}

/// Moves `p` onto the surface, by at most `reach` a step; returns the unit normal there.
Vec3 project(const Field& field, Vec3& p, double reach, int steps)
{
    Vec3 normal;
    for (int i = 0; i < steps; ++i) {
        const Vec3 slope = gradient(field, p);
        const double size = std::max(length(slope), 0.1);
        normal = (1 / size) * slope;
        p = p - clamp(field(p) / size, -reach, reach) * normal;
    }
    return normal;
}

std::size_t index(int i)
{
    return static_cast<std::size_t>(i);
}

/// The field at all points of the grid, z fastest. A block of points that is far from the surface, twice as far as its
/// own reach to be safe from fields that are not quite distances, gets the value of its middle.
std::vector<double> sample(const Field& field, const Grid& grid, const std::array<int, 3>& size)
{
    constexpr int block = 5;
    std::vector<double> values(index(size[0] * size[1] * size[2]));
    const double reach = grid.cell * block / 2 * 1.8;
    for (int bi = 0; bi < size[0]; bi += block) {
        for (int bj = 0; bj < size[1]; bj += block) {
            for (int bk = 0; bk < size[2]; bk += block) {
                const double middle = field(grid(bi + block / 2, bj + block / 2, bk + block / 2));
                const bool far = std::fabs(middle) > 2 * reach;
                for (int i = bi; i < std::min(bi + block, size[0]); ++i)
                    for (int j = bj; j < std::min(bj + block, size[1]); ++j)
                        for (int k = bk; k < std::min(bk + block, size[2]); ++k)
                            values[index((i * size[1] + j) * size[2] + k)] = far ? middle : field(grid(i, j, k));
            }
        }
    }
    return values;
}

/// Number of the cube's edge along `axis` that starts or ends at `corner`; bit i of a corner is its place along axis i.
std::size_t edgeOf(int axis, int corner)
{
    return index(axis * 4 + (corner >> ((axis + 1) % 3) & 1) + 2 * (corner >> ((axis + 2) % 3) & 1));
}

/// For each edge of a cube the sheet of the surface that crosses it, named by one of its edges, or -1. Where all four
/// edges of a side are crossed, the two corners inside are kept apart; as the cube across that side decides the same,
/// the sheets make a manifold.
std::array<int, 12> sheets(int inside)
{
    std::array<int, 12> sheet{};
    for (int axis = 0; axis < 3; ++axis)
        for (int c = 0; c < 8; ++c)
            sheet[edgeOf(axis, c)] =
                (inside >> c & 1) == (inside >> (c ^ 1 << axis) & 1) ? -1 : static_cast<int>(edgeOf(axis, c));
    const auto join = [&](std::size_t a, std::size_t b) {
        const int from = sheet[a];
        const int to = sheet[b];
        for (int& s : sheet)
            if (s == from) s = to;
    };
    for (int axis = 0; axis < 3; ++axis) {
        const int u = (axis + 1) % 3;
        const int v = (axis + 2) % 3;
        for (const int side : {0, 1 << axis}) {
            const std::array<std::size_t, 4> edges{edgeOf(u, side), edgeOf(u, side | 1 << v), edgeOf(v, side),
                                                   edgeOf(v, side | 1 << u)};
            std::vector<std::size_t> crossed;
            for (const std::size_t edge : edges)
                if (sheet[edge] >= 0) crossed.push_back(edge);
            if (crossed.size() == 2) join(crossed[0], crossed[1]);
            if (crossed.size() < 4) continue;
            for (const int c : {side, side | 1 << u, side | 1 << v, side | 1 << u | 1 << v})
                if (inside >> c & 1) join(edgeOf(u, c), edgeOf(v, c));
        }
    }
    return sheet;
}

} // namespace

std::vector<Knot> spline(const std::vector<Knot>& knots, int steps)
{
    std::vector<Knot> result;
    const int last = static_cast<int>(knots.size()) - 1;
    const auto at = [&](int i) { return knots[index(std::min(std::max(i, 0), last))]; };
    for (int i = 0; i < last; ++i) {
        for (int k = 0; k < steps; ++k) {
            const double t = static_cast<double>(k) / steps;
            const double weights[4] = {-0.5 * t + t * t - 0.5 * t * t * t, 1 - 2.5 * t * t + 1.5 * t * t * t,
                                       0.5 * t + 2 * t * t - 1.5 * t * t * t, -0.5 * t * t + 0.5 * t * t * t};
            Knot knot{{0, 0, 0}, 0};
            for (int j = 0; j < 4; ++j) {
                knot.center = knot.center + weights[j] * at(i - 1 + j).center;
                knot.radius += weights[j] * at(i - 1 + j).radius;
            }
            result.push_back(knot);
        }
    }
    result.push_back(knots.back());
    return result;
}

double tubeDistance(const std::vector<Knot>& knots, const Vec3& p)
{
    double least = length(p - knots[0].center) - knots[0].radius;
    for (std::size_t i = 0; i + 1 < knots.size(); ++i) {
        const Vec3 span = knots[i + 1].center - knots[i].center;
        const double size = length(span);
        const double growth = (knots[i + 1].radius - knots[i].radius) / size;
        const Vec3 offset = p - knots[i].center;
        const double along = dot(offset, span) / size;
        const double aside = std::sqrt(std::max(0.0, dot(offset, offset) - along * along));
        // The ball that is nearest is not the one abreast of p when the radius changes.
        const double lean = clamp(growth, -0.95, 0.95);
        const double t = clamp(along + aside * lean / std::sqrt(1 - lean * lean), 0, size) / size;
        least = std::min(least, length(offset - t * span) - lerp(knots[i].radius, knots[i + 1].radius, t));
    }
    return least;
}

double ellipsoidDistance(const Vec3& center, const std::array<Vec3, 3>& axes, const Vec3& radii, const Vec3& p)
{
    const Vec3 offset = p - center;
    const Vec3 q{dot(offset, axes[0]) / radii.x, dot(offset, axes[1]) / radii.y, dot(offset, axes[2]) / radii.z};
    const double k0 = length(q);
    const double k1 = length(Vec3{q.x / radii.x, q.y / radii.y, q.z / radii.z});
    if (k1 < 1e-9) return -std::min({radii.x, radii.y, radii.z});
    return k0 * (k0 - 1) / k1;
}

void Clay::addEllipsoid(const Vec3& center, const Vec3& radii, double fillet, const std::array<Vec3, 3>& axes)
{
    parts_.push_back({{}, axes, radii, center, std::max({radii.x, radii.y, radii.z}), fillet, false});
}

void Clay::addTube(const std::vector<Knot>& knots, double fillet)
{
    Vec3 center;
    for (const Knot& knot : knots) center = center + (1.0 / static_cast<double>(knots.size())) * knot.center;
    double reach = 0;
    for (const Knot& knot : knots) reach = std::max(reach, length(knot.center - center) + knot.radius);
    parts_.push_back({knots, {}, {}, center, reach, fillet, false});
}

void Clay::carveEllipsoid(const Vec3& center, const Vec3& radii, double fillet, const std::array<Vec3, 3>& axes)
{
    addEllipsoid(center, radii, fillet, axes);
    parts_.back().carve = true;
}

void Clay::carveTube(const std::vector<Knot>& knots, double fillet)
{
    addTube(knots, fillet);
    parts_.back().carve = true;
}

double Clay::operator()(const Vec3& p) const
{
    double clay = 1e9;
    for (const Part& part : parts_) {
        // Most parts are too far away to change anything.
        const double bound = length(p - part.center) - part.reach;
        if (bound > (part.carve ? -clay : clay) + part.fillet) continue;
        // No nearer than the ball around it: else leaving a part out would be seen.
        const double distance =
            std::max(bound, part.knots.empty() ? ellipsoidDistance(part.center, part.axes, part.radii, p)
                                               : tubeDistance(part.knots, p));
        clay = part.carve ? smoothMax(clay, -distance, part.fillet) : smoothMin(clay, distance, part.fillet);
    }
    return clay;
}

Vec3 Grid::operator()(int i, int j, int k) const
{
    const Vec3 offset = low + cell * Vec3{1.0 * i, 1.0 * j, 1.0 * k} - focus;
    return focus + lerp(1 / density, 1, smoothStep(0, reach, length(offset))) * offset;
}

Model contour(const Field& field, const Grid& grid, int rounds)
{
    const std::array<int, 3> size{static_cast<int>((grid.high.x - grid.low.x) / grid.cell) + 2,
                                  static_cast<int>((grid.high.y - grid.low.y) / grid.cell) + 2,
                                  static_cast<int>((grid.high.z - grid.low.z) / grid.cell) + 2};
    const auto at = [&](const std::array<int, 3>& p) { return index((p[0] * size[1] + p[1]) * size[2] + p[2]); };
    const std::vector<double> values = sample(field, grid, size);

    // Points for each cube that has corners on both sides: one for each sheet, in the mean of where the cube's edges
    // meet it.
    Model net;
    std::vector<int> cubeAt(values.size(), -1);
    std::vector<std::array<int, 12>> pointOnEdge; // of each such cube
    std::array<int, 3> p{};
    for (p[0] = 0; p[0] + 1 < size[0]; ++p[0]) {
        for (p[1] = 0; p[1] + 1 < size[1]; ++p[1]) {
            for (p[2] = 0; p[2] + 1 < size[2]; ++p[2]) {
                std::array<double, 8> corners{};
                int inside = 0;
                for (int c = 0; c < 8; ++c) {
                    corners[index(c)] = values[at({p[0] + (c & 1), p[1] + (c >> 1 & 1), p[2] + (c >> 2)})];
                    inside |= (corners[index(c)] < 0) << c;
                }
                if (inside == 0 || inside == 255) continue;
                std::array<int, 12> points = sheets(inside);
                std::array<Vec3, 12> sums{};
                std::array<int, 12> counts{};
                for (int axis = 0; axis < 3; ++axis) {
                    for (int c = 0; c < 8; ++c) {
                        if (c >> axis & 1 || points[edgeOf(axis, c)] < 0) continue;
                        std::array<int, 3> end{p[0] + (c & 1), p[1] + (c >> 1 & 1), p[2] + (c >> 2)};
                        const Vec3 a = grid(end[0], end[1], end[2]);
                        ++end[index(axis)];
                        const Vec3 b = grid(end[0], end[1], end[2]);
                        const double fa = corners[index(c)];
                        const double fb = corners[index(c | 1 << axis)];
                        const std::size_t sheet = index(points[edgeOf(axis, c)]);
                        sums[sheet] = sums[sheet] + lerp(a, b, fa / (fa - fb));
                        ++counts[sheet];
                    }
                }
                std::array<int, 12> pointOfSheet{};
                for (std::size_t sheet = 0; sheet < 12; ++sheet)
                    if (counts[sheet] > 0) pointOfSheet[sheet] = net.addPoint((1.0 / counts[sheet]) * sums[sheet]);
                for (int& point : points)
                    if (point >= 0) point = pointOfSheet[index(point)];
                cubeAt[at(p)] = static_cast<int>(pointOnEdge.size());
                pointOnEdge.push_back(points);
            }
        }
    }
    // One quad for each edge that meets the surface: the points of the four cubes around it.
    std::vector<Face> quads;
    for (p[0] = 1; p[0] + 1 < size[0]; ++p[0]) {
        for (p[1] = 1; p[1] + 1 < size[1]; ++p[1]) {
            for (p[2] = 1; p[2] + 1 < size[2]; ++p[2]) {
                for (int axis = 0; axis < 3; ++axis) {
                    std::array<int, 3> end = p;
                    ++end[index(axis)];
                    const bool inside = values[at(p)] < 0;
                    if (inside == (values[at(end)] < 0)) continue;
                    const int u = (axis + 1) % 3;
                    const int v = (axis + 2) % 3;
                    Face quad{};
                    for (int i = 0; i < 4; ++i) {
                        const int du = i == 0 || i == 3;
                        const int dv = i < 2;
                        std::array<int, 3> cube = p;
                        cube[index(u)] -= du;
                        cube[index(v)] -= dv;
                        quad[index(inside ? i : 3 - i)] =
                            pointOnEdge[index(cubeAt[at(cube)])][edgeOf(axis, du << u | dv << v)];
                    }
                    quads.push_back(quad);
                }
            }
        }
    }

    const double reach = grid.cell / grid.density;
    std::vector<Vec3> normals(net.points.size());
    for (std::size_t i = 0; i < normals.size(); ++i) normals[i] = project(field, net.points[i], reach, 4);
    std::vector<Vec3> sums(net.points.size());
    std::vector<int> counts(net.points.size());
    for (int round = 0; round < rounds; ++round) {
        std::fill(sums.begin(), sums.end(), Vec3{});
        std::fill(counts.begin(), counts.end(), 0);
        for (const Face& quad : quads) {
            for (std::size_t c = 0; c < 4; ++c) {
                const std::size_t from = index(quad[c]);
                sums[from] = sums[from] + net.points[index(quad[(c + 1) % 4])];
                ++counts[from];
            }
        }
        for (std::size_t i = 0; i < normals.size(); ++i) {
            const Vec3 move = (1.0 / counts[i]) * sums[i] - net.points[i];
            net.points[i] = net.points[i] + 0.5 * (move - dot(move, normals[i]) * normals[i]);
        }
        for (std::size_t i = 0; i < normals.size(); ++i)
            normals[i] = project(field, net.points[i], reach, round + 1 == rounds ? 5 : 1);
    }
    for (const Face& quad : quads) net.addQuad(quad[0], quad[1], quad[2], quad[3]);
    return net;
}

Model subdivide(const Model& quads, const Field& field)
{
    Model fine;
    fine.points = quads.points;
    std::map<std::pair<int, int>, int> middles;
    const auto add = [&](Vec3 point, double reach) {
        project(field, point, reach, 3);
        return fine.addPoint(point);
    };
    const auto middle = [&](int a, int b) {
        const auto key = std::minmax(a, b);
        const auto found = middles.find(key);
        if (found != middles.end()) return found->second;
        const Vec3 pa = quads.points[index(key.first)];
        const Vec3 pb = quads.points[index(key.second)];
        const int point = add(lerp(pa, pb, 0.5), 0.25 * length(pa - pb));
        middles.emplace(key, point);
        return point;
    };
    fine.faces.reserve(4 * quads.faces.size());
    for (const Face& f : quads.faces) {
        const int m[4] = {middle(f[0], f[1]), middle(f[1], f[2]), middle(f[2], f[3]), middle(f[3], f[0])};
        Vec3 sum;
        for (const int corner : f) sum = sum + 0.25 * quads.points[index(corner)];
        const int center = add(sum, 0.25 * length(quads.points[index(f[0])] - quads.points[index(f[2])]));
        for (int c = 0; c < 4; ++c) fine.addQuad(f[index(c)], m[c], center, m[(c + 3) % 4]);
    }
    return fine;
}

} // namespace data
