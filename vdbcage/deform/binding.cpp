// Based on: the papers of each family, see detail/.
// Differs: a pose adds what the handles moved by to the rest pose, instead of summing up their positions. So single
// precision suffices, the rest pose is exact, and the weights of handles that do not move are not read.

#include <vdbcage/deform/binding.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <utility>

#include <tbb/blocked_range.h>
#include <vdbcage/core/detail/number_text.h>
#include <vdbcage/core/detail/parallel.h>
#include <vdbcage/core/error.h>
#include <vdbcage/deform/detail/bound_cage.h>
#include <vdbcage/deform/detail/cage_pack.h>
#include <vdbcage/deform/detail/cage_triangles.h>
#include <vdbcage/deform/detail/families/biharmonic.h>
#include <vdbcage/deform/detail/families/green.h>
#include <vdbcage/deform/detail/families/harmonic.h>
#include <vdbcage/deform/detail/families/likelihood.h>
#include <vdbcage/deform/detail/families/mean_value.h>
#include <vdbcage/deform/detail/families/somigliana.h>
#include <vdbcage/deform/detail/kernels/row_kernels.h>
#include <vdbcage/deform/detail/weight_blocks.h>
#include <vdbcage/deform/detail/weight_matrix.h>

namespace vdbcage {

using openvdb::Vec3d;

namespace {

using detail::RowKernels;

/// How the rows of a family are computed.
struct RowFunctions {
    /// The row of a point; false where the family is not defined. Null if it needs more than the cage.
    bool (*row)(const detail::BoundCage&, const Vec3d&, double*);
    RowKernels::Rows* RowKernels::*rows; ///< of several points, but for those that are near the cage; null: one by one
};

struct Family {
    FamilyInfo info;
    RowFunctions functions;
};

constexpr std::array<Family, 6> families{
    {{{Coordinates::meanValue, "mvc", "qmvc", "Mean value", "smooth, and anywhere; can be negative",
       "Ju, Schaefer, Warren 2005; Thiery, Memari, Boubekeur 2018", true, false},
      {detail::meanValueRow, &RowKernels::meanValue}},
     {{Coordinates::green, "green", "qgc", "Green", "keeps shapes, follows the faces' normals",
       "Lipman, Levin, Cohen-Or 2008; Thiery, Boubekeur 2022", false, false},
      {detail::greenRow, &RowKernels::green}},
     {{Coordinates::maximumLikelihood, "mlc", "mlc", "Likelihood", "maximum likelihood: never negative, most local",
       "Chang, Deng, Hormann 2023", false, false},
      {detail::likelihoodRow, &RowKernels::likelihood}},
     {{Coordinates::harmonic, "harmonic", "harmonic", "Harmonic", "never negative, smooth, not through walls",
       "Joshi, Meyer, DeRose, Green, Sanocki 2007", false, false},
      {nullptr, nullptr}},
     {{Coordinates::biharmonic, "biharmonic", "biharmonic", "Biharmonic",
       "follows normals as green, closer to the cage", "Thiery, Michel, Chen 2024", false, true},
      {nullptr, nullptr}},
     {{Coordinates::somigliana, "somigliana", "somigliana", "Somigliana", "elastic: stretches most evenly",
       "Chen, de Goes, Desbrun 2023", false, true},
      {detail::somiglianaRow, &RowKernels::somigliana}}}};

const Family& entry(Coordinates family)
{
    return families[static_cast<std::size_t>(family)];
}

std::string familyNames()
{
    std::string names;
    for (const Family& family : families) names += (names.empty() ? "" : ", ") + std::string(family.info.name);
    return names;
}

const CoordinateOptions& requireComputable(const CoordinateOptions& options)
{
    if (options.family != Coordinates::given) return options;
    throw InputError("coordinates",
                     "'given' weights were made elsewhere and cannot be computed; there are " + familyNames());
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
            throw InputError(what,
                             "point " + std::to_string(i) + " is " + text(points[i]) + "; coordinates must be finite");
        }
    }
}

void requireCount(const char* what, std::size_t count, std::size_t needed, const char* of)
{
    if (count != needed) {
        throw InputError(what, "it has " + std::to_string(count) + " points; " + of + " has " + std::to_string(needed));
    }
}

/// The cage as a family takes it.
Mesh cageOf(const Mesh& cage, Coordinates family)
{
    if (!entry(family).info.splitsQuads) return cage;
    requireUsable(cage, "cage");
    return {cage.points, detail::cageTriangles(cage), {}};
}

/// Calls `take` with what each normal that is a handle belongs to, in their order: the corner, the next and the one
/// before.
template <typename Take>
void forEachNormal(const Mesh& cage, Coordinates family, const Take& take)
{
    if (family == Coordinates::biharmonic) {
        for (const openvdb::Vec3I& t : detail::cageTriangles(cage)) take(t[0], t[1], t[2]);
    }
    if (family != Coordinates::green) return;
    for (const openvdb::Vec3I& t : cage.triangles) take(t[0], t[1], t[2]);
    for (const openvdb::Vec4I& q : cage.quads) {
        for (int k = 0; k < 4; ++k) take(q[k], q[(k + 1) % 4], q[(k + 3) % 4]);
    }
}

/// Computes rows of coordinates, from any number of threads.
class RowMaker {
public:
    RowMaker(const Mesh& mesh, const std::vector<Vec3d>& points, const CoordinateOptions& options,
             Interrupter* interrupter)
        : points_(points), family_(entry(requireComputable(options).family)), interrupter_(interrupter),
          columns_(handleCount(mesh, options.family)), cage_(cageOf(mesh, options.family)), pack_(cage_),
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
        if (options.family == Coordinates::harmonic) grid_.emplace(cage_, options.resolution, interrupter);
        if (options.family == Coordinates::biharmonic) biharmonic_.emplace(cage_, interrupter);
    }

    /// Computes `count` rows in parallel, in pieces: those of the points `pointOf` 0, 1 and so on, one after the other.
    template <typename PointOf, typename Number>
    void make(std::size_t count, const PointOf& pointOf, Number* rows)
    {
        constexpr std::size_t grain = 8 * detail::packetSize; // its buffers are worth it
        detail::parallelFor(tbb::blocked_range<std::size_t>(0, count, grain), [&](const auto& range) {
            const Buffers buffers{std::make_unique<Packet[]>(columns_), scratch()};
            for (std::size_t i = range.begin(); i < range.end(); i += detail::packetSize) {
                makePacket(i, std::min<std::size_t>(range.end() - i, detail::packetSize), pointOf, buffers, rows);
            }
        });
    }

    /// \throw InputError a row that was asked for is of a point where it is not defined
    void requireDefined() const
    {
        const auto first = std::find(undefined_.begin(), undefined_.end(), 1);
        if (first == undefined_.end()) return;
        const auto index = static_cast<std::size_t>(first - undefined_.begin());
        throw InputError(
            "points", std::string(family_.info.name) + " coordinates are not defined at " +
                          std::to_string(std::count(first, undefined_.end(), 1)) + " of " +
                          std::to_string(points_.size()) + " points, first at point " + std::to_string(index) + ", " +
                          text(points_[index]) + "; " +
                          (family_.info.isEverywhere ? "none may be so far away" : "all must be inside of the cage"));
    }

private:
    using Packet = double[detail::packetSize]; // a number of each point
    struct alignas(64) Chunk {
        std::byte bytes[64];
    };
    struct Buffers {
        std::unique_ptr<Packet[]> rows;
        std::unique_ptr<Chunk[]> scratch;
    };

    std::unique_ptr<Chunk[]> scratch() const // not set to zero: it is large
    {
        return std::unique_ptr<Chunk[]>(new Chunk[detail::scratchSize(pack_.packed()) / sizeof(Chunk) + 1]);
    }

    /// False where the family is not defined.
    bool computeRow(const Vec3d& at, double* row) const
    {
        if (!isFinite(at)) return false;
        return grid_ ? grid_->row(at, row) : family_.functions.row(cage_, at, row);
    }

    template <typename PointOf, typename Number>
    void makePacket(std::size_t first, std::size_t count, const PointOf& pointOf, const Buffers& buffers, Number* rows)
    {
        std::array<Vec3d, detail::packetSize> at{};
        Packet x[3] = {};
        unsigned leftOut = 0;
        for (std::size_t lane = 0; lane < count; ++lane) {
            throwIfInterrupted(interrupter_);
            at[lane] = cage_.scaled(points_[pointOf(first + lane)]);
            if (!(at[lane].length() < detail::tooFar)) {
                leftOut |= 1U << lane;
                continue;
            }
            for (int a = 0; a < 3; ++a) x[a][lane] = at[lane][a];
        }
        Packet probe = {}; // not zero where the row is undefined, or a number of it not finite
        if (biharmonic_) {
            const unsigned outside = biharmonic_->rows(at.data(), count, buffers.rows.get());
            for (std::size_t lane = 0; lane < count; ++lane) probe[lane] = outside >> lane & 1;
            leftOut = 0;
        } else if (const auto kernel = family_.functions.rows) {
            leftOut |= (detail::rowKernels().*kernel)(pack_.packed(), x, buffers.scratch.get(), buffers.rows.get());
        } else {
            leftOut = ~0U;
        }
        std::vector<double> row;
        for (std::size_t lane = 0; lane < count; ++lane) {
            if ((leftOut >> lane & 1) == 0) continue;
            row.resize(columns_);
            if (!computeRow(at[lane], row.data())) probe[lane] = 1;
            for (std::size_t k = 0; k < columns_; ++k) buffers.rows[k][lane] = row[k];
        }
        Number* const to = rows + first * columns_;
        for (std::size_t k = 0; k < columns_; ++k) {
            for (std::size_t lane = 0; lane < count; ++lane) {
                const double weight = buffers.rows[k][lane];
                probe[lane] += 0 * weight;
                to[lane * columns_ + k] = static_cast<Number>(weight);
            }
        }
        for (std::size_t lane = 0; lane < count; ++lane) {
            const std::size_t point = pointOf(first + lane);
            const bool isDefined = probe[lane] == 0;
            if (isLoose_[point]) {
                if (!moveLoosely(at[lane], isDefined, to + lane * columns_)) undefined_[point] = 1;
            } else if (!isDefined) {
                undefined_[point] = 1;
            }
        }
    }

    /// Makes the row of a loose point, which has that of the family where it is defined. Mean value coordinates are of
    /// the cage's points, the first handles of every family. False where they are not defined.
    template <typename Number>
    bool moveLoosely(const Vec3d& at, bool isDefined, Number* row) const
    {
        const bool stays = looseMotion_ == LoosePoints::Motion::stay;
        if (isDefined && !stays) return true;
        std::fill_n(row, columns_, Number(0));
        if (stays) return true;
        std::vector<double> weights(cage_.points().size());
        if (isFinite(at)) detail::meanValueRow(cage_, at, weights.data());
        std::transform(weights.begin(), weights.end(), row, [](double weight) { return static_cast<Number>(weight); });
        return isFinite(at) && std::all_of(weights.begin(), weights.end(), [](double w) { return std::isfinite(w); });
    }

    const std::vector<Vec3d>& points_;
    const Family& family_;
    Interrupter* interrupter_;
    std::size_t columns_;
    detail::BoundCage cage_;
    detail::CagePack pack_;
    LoosePoints::Motion looseMotion_;
    std::vector<bool> isLoose_;
    std::optional<detail::HarmonicGrid> grid_;         // of harmonic coordinates
    std::optional<detail::BiharmonicCage> biharmonic_; // of biharmonic ones
    std::vector<char> undefined_;
};

template <typename Number>
std::vector<Number> computeRows(const Mesh& cage, const std::vector<Vec3d>& points, const CoordinateOptions& options,
                                Interrupter* interrupter)
{
    const Stage stage(interrupter, StageName::bind);
    RowMaker maker(cage, points, options, interrupter);
    std::vector<Number> rows;
    const std::size_t count = points.size() * handleCount(cage, options.family);
    rows.reserve(count);
    while (rows.size() < count) { // getting gigabytes takes seconds
        throwIfInterrupted(interrupter);
        rows.resize(std::min(count, rows.size() + (1U << 22)));
    }
    maker.make(
        points.size(), [](std::size_t i) { return i; }, rows.data());
    maker.requireDefined();
    return rows;
}

/// How far handles go, in units of the cage: its points as far as it is large, and normals, which stretch with their
/// edges, as far as these would let them. Those of Somigliana coordinates about as far as they are long at rest.
std::vector<float> maxDistancesOf(const Mesh& cage, Coordinates family)
{
    std::vector<float> maxDistances(cage.points.size(), 1.0F);
    if (family == Coordinates::somigliana) maxDistances.resize(handleCount(cage, family), 4.0F);
    if (maxDistances.size() == handleCount(cage, family)) return maxDistances;
    const double size = detail::CageFrame(cage).size;
    const auto addNormal = [&](openvdb::Index32 corner, openvdb::Index32 next, openvdb::Index32 before) {
        const auto edge = [&](openvdb::Index32 to) {
            return (cage.points[to] / size - cage.points[corner] / size).length();
        };
        // No less than the edges' product, and not zero if one of them is.
        const double mean = 0.5 * (edge(next) + edge(before));
        maxDistances.push_back(static_cast<float>(mean * mean));
    };
    forEachNormal(cage, family, addNormal);
    return maxDistances;
}

} // namespace

const std::vector<FamilyInfo>& coordinateFamilies()
{
    static const std::vector<FamilyInfo> all = [] {
        std::vector<FamilyInfo> list;
        for (const Family& family : families) list.push_back(family.info);
        return list;
    }();
    return all;
}

const char* coordinatesName(Coordinates family)
{
    return family == Coordinates::given ? "given" : entry(family).info.name;
}

void requireElasticity(const Elasticity& elasticity)
{
    if (!(elasticity.nu > -1 && elasticity.nu < 0.5)) {
        throw InputError("nu",
                         detail::numberText(elasticity.nu) + " is not allowed; it must be above -1 and below 0.5");
    }
    requireWithin(Elasticity::bulgings, elasticity.localBulging, "local bulging");
    requireWithin(Elasticity::bulgings, elasticity.globalBulging, "global bulging");
}

const char* rotationsName(Elasticity::Rotations rotations)
{
    return rotations == Elasticity::Rotations::global ? "global" : "local";
}

Elasticity::Rotations rotationsNamed(const std::string& name)
{
    for (const auto rotations : {Elasticity::Rotations::global, Elasticity::Rotations::local}) {
        if (name == rotationsName(rotations)) return rotations;
    }
    throw InputError("rotations", "'" + name + "' is not allowed; it must be global or local");
}

LoosePoints::Motion looseMotionNamed(const std::string& name)
{
    if (name == "ride") return LoosePoints::Motion::ride;
    if (name == "stay") return LoosePoints::Motion::stay;
    throw InputError("loose points", "'" + name + "' is not allowed; it must be ride or stay");
}

bool Elasticity::operator==(const Elasticity& other) const
{
    return nu == other.nu && rotations == other.rotations && localBulging == other.localBulging &&
           globalBulging == other.globalBulging;
}

Coordinates coordinatesNamed(const std::string& name)
{
    for (const FamilyInfo& family : coordinateFamilies()) {
        if (name == family.name || name == family.nameOnQuads) return family.family;
    }
    throw InputError("coordinates", "'" + name + "' is not a family; there are " + familyNames());
}

std::size_t handleCount(const Mesh& cage, Coordinates family)
{
    const std::size_t points = cage.points.size(), triangles = cage.triangles.size(), quads = cage.quads.size();
    switch (family) {
    case Coordinates::green:
        return points + triangles + 4 * quads;
    case Coordinates::biharmonic:
        return points + triangles + 2 * quads;
    case Coordinates::somigliana:
        return points + detail::somiglianaWeights * (triangles + 2 * quads);
    default:
        return points;
    }
}

std::vector<Vec3d> cageHandles(const Mesh& cage, const std::vector<Vec3d>& posed, const CoordinateOptions& options)
{
    requireCount("posed cage", posed.size(), cage.points.size(), "the cage");
    requireFinite(posed, "posed cage");
    std::vector<Vec3d> handles = posed;
    handles.reserve(handleCount(cage, options.family));
    if (options.family == Coordinates::somigliana) {
        requireElasticity(options.elasticity);
        detail::addSomiglianaHandles(cage, posed, options.elasticity, handles);
    }
    if (handles.size() == handleCount(cage, options.family)) return handles; // there are no normals
    const double size = detail::CageFrame(cage).size;
    const auto addNormal = [&](openvdb::Index32 corner, openvdb::Index32 next, openvdb::Index32 before) {
        const auto edge = [&](const std::vector<Vec3d>& points, openvdb::Index32 to) {
            return points[to] / size - points[corner] / size;
        };
        handles.push_back(size * detail::stretchedNormal(edge(cage.points, next), edge(cage.points, before),
                                                         edge(posed, next), edge(posed, before)));
    };
    forEachNormal(cage, options.family, addNormal);
    return handles;
}

std::vector<double> computeCoordinates(const Mesh& cage, const std::vector<Vec3d>& points,
                                       const CoordinateOptions& options, Interrupter* interrupter)
{
    return computeRows<double>(cage, points, options, interrupter);
}

std::vector<float> computeWeights(const Mesh& cage, const std::vector<Vec3d>& points, const CoordinateOptions& options,
                                  Interrupter* interrupter)
{
    return computeRows<float>(cage, points, options, interrupter);
}

Binding::Binding(const Mesh& cage, std::vector<Vec3d> points, const CoordinateOptions& options,
                 Interrupter* interrupter)
    : cage_(cage), points_(std::move(points)), options_(options)
{
    const Stage stage(interrupter, StageName::bind);
    RowMaker maker(cage_, points_, options_, interrupter);
    restHandles_ = cageHandles(cage_, cage_.points, options_);
    weights_ = std::make_shared<detail::WeightBlocks>(
        points_, maxDistancesOf(cage_, family()),
        [&](const std::vector<std::uint32_t>& block, std::vector<float>& rows) {
            maker.make(
                block.size(), [&](std::size_t i) { return block[i]; }, rows.data());
        },
        interrupter);
    maker.requireDefined();
}

Binding::Binding(const Mesh& cage, std::vector<Vec3d> points, const CoordinateOptions& options,
                 const std::vector<float>& weights)
    : cage_(cage), points_(std::move(points)), options_(options)
{
    requireUsable(cage, "cage");
    requireFinite(points_, "points");
    restHandles_ = cageHandles(cage, cage.points, options_);
    detail::requireWeights(weights.size(), points_.size(), handles());
    if (family() == Coordinates::given) {
        const std::string problem = detail::weightsProblem(weights, handles());
        if (!problem.empty()) throw InputError("weights", problem);
    }
    weights_ = std::make_shared<detail::WeightBlocks>(
        points_, maxDistancesOf(cage_, family()),
        [&](const std::vector<std::uint32_t>& block, std::vector<float>& rows) {
            for (std::size_t i = 0; i < block.size(); ++i) {
                std::copy_n(weights.begin() + static_cast<std::ptrdiff_t>(block[i] * handles()), handles(),
                            rows.begin() + static_cast<std::ptrdiff_t>(i * handles()));
            }
        });
}

Binding Binding::with(const Elasticity& elasticity) const
{
    requireElasticity(elasticity);
    if (family() != Coordinates::somigliana) return *this;
    Binding changed = *this;
    changed.options_.elasticity = elasticity;
    changed.restHandles_ = cageHandles(cage_, cage_.points, changed.options_);
    return changed;
}

std::size_t Binding::weightBytes() const
{
    return weights_->bytes();
}

std::vector<Vec3d> Binding::pose(const std::vector<Vec3d>& cagePoints) const
{
    std::vector<Vec3d> posed = points_;
    add(restHandles_, cageHandles(cage_, cagePoints, options_), posed);
    return posed;
}

void Binding::update(std::vector<Vec3d>& posed, const std::vector<Vec3d>& from, const std::vector<Vec3d>& to) const
{
    requireCount("posed points", posed.size(), points_.size(), "the binding");
    add(cageHandles(cage_, from, options_), cageHandles(cage_, to, options_), posed);
}

void Binding::add(const std::vector<Vec3d>& fromHandles, const std::vector<Vec3d>& toHandles,
                  std::vector<Vec3d>& posed) const
{
    // In units of the cage: floats hold the motion of models of any size.
    const double size = detail::CageFrame(cage_).size;
    std::vector<detail::HandleMove> moves;
    for (std::size_t k = 0; k < toHandles.size(); ++k) {
        if (fromHandles[k] == toHandles[k]) continue;
        moves.push_back({k, openvdb::Vec3f((toHandles[k] - fromHandles[k]) / size)});
    }
    if (!moves.empty()) weights_->move(moves, size, posed);
}

} // namespace vdbcage
