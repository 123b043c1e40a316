// Based on: the papers of each family, see detail/.
// Differs: a pose adds what the handles moved by to the rest pose, instead of summing up their positions. So single
// precision suffices, the rest pose is exact, and handles that do not move cost nothing.

#include <vdbcage/deform/binding.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <vdbcage/core/error.h>
#include <vdbcage/deform/detail/bound_cage.h>
#include <vdbcage/deform/detail/green.h>
#include <vdbcage/deform/detail/likelihood.h>
#include <vdbcage/deform/detail/mean_value.h>
#include <vdbcage/mesh/detail/number_text.h>

namespace vdbcage {

using openvdb::Vec3d;

namespace {

struct Family {
    Coordinates family;
    const char* name;
    const char* nameOnQuads;
    bool (*row)(const detail::BoundCage&, const Vec3d&, double*);
};

constexpr std::array<Family, 3> families{{{Coordinates::meanValue, "mvc", "qmvc", detail::meanValueRow},
                                          {Coordinates::green, "green", "qgc", detail::greenRow},
                                          {Coordinates::likelihood, "mlc", "mlc", detail::likelihoodRow}}};

const Family& entry(Coordinates family)
{
    return families[static_cast<std::size_t>(family)];
}

bool isFinite(const Vec3d& p)
{
    return std::isfinite(p.x()) && std::isfinite(p.y()) && std::isfinite(p.z());
}

std::string text(const Vec3d& p)
{
    return "(" + detail::numberText(p.x()) + ", " + detail::numberText(p.y()) + ", " + detail::numberText(p.z()) + ")";
}

void requireFinite(const std::vector<Vec3d>& points, const char* what)
{
    for (std::size_t i = 0; i < points.size(); ++i) {
        if (!isFinite(points[i])) {
            throw InputError(std::string(what) + ": point " + std::to_string(i) + " is " + text(points[i]) +
                             "; coordinates must be finite");
        }
    }
}

void requireCount(const char* what, std::size_t count, std::size_t needed, const char* of)
{
    if (count != needed) {
        throw InputError(std::string(what) + ": it has " + std::to_string(count) + " points; " + of + " has " +
                         std::to_string(needed));
    }
}

std::size_t handleCount(const Mesh& cage, Coordinates family)
{
    return cage.points.size() +
           (family == Coordinates::green ? cage.triangles.size() + 4 * cage.quads.size() : std::size_t(0));
}

/// Computes the rows in parallel, in pieces; `take` gets the number of each row and the row, any order.
template <typename Take>
void forEachRow(const Mesh& mesh, const std::vector<Vec3d>& points, Coordinates family, Interrupter* interrupter,
                const Take& take)
{
    const Stage stage(interrupter, "bind");
    requireFinite(points, "points");
    const detail::BoundCage cage(mesh);
    const std::size_t columns = handleCount(mesh, family);
    std::vector<char> undefined(points.size(), 0);
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, points.size(), 16), [&](const auto& range) {
        throwIfInterrupted(interrupter);
        std::vector<double> row(columns);
        for (std::size_t i = range.begin(); i < range.end(); ++i) {
            const Vec3d x = cage.scaled(points[i]);
            const bool defined = isFinite(x) && entry(family).row(cage, x, row.data()) &&
                                 std::all_of(row.begin(), row.end(), [](double w) { return std::isfinite(w); });
            if (defined) {
                take(i, row);
            } else {
                undefined[i] = 1;
            }
        }
    });
    const auto first = std::find(undefined.begin(), undefined.end(), 1);
    if (first == undefined.end()) return;
    const auto index = static_cast<std::size_t>(first - undefined.begin());
    throw InputError("points: point " + std::to_string(index) + " at " + text(points[index]) + " and " +
                     std::to_string(std::count(first, undefined.end(), 1) - 1) + " others have no " +
                     entry(family).name + " coordinates in this cage; " +
                     (family == Coordinates::meanValue ? "they are too far away" : "all must be inside of it"));
}

// Points of a block are side by side, so that one weight's worth of work is the same for all of them.
constexpr std::size_t blockSize = 16;
// Posing is as fast as weights come from memory, and processors by themselves do not look ahead far enough: weights are
// asked for this many moves before their turn, which takes four tenths off the time (AMD Zen).
constexpr std::size_t movesAhead = 24;

std::size_t blocksOf(std::size_t points)
{
    return (points + blockSize - 1) / blockSize;
}

/// Where handle 0 of point `i` is; the next handle is blockSize further.
std::size_t blockOffset(std::size_t i, std::size_t handles)
{
    return i / blockSize * blockSize * handles + i % blockSize;
}

} // namespace

const char* coordinatesName(Coordinates family)
{
    return entry(family).name;
}

Coordinates coordinatesNamed(const std::string& name)
{
    std::string known;
    for (const Family& family : families) {
        if (name == family.name || name == family.nameOnQuads) return family.family;
        known += (known.empty() ? "" : ", ") + std::string(family.name);
    }
    throw InputError("coordinates: '" + name + "' is not a family; there are " + known);
}

std::vector<Vec3d> cageHandles(const Mesh& cage, const std::vector<Vec3d>& posed, Coordinates family)
{
    requireCount("posed cage", posed.size(), cage.points.size(), "the cage");
    requireFinite(posed, "posed cage");
    std::vector<Vec3d> handles = posed;
    if (family != Coordinates::green) return handles;
    handles.reserve(handleCount(cage, family));
    const double size = detail::CageFrame(cage).size;
    const auto addNormal = [&](openvdb::Index32 corner, openvdb::Index32 next, openvdb::Index32 before) {
        const auto edge = [&](const std::vector<Vec3d>& points, openvdb::Index32 to) {
            return points[to] / size - points[corner] / size;
        };
        handles.push_back(size * detail::stretchedNormal(edge(cage.points, next), edge(cage.points, before),
                                                         edge(posed, next), edge(posed, before)));
    };
    for (const openvdb::Vec3I& t : cage.triangles) addNormal(t[0], t[1], t[2]);
    for (const openvdb::Vec4I& q : cage.quads) {
        for (int k = 0; k < 4; ++k) addNormal(q[k], q[(k + 1) % 4], q[(k + 3) % 4]);
    }
    return handles;
}

std::vector<double> computeCoordinates(const Mesh& cage, const std::vector<Vec3d>& points, Coordinates family,
                                       Interrupter* interrupter)
{
    const std::size_t columns = handleCount(cage, family);
    std::vector<double> coordinates(points.size() * columns);
    forEachRow(cage, points, family, interrupter, [&](std::size_t i, const std::vector<double>& row) {
        std::copy(row.begin(), row.end(), coordinates.begin() + static_cast<std::ptrdiff_t>(i * columns));
    });
    return coordinates;
}

Binding::Binding(const Mesh& cage, std::vector<Vec3d> points, Coordinates family, Interrupter* interrupter)
    : cage_(cage), points_(std::move(points)), family_(family)
{
    blocks_.resize(blocksOf(points_.size()) * blockSize * handleCount(cage, family));
    forEachRow(cage, points_, family, interrupter, [&](std::size_t i, const std::vector<double>& row) {
        float* to = blocks_.data() + blockOffset(i, row.size());
        for (std::size_t k = 0; k < row.size(); ++k) to[k * blockSize] = static_cast<float>(row[k]);
    });
    restHandles_ = cageHandles(cage, cage.points, family);
}

Binding::Binding(const Mesh& cage, std::vector<Vec3d> points, Coordinates family, const std::vector<float>& weights)
    : cage_(cage), points_(std::move(points)), family_(family)
{
    requireUsable(cage, "cage");
    restHandles_ = cageHandles(cage, cage.points, family);
    if (weights.size() != points_.size() * handles()) {
        throw InputError("weights: there are " + std::to_string(weights.size()) + "; " +
                         std::to_string(points_.size()) + " points and " + std::to_string(handles()) +
                         " handles need " + std::to_string(points_.size() * handles()));
    }
    blocks_.resize(blocksOf(points_.size()) * blockSize * handles());
    for (std::size_t i = 0; i < points_.size(); ++i) {
        float* to = blocks_.data() + blockOffset(i, handles());
        for (std::size_t k = 0; k < handles(); ++k) to[k * blockSize] = weights[i * handles() + k];
    }
}

std::vector<float> Binding::weights() const
{
    std::vector<float> weights;
    weights.reserve(points_.size() * handles());
    for (std::size_t i = 0; i < points_.size(); ++i) {
        const float* from = blocks_.data() + blockOffset(i, handles());
        for (std::size_t k = 0; k < handles(); ++k) weights.push_back(from[k * blockSize]);
    }
    return weights;
}

std::vector<Vec3d> Binding::pose(const std::vector<Vec3d>& cagePoints) const
{
    std::vector<Vec3d> posed = points_;
    add(restHandles_, cageHandles(cage_, cagePoints, family_), posed);
    return posed;
}

void Binding::update(std::vector<Vec3d>& posed, const std::vector<Vec3d>& from, const std::vector<Vec3d>& to) const
{
    requireCount("posed points", posed.size(), points_.size(), "the binding");
    add(cageHandles(cage_, from, family_), cageHandles(cage_, to, family_), posed);
}

void Binding::add(const std::vector<Vec3d>& fromHandles, const std::vector<Vec3d>& toHandles,
                  std::vector<Vec3d>& posed) const
{
    struct Move {
        std::size_t handle;
        float x, y, z;
        std::size_t ahead = 0; // bytes from its weights to those of movesAhead later, in this block or one behind
    };
    // In units of the cage: floats hold the motion of models of any size.
    const double size = detail::CageFrame(cage_).size;
    std::vector<Move> moves;
    for (std::size_t k = 0; k < toHandles.size(); ++k) {
        if (fromHandles[k] == toHandles[k]) continue;
        const Vec3d move = (toHandles[k] - fromHandles[k]) / size;
        moves.push_back({k, static_cast<float>(move.x()), static_cast<float>(move.y()), static_cast<float>(move.z())});
    }
    if (moves.empty()) return;
    for (std::size_t m = 0; m < moves.size(); ++m) {
        const std::size_t later = m + movesAhead, block = later / moves.size();
        const std::size_t handle = block * handles() + moves[later % moves.size()].handle;
        moves[m].ahead = (handle - moves[m].handle) * blockSize * sizeof(float);
    }
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, blocksOf(posed.size()), 16), [&](const auto& range) {
        for (std::size_t block = range.begin(); block < range.end(); ++block) {
            const float* weights = blocks_.data() + block * blockSize * handles();
            float sumX[blockSize] = {}, sumY[blockSize] = {}, sumZ[blockSize] = {};
            for (const Move& move : moves) {
                const float* weight = weights + move.handle * blockSize;
                // By a number, for it may lie behind the last block.
                __builtin_prefetch(
                    reinterpret_cast<const void*>(reinterpret_cast<std::uintptr_t>(weight) + move.ahead));
                for (std::size_t i = 0; i < blockSize; ++i) {
                    sumX[i] += weight[i] * move.x;
                    sumY[i] += weight[i] * move.y;
                    sumZ[i] += weight[i] * move.z;
                }
            }
            const std::size_t first = block * blockSize, count = std::min(blockSize, posed.size() - first);
            for (std::size_t i = 0; i < count; ++i) {
                posed[first + i] += size * Vec3d(double(sumX[i]), double(sumY[i]), double(sumZ[i]));
            }
        }
    });
}

} // namespace vdbcage
