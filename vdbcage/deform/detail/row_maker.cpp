#include <vdbcage/deform/detail/row_maker.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include <tbb/blocked_range.h>
#include <vdbcage/core/detail/parallel.h>
#include <vdbcage/core/error.h>
#include <vdbcage/deform/detail/point_checks.h>
#include <vdbcage/deform/detail/triangles.h>

namespace vdbcage::detail {

using openvdb::Vec3d;

namespace {

const CoordinateFamily& computable(Coordinates family)
{
    if (coordinateFamily(family).rowsIn != nullptr) return coordinateFamily(family);
    throw InputError("coordinates",
                     "'given' weights were made elsewhere and cannot be computed; there are " + familyNames());
}

/// Returns the cage in the form that a family takes.
Mesh cageFor(const CoordinateFamily& family, const Mesh& cage)
{
    if (!family.info.splitsQuads) return cage;
    requireUsable(cage, "cage");
    return {cage.points, triangulateByShorterDiagonal(cage), {}};
}

} // namespace

RowMaker::RowMaker(const Mesh& cage, const std::vector<Vec3d>& points, const CoordinateOptions& options,
                   Interrupter* interrupter)
    : points_(points), family_(computable(options.family)), interrupter_(interrupter),
      columns_(handleCount(cage, options.family)), cage_(cageFor(family_, cage)), kernelCage_(kernelCage(cage_)),
      looseMotion_(options.loose.motion), isLoose_(points.size(), false), undefined_(points.size(), 0)
{
    for (const openvdb::Index32 i : options.loose.indices) {
        if (i >= points.size()) {
            throw InputError("loose points", "there is no point " + std::to_string(i) + "; there are " +
                                                 std::to_string(points.size()) + " points, counted from 0");
        }
        isLoose_[i] = true;
    }
    requireFinite(points, "points");
    rows_ = family_.rowsIn(cage_, options, interrupter);
    meanValueRows_ = coordinateFamily(Coordinates::meanValue).rowsIn(cage_, options, interrupter);
}

template <typename Number>
void RowMaker::make(const std::uint32_t* indices, std::size_t count, Number* rows)
{
    constexpr std::size_t grain = 8 * packetSize; // large enough for the cost of its buffers
    parallelFor(tbb::blocked_range<std::size_t>(0, count, grain), [&](const auto& range) {
        const std::size_t chunks = scratchSize(*kernelCage_) / sizeof(Chunk) + 1;
        const Buffers buffers{std::make_unique<Packet[]>(columns_), std::unique_ptr<Chunk[]>(new Chunk[chunks])};
        for (std::size_t first = range.begin(); first < range.end(); first += packetSize) {
            const std::size_t lanes = std::min<std::size_t>(range.end() - first, packetSize);
            const auto pointOf = [&](std::size_t lane) {
                return indices != nullptr ? std::size_t{indices[first + lane]} : first + lane;
            };
            std::array<Vec3d, packetSize> places{};
            for (std::size_t lane = 0; lane < lanes; ++lane) {
                throwIfInterrupted(interrupter_);
                places[lane] = cage_.scaled(points_[pointOf(lane)]);
            }
            const unsigned undefined = makePacket(places.data(), lanes, buffers);
            Number* const packetRows = rows + first * columns_;
            Packet probe = {}; // not zero where the row is undefined, or a number of it not finite
            for (std::size_t lane = 0; lane < lanes; ++lane) probe[lane] = undefined >> lane & 1;
            for (std::size_t k = 0; k < columns_; ++k) {
                for (std::size_t lane = 0; lane < lanes; ++lane) {
                    const double weight = buffers.rows[k][lane];
                    probe[lane] += 0 * weight;
                    packetRows[lane * columns_ + k] = static_cast<Number>(weight);
                }
            }
            for (std::size_t lane = 0; lane < lanes; ++lane) {
                const std::size_t point = pointOf(lane);
                bool isDefined = probe[lane] == 0;
                if (isLoose_[point]) isDefined = makeLooseRow(places[lane], isDefined, packetRows + lane * columns_);
                if (!isDefined) undefined_[point] = 1;
            }
        }
    });
}
template void RowMaker::make(const std::uint32_t* indices, std::size_t count, float* rows);
template void RowMaker::make(const std::uint32_t* indices, std::size_t count, double* rows);

void RowMaker::requireDefined() const
{
    const auto first = std::find(undefined_.begin(), undefined_.end(), 1);
    if (first == undefined_.end()) return;
    const auto index = static_cast<std::size_t>(first - undefined_.begin());
    throw InputError(
        "points", std::string(family_.info.name) + " coordinates are not defined at " +
                      std::to_string(std::count(first, undefined_.end(), 1)) + " of " + std::to_string(points_.size()) +
                      " points, first at point " + std::to_string(index) + ", " + toText(points_[index]) + "; " +
                      (family_.info.isEverywhere ? "none may be so far away" : "all must be inside of the cage"));
}

/// Computes the rows of `count` points into the buffers. Returns a bit for each where the family is not defined.
unsigned RowMaker::makePacket(const Vec3d* points, std::size_t count, const Buffers& buffers) const
{
    if (rows_.several) return rows_.several(points, count, buffers.rows.get());
    unsigned leftOut = ~0U, undefined = 0;
    if (family_.kernel != nullptr) {
        leftOut = 0;
        Packet x[3] = {};
        for (std::size_t lane = 0; lane < count; ++lane) {
            if (!(points[lane].length() < tooFar)) {
                leftOut |= 1U << lane;
                continue;
            }
            for (int a = 0; a < 3; ++a) x[a][lane] = points[lane][a];
        }
        leftOut |= (rowKernels().*family_.kernel)(*kernelCage_, x, buffers.scratch.get(), buffers.rows.get());
    }
    std::vector<double> row;
    for (std::size_t lane = 0; lane < count; ++lane) {
        if ((leftOut >> lane & 1) == 0) continue;
        row.resize(columns_);
        if (!points[lane].isFinite() || !rows_.one(points[lane], row.data())) undefined |= 1U << lane;
        for (std::size_t k = 0; k < columns_; ++k) buffers.rows[k][lane] = row[k];
    }
    return undefined;
}

/// Makes the row of a loose point: that of the family where it is defined, unless the point stays. Mean value
/// coordinates are of the cage's points, the first handles of every family. Returns false where they are not defined.
template <typename Number>
bool RowMaker::makeLooseRow(const Vec3d& place, bool isDefined, Number* row) const
{
    const bool stays = looseMotion_ == LoosePoints::Motion::stay;
    if (isDefined && !stays) return true;
    std::fill_n(row, columns_, Number(0));
    if (stays) return true;
    std::vector<double> weights(cage_.points().size());
    if (place.isFinite()) meanValueRows_.one(place, weights.data());
    std::transform(weights.begin(), weights.end(), row, [](double weight) { return static_cast<Number>(weight); });
    return place.isFinite() && std::all_of(weights.begin(), weights.end(), [](double w) { return std::isfinite(w); });
}

} // namespace vdbcage::detail
