// Based on: Joshi, Meyer, DeRose, Green, Sanocki, "Harmonic Coordinates for Character Articulation", 2007; Gibou,
// Fedkiw, Cheng, Kang, "A Second-Order-Accurate Symmetric Discretization of the Poisson Equation on Irregular Domains",
// 2002; for the preconditioner Bridson, "Fluid Simulation for Computer Graphics", 2008.
// Differs: Joshi et al. set boundary values in the voxels that the cage meets. Here they are set where edges of the
// grid cross the cage, so that points are reproduced. Values near the cage are interpolated up to it.

#include <vdbcage/deform/detail/families/harmonic.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

#include <tbb/blocked_range.h>
#include <vdbcage/core/detail/parallel.h>
#include <vdbcage/core/detail/pi.h>
#include <vdbcage/deform/detail/coordinate_family.h>
#include <vdbcage/deform/detail/triangle_potentials.h>

namespace vdbcage::detail {

using openvdb::Coord;
using openvdb::Vec3d;

namespace {

/// The distance, in voxels, below which something is met; no distance is taken as less.
constexpr double nearest = 1e-10;

constexpr std::size_t laneCount = 8; // a cache line
/// The values of as many cage points as are solved together.
using Lanes = std::array<double, laneCount>;

template <typename Function>
void forEachLane(const Function& function)
{
    for (std::size_t lane = 0; lane < laneCount; ++lane) function(lane);
}

/// Laplace's equation on a grid, times minus one.
class GridLaplacian {
public:
    /// A node's equation: `diagonal` times its value, minus the values at its neighbours, is given. Neighbours are
    /// nodes inside, below and above along each axis, or the number of nodes.
    struct Row {
        std::array<std::uint32_t, 3> below, above;
        double diagonal;
    };

    explicit GridLaplacian(std::vector<Row> rows) : rows_(std::move(rows)), pivots_(rows_.size() + 1, 0.0)
    {
        // Both as Bridson chose them.
        constexpr double modified = 0.97; // the share of the factors' error that goes to the pivots
        constexpr double safe = 0.25;     // a pivot below this part of its diagonal is replaced by the diagonal
        for (std::size_t i = 0; i < rows_.size(); ++i) {
            double pivot = rows_[i].diagonal;
            for (const std::uint32_t j : rows_[i].below) {
                if (j == rows_.size()) continue;
                int others = -1;
                for (const std::uint32_t k : rows_[j].above) others += k != rows_.size();
                pivot -= (1 + modified * others) * pivots_[j];
            }
            pivots_[i] = 1 / (pivot < safe * rows_[i].diagonal ? rows_[i].diagonal : pivot);
        }
    }

    /// Replaces the given sides by the solutions, by conjugate gradients.
    /// \pre `sides` has one more element than there are rows, and it is zero
    /// \throw Cancelled
    void solve(std::vector<Lanes>& sides, Interrupter* interrupter) const
    {
        // The energy of the error. Values are off by up to its root times the width of the cage in voxels.
        constexpr double enough = 1e-26;
        const std::size_t count = rows_.size();
        std::vector<Lanes> solution(count + 1), image(count + 1), direction(count + 1);
        std::vector<Lanes>& residual = sides;
        Lanes energy{}; // of each lane's error, roughly
        // Except for rounding it takes no more steps than there are rows.
        for (std::size_t step = 0; step < count + 100; ++step) {
            throwIfInterrupted(interrupter);
            const Lanes before = std::exchange(energy, precondition(residual, image));
            bool done = true;
            forEachLane([&](std::size_t l) { done = done && energy[l] <= enough; });
            if (done) break;
            Lanes growth{};
            forEachLane([&](std::size_t l) { growth[l] = before[l] > 0 ? energy[l] / before[l] : 0; });
            for (std::size_t i = 0; i < count; ++i) {
                forEachLane([&](std::size_t l) { direction[i][l] = image[i][l] + growth[l] * direction[i][l]; });
            }
            const Lanes square = apply(direction, image);
            Lanes length{}; // a lane stays when its solution is found
            forEachLane([&](std::size_t l) { length[l] = energy[l] > enough ? energy[l] / square[l] : 0; });
            for (std::size_t i = 0; i < count; ++i) {
                forEachLane([&](std::size_t l) { solution[i][l] += length[l] * direction[i][l]; });
                forEachLane([&](std::size_t l) { residual[i][l] -= length[l] * image[i][l]; });
            }
        }
        sides.swap(solution);
    }

private:
    /// Sets `image` to the matrix times `vector`. Returns their product.
    Lanes apply(const std::vector<Lanes>& vector, std::vector<Lanes>& image) const
    {
        Lanes product{};
        for (std::size_t i = 0; i < rows_.size(); ++i) {
            const Row& row = rows_[i];
            Lanes sum{};
            for (std::size_t a = 0; a < 3; ++a) {
                const Lanes &below = vector[row.below[a]], &above = vector[row.above[a]];
                forEachLane([&](std::size_t l) { sum[l] += below[l] + above[l]; });
            }
            forEachLane([&](std::size_t l) {
                image[i][l] = row.diagonal * vector[i][l] - sum[l];
                product[l] += vector[i][l] * image[i][l];
            });
        }
        return product;
    }

    /// Sets `image` to the inverse of the incomplete factors times `vector`. Returns their product.
    Lanes precondition(const std::vector<Lanes>& vector, std::vector<Lanes>& image) const
    {
        Lanes product{};
        for (std::size_t i = 0; i < rows_.size(); ++i) {
            Lanes sum = vector[i];
            for (const std::uint32_t j : rows_[i].below) {
                forEachLane([&](std::size_t l) { sum[l] += image[j][l]; });
            }
            forEachLane([&](std::size_t l) { image[i][l] = pivots_[i] * sum[l]; });
        }
        for (std::size_t i = rows_.size(); i-- > 0;) {
            Lanes sum{};
            for (const std::uint32_t j : rows_[i].above) {
                forEachLane([&](std::size_t l) { sum[l] += image[j][l]; });
            }
            forEachLane([&](std::size_t l) {
                image[i][l] += pivots_[i] * sum[l];
                product[l] += vector[i][l] * image[i][l];
            });
        }
        return product;
    }

    std::vector<Row> rows_;
    std::vector<double> pivots_; ///< one over each
};

double determinant(const Vec3d& a, const Vec3d& b, const Vec3d& c)
{
    return a.dot(b.cross(c));
}

/// Returns a face's part of the winding number around the origin.
double windingOf(const PatchCorners& c, bool quad)
{
    const double m3 = determinant(c[0], c[1], c[2]);
    double winding = halfSolidAngle(c[0], c[1], c[2], m3) / (2 * pi);
    if (!quad) return winding;
    const double m1 = determinant(c[0], c[2], c[3]);
    winding += halfSolidAngle(c[0], c[2], c[3], m1) / (2 * pi);
    // On the patch, products of opposite corners' barycentric coordinates in the tetrahedron of its corners are equal.
    // Between the patch and its two triangles the product of corners 0 and 2 is the greater one.
    const double m0 = determinant(c[1], c[2], c[3]), m2 = determinant(c[0], c[1], c[3]);
    if (m0 * m2 > m1 * m3) {
        if (m0 > 0 && m1 < 0 && m2 > 0 && m3 < 0) winding += 1;
        if (m0 < 0 && m1 > 0 && m2 < 0 && m3 > 0) winding -= 1;
    }
    return winding;
}

/// Calls `take` with the corners' weights of each point of a face that the line through the origin along the axis
/// meets. It may call it for points beside the line, too.
template <typename Take>
void forEachCandidate(const PatchCorners& c, bool quad, int axis, const Take& take)
{
    const int a = (axis + 1) % 3, b = (axis + 2) % 3;
    const auto cross = [&](const Vec3d& p, const Vec3d& q) { return p[a] * q[b] - p[b] * q[a]; };
    if (!quad) {
        const double area = cross(c[1] - c[0], c[2] - c[0]);
        const double w0 = std::clamp(cross(c[1], c[2]) / area, 0.0, 1.0);
        const double w1 = std::clamp(cross(c[2], c[0]) / area, 0.0, 1 - w0);
        take(std::array<double, 4>{w0, w1, 1 - w0 - w1, 0});
        return;
    }
    // The point is c[0] + u first + v last + u v twist: without u a quadratic equation of v.
    const Vec3d first = c[1] - c[0], last = c[3] - c[0], twist = c[2] - c[1] - last;
    const double square = cross(twist, last), linear = cross(first, last) + cross(twist, c[0]);
    const double constant = cross(first, c[0]);
    const double discriminant = linear * linear - 4 * square * constant;
    if (!(discriminant >= 0)) return;
    const double larger = -0.5 * (linear + std::copysign(std::sqrt(discriminant), linear));
    for (const double root : {larger / square, constant / larger}) {
        const double v = std::clamp(root, 0.0, 1.0);
        const Vec3d from = c[0] + v * last, along = first + v * twist;
        const double length = along[a] * along[a] + along[b] * along[b];
        const double u = std::clamp(-(from[a] * along[a] + from[b] * along[b]) / length, 0.0, 1.0);
        take(std::array<double, 4>{(1 - u) * (1 - v), u * (1 - v), u * v, (1 - u) * v});
    }
}

} // namespace

HarmonicGrid::HarmonicGrid(const UnitCage& cage, int resolution, Interrupter* interrupter)
    : cage_(cage), scale_(resolution)
{
    requireWithin(CoordinateOptions::resolutions, resolution, "resolution");
    openvdb::BBoxd box;
    for (const UnitCage::Face& face : cage.faces()) {
        for (const openvdb::Index32 i : face.at) box.expand(cage.points()[i]);
    }
    // Sides of the box are half a voxel from nodes, those of the longest side exactly.
    shift_ = Vec3d(0.5) - scale_ * box.min();
    size_ = Coord::floor(inVoxels(box.max()) + Vec3d(nearest)).offsetBy(2);
    for (const UnitCage::Face& face : cage.faces()) {
        PatchCorners corners;
        for (std::size_t i = 0; i < 4; ++i) corners[i] = inVoxels(cage.points()[face.at[i]]);
        faces_.push_back({corners, face.quad});
    }
    sortFacesIntoCells();
    solve(findNodesInside(interrupter), interrupter);
}

std::uint32_t HarmonicGrid::numberOf(const Coord& node) const
{
    return static_cast<std::uint32_t>((node.z() * size_.y() + node.y()) * size_.x() + node.x());
}

void HarmonicGrid::sortFacesIntoCells()
{
    for (std::uint32_t face = 0; face < faces_.size(); ++face) {
        const PatchCorners& c = faces_[face].corners;
        openvdb::BBoxd box;
        for (const Vec3d& corner : c) box.expand(corner);
        const Vec3d normal = (c[2] - c[0]).cross(c[3] - c[1]);
        double low = normal.dot(c[0]), high = low; // the face is between two planes
        for (const Vec3d& corner : c) {
            low = std::min(low, normal.dot(corner));
            high = std::max(high, normal.dot(corner));
        }
        const double radius = (0.5 + nearest) * (std::abs(normal[0]) + std::abs(normal[1]) + std::abs(normal[2]));
        const openvdb::CoordBBox cells(Coord::floor(box.min() - Vec3d(nearest)),
                                       Coord::floor(box.max() + Vec3d(nearest)));
        for (const Coord& cell : cells) {
            const double middle = normal.dot(cell.asVec3d() + Vec3d(0.5));
            if (middle + radius >= low && middle - radius <= high) cellFaces_.push_back({numberOf(cell), face});
        }
    }
    std::sort(cellFaces_.begin(), cellFaces_.end());
}

HarmonicGrid::CellFaces HarmonicGrid::facesOf(const Coord& cell) const
{
    const std::uint32_t number = numberOf(cell);
    const auto first = std::lower_bound(cellFaces_.begin(), cellFaces_.end(), CellFace{number, 0});
    auto last = first;
    while (last != cellFaces_.end() && last->cell == number) ++last;
    return {cellFaces_.data() + (first - cellFaces_.begin()), cellFaces_.data() + (last - cellFaces_.begin())};
}

bool HarmonicGrid::isInside(const Vec3d& at) const
{
    double winding = 0;
    for (const Face& face : faces_) {
        PatchCorners corners = face.corners;
        for (Vec3d& corner : corners) corner -= at;
        winding += windingOf(corners, face.quad);
    }
    return winding > 0.5;
}

std::vector<Coord> HarmonicGrid::findNodesInside(Interrupter* interrupter)
{
    numbers_.assign(static_cast<std::size_t>(size_.x()) * static_cast<std::size_t>(size_.y()) *
                        static_cast<std::size_t>(size_.z()),
                    none);
    parallelFor(0, size_.y() * size_.z(), [&](int line) {
        throwIfInterrupted(interrupter);
        bool inside = false;
        for (Coord node(0, line % size_.y(), line / size_.y()); node.x() < size_.x(); ++node.x()) {
            if (node.x() > 0) {
                const Coord cell = node.offsetBy(-1, 0, 0);
                const CellFaces faces = facesOf(cell);
                const bool cut = firstCrossing(faces, cell.asVec3d(), 0, true, 1).face != none;
                if (cut) inside = isInside(node.asVec3d());
            }
            if (inside) numbers_[numberOf(node)] = 0;
        }
    });
    std::vector<Coord> nodes;
    for (const Coord& node : openvdb::CoordBBox(Coord(0), size_.offsetBy(-1))) {
        std::uint32_t& number = numbers_[numberOf(node)];
        if (number == none) continue;
        number = static_cast<std::uint32_t>(nodes.size());
        nodes.push_back(node);
    }
    return nodes;
}

HarmonicGrid::Crossing HarmonicGrid::firstCrossing(const CellFaces& faces, const Vec3d& at, int axis, bool upward,
                                                   double reach) const
{
    const int a = (axis + 1) % 3, b = (axis + 2) % 3;
    Crossing first{reach, none, {}};
    double farthest = reach + nearest;
    for (const CellFace& entry : faces) {
        const Face& face = faces_[entry.face];
        PatchCorners c = face.corners;
        for (Vec3d& corner : c) corner -= at;
        forEachCandidate(c, face.quad, axis, [&](const std::array<double, 4>& weights) {
            Vec3d place(0);
            for (std::size_t i = 0; i < 4; ++i) place += weights[i] * c[i];
            const double distance = upward ? place[axis] : -place[axis];
            const bool meets = std::max(std::abs(place[a]), std::abs(place[b])) <= nearest; // false for NaN
            if (!meets || !(distance >= -nearest && distance < farthest)) return;
            farthest = distance;
            first = {std::clamp(distance, nearest, reach), entry.face, weights};
        });
    }
    return first;
}

void HarmonicGrid::solve(const std::vector<Coord>& nodes, Interrupter* interrupter)
{
    struct BoundaryValue {
        std::uint32_t row;
        openvdb::Index32 point;
        double value;
    };
    std::vector<BoundaryValue> boundaryValues;
    std::vector<GridLaplacian::Row> rows;
    const auto count = static_cast<std::uint32_t>(nodes.size());
    for (std::uint32_t i = 0; i < count; ++i) {
        if (i % 4096 == 0) throwIfInterrupted(interrupter);
        GridLaplacian::Row row{{count, count, count}, {count, count, count}, 0};
        for (int axis = 0; axis < 3; ++axis) {
            for (const bool upward : {false, true}) {
                Coord neighbour = nodes[i];
                neighbour[std::size_t(axis)] += upward ? 1 : -1;
                const CellFaces faces = facesOf(upward ? nodes[i] : neighbour);
                Crossing end = firstCrossing(faces, nodes[i].asVec3d(), axis, upward, 1);
                if (end.face == none) {
                    const std::uint32_t number = numbers_[numberOf(neighbour)];
                    if (number != none) {
                        (upward ? row.above : row.below)[std::size_t(axis)] = number;
                        row.diagonal += 1;
                        continue;
                    }
                    const UnitCage::Place place = nearestTo(neighbour);
                    end = {1, static_cast<std::uint32_t>(place.face), place.weights};
                }
                const double factor = 1 / end.distance;
                row.diagonal += factor;
                for (std::size_t k = 0; k < 4; ++k) {
                    boundaryValues.push_back({i, cage_.faces()[end.face].at[k], factor * end.weights[k]});
                }
            }
        }
        rows.push_back(row);
    }
    const GridLaplacian laplacian(std::move(rows));
    const std::size_t columns = cage_.points().size();
    values_.resize(nodes.size() * columns);
    parallelFor(std::size_t(0), (columns + laneCount - 1) / laneCount, [&](std::size_t block) {
        const std::size_t from = block * laneCount, to = std::min(from + laneCount, columns);
        std::vector<Lanes> values(nodes.size() + 1);
        for (const BoundaryValue& given : boundaryValues) {
            if (given.point >= from && given.point < to) values[given.row][given.point - from] += given.value;
        }
        laplacian.solve(values, interrupter);
        for (std::size_t i = 0; i < nodes.size(); ++i) {
            for (std::size_t k = from; k < to; ++k) {
                values_[i * columns + k] = std::max(values[i][k - from], 0.0); // whatever rounding did
            }
        }
    });
}

UnitCage::Place HarmonicGrid::nearestTo(const Coord& node) const
{
    return cage_.nearest((node.asVec3d() - shift_) / scale_);
}

void HarmonicGrid::addPlace(std::size_t face, const std::array<double, 4>& weights, double share, double* row) const
{
    for (std::size_t i = 0; i < 4; ++i) row[cage_.faces()[face].at[i]] += share * weights[i];
}

void HarmonicGrid::addMean(const Coord& cell, const CellFaces& faces, const Vec3d& at, unsigned fixed, unsigned high,
                           double share, Mean& mean) const
{
    if (fixed == 7) {
        mean.nodes[high] += share;
        return;
    }
    Crossing ends[3][2];
    double weights[3] = {}, sum = 0;
    for (int axis = 0; axis < 3; ++axis) {
        if (fixed >> axis & 1) continue;
        for (const bool upward : {false, true}) {
            const double reach =
                std::max(upward ? cell[std::size_t(axis)] + 1 - at[axis] : at[axis] - cell[std::size_t(axis)], nearest);
            ends[axis][upward] = firstCrossing(faces, at, axis, upward, reach);
        }
        weights[axis] = 1 / (ends[axis][0].distance * ends[axis][1].distance);
        sum += weights[axis];
    }
    for (int axis = 0; axis < 3; ++axis) {
        if (fixed >> axis & 1) continue;
        const double both = ends[axis][0].distance + ends[axis][1].distance;
        for (const bool upward : {false, true}) {
            const Crossing& end = ends[axis][upward];
            const double part = share * weights[axis] / sum * ends[axis][!upward].distance / both;
            if (end.face != none) {
                addPlace(end.face, end.weights, part, mean.row);
                continue;
            }
            Vec3d there = at;
            there[axis] = cell[std::size_t(axis)] + int(upward);
            addMean(cell, faces, there, fixed | 1U << axis, high | unsigned(upward) << axis, part, mean);
        }
    }
}

bool HarmonicGrid::row(const Vec3d& x, double* row) const
{
    const std::size_t columns = cage_.points().size();
    std::fill(row, row + columns, 0.0);
    const Vec3d at = inVoxels(x);
    for (int a = 0; a < 3; ++a) {
        if (!(at[a] >= 0 && at[a] < size_[std::size_t(a)] - 1)) return false;
    }
    const Coord cell = Coord::floor(at);
    const CellFaces faces = facesOf(cell);
    for (const CellFace& entry : faces) {
        const UnitCage::Place place = cage_.nearestOf(entry.face, x);
        if (place.distance > UnitCage::touching) continue;
        addPlace(entry.face, place.weights, 1, row);
        return true;
    }
    const bool inside = faces.empty() ? numbers_[numberOf(cell)] != none : isInside(at);
    if (!inside) return false;
    Mean mean{{}, row};
    addMean(cell, faces, at, 0, 0, 1, mean);
    double sum = 0;
    for (unsigned corner = 0; corner < 8; ++corner) {
        if (mean.nodes[corner] == 0) continue;
        const Coord node = cell.offsetBy(corner & 1, corner >> 1 & 1, corner >> 2);
        const std::uint32_t number = numbers_[numberOf(node)];
        if (number == none) {
            const UnitCage::Place place = nearestTo(node);
            addPlace(place.face, place.weights, mean.nodes[corner], row);
            continue;
        }
        const double* const values = values_.data() + number * columns;
        for (std::size_t k = 0; k < columns; ++k) row[k] += mean.nodes[corner] * values[k];
    }
    for (std::size_t k = 0; k < columns; ++k) sum += row[k];
    for (std::size_t k = 0; k < columns; ++k) row[k] /= sum;
    return true;
}

namespace {

CageRows gridRows(const UnitCage& cage, const CoordinateOptions& options, Interrupter* interrupter)
{
    const auto grid = std::make_shared<const HarmonicGrid>(cage, options.resolution, interrupter);
    return {[grid](const Vec3d& x, double* row) { return grid->row(x, row); }};
}

constexpr FamilyInfo info{Coordinates::harmonic,
                          "harmonic",
                          "harmonic",
                          "Harmonic",
                          "never negative, smooth, not through walls",
                          "Joshi, Meyer, DeRose, Green, Sanocki 2007",
                          /*isEverywhere*/ false,
                          /*splitsQuads*/ false,
                          /*hasResolution*/ true,
                          /*hasElasticity*/ false};

} // namespace

extern constexpr CoordinateFamily harmonic{info, gridRows};

} // namespace vdbcage::detail
