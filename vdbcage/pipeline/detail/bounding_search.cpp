#include <vdbcage/pipeline/detail/bounding_search.h>

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <iterator>
#include <limits>
#include <sstream>
#include <utility>

#include <vdbcage/bounding/detail/guard/guard_model.h>
#include <vdbcage/bounding/detail/triangles/peaks.h>
#include <vdbcage/bounding/detail/triangles/tightening.h>
#include <vdbcage/bounding/near_coplanar.h>
#include <vdbcage/bounding/quad_loops.h>
#include <vdbcage/bounding/smooth.h>
#include <vdbcage/bounding/tighten.h>
#include <vdbcage/bounding/triquad.h>
#include <vdbcage/core/detail/number_text.h>
#include <vdbcage/core/detail/parallel.h>
#include <vdbcage/core/detail/stage_parts.h>
#include <vdbcage/core/error.h>
#include <vdbcage/mesh/parts.h>
#include <vdbcage/pipeline/detail/simple_solids.h>
#include <vdbcage/pipeline/detail/starting_surface.h>
#include <vdbcage/pipeline/detail/tilted_search.h>

namespace vdbcage::detail {

namespace {

/// Side by side. \throw Cancelled
template <typename Change>
void forEach(std::vector<Candidate>& candidates, Interrupter* interrupter, StageName name, const Change& change)
{
    const Stage stage(interrupter, name);
    StagesSideBySide pieces(interrupter, std::vector<double>(candidates.size(), 1.0));
    parallelFor(std::size_t(0), candidates.size(), [&](std::size_t i) { change(candidates[i], pieces.passedOn(i)); });
}

void keepAtMost(std::size_t most, const Mesh Candidate::*mesh, std::vector<Candidate>& candidates)
{
    const auto hasTooMany = [&](const Candidate& candidate) { return faceCount(candidate.*mesh) > most; };
    candidates.erase(std::remove_if(candidates.begin(), candidates.end(), hasTooMany), candidates.end());
}

/// "4.2 % of its longest side"
std::string percentOfSide(double fraction)
{
    std::ostringstream text;
    text << std::setprecision(3) << 100 * fraction << " % of its longest side";
    return text.str();
}

std::string nameOf(const SymmetryPlane& plane)
{
    return std::string(1, "xyz"[plane.axis]);
}

/// Fractions of the longest side so that a user may give them back: rounded up.
std::string tolerance(double deviation)
{
    std::ostringstream text;
    text << std::ceil(deviation * 1e4) / 1e4;
    return text.str();
}

} // namespace

BoundingSearch::BoundingSearch(const Mesh& model, Volumes& volumes, Certifier& certifier,
                               const std::optional<Symmetry>& acrossX, std::size_t largeSurface)
    : model_(model), volumes_(volumes), certifier_(certifier), largeSurface_(largeSurface)
{
    if (!acrossX) return;
    soughtSymmetry_ = CageSymmetry::x;
    symmetry_ = *acrossX;
}

BoundingSearch::~BoundingSearch() = default;

Candidate BoundingSearch::run(const CageOptions& options, const ScaleVersion& scale, const ScaleVersion& density,
                              Interrupter* interrupter)
{
    for (const auto& start : starts_) start->isUsed = false;
    try {
        Run run{options, scale, density, interrupter};
        run.isSheet = isModelSheet(run);
        Candidate best = find(run);
        best.from.reset();
        const auto isUnused = [](const auto& start) { return !start->isUsed; };
        starts_.erase(std::remove_if(starts_.begin(), starts_.end(), isUnused), starts_.end());
        return best;
    } catch (const Cancelled&) {
        throw; // asked for between two steps: what was recorded of the decimations is right
    } catch (...) {
        starts_.clear(); // a step may be half done
        tilted_.reset();
        throw;
    }
}

/// Whether the model is a sheet, in voxels that depend on no option but the interior.
bool BoundingSearch::isModelSheet(const Run& run)
{
    const SolidKey key{policy::sheetResolution, run.options.voxelizer, run.options.interior, std::nullopt};
    if (!sheet_ || !(sheet_->key == key)) {
        const auto solid = volumes_.solid(key, run.interrupter);
        const std::size_t inner = countOf(*erode(*solid->mask, 1, StructuringElement::cube, run.interrupter));
        sheet_ = Sheet{key, isSheet(solid->voxels, inner, key.resolution)};
    }
    return sheet_->isOne;
}

/// A symmetric cage where there is a plane, or else one that is not.
Candidate BoundingSearch::find(const Run& run)
{
    std::string noSymmetry;
    if (run.options.symmetry != CageSymmetry::off) {
        if (auto candidate = findSymmetric(run, noSymmetry)) return *std::move(candidate);
    }
    std::optional<Candidate> found = tightest(run, std::nullopt);
    Candidate candidate = found ? *std::move(found) : box(run, guardFor(run, std::nullopt));
    candidate.noSymmetry = noSymmetry;
    return candidate;
}

/// In a plane across an axis, or where any may be taken in another; else `objection` says why there is none.
/// \throw InputError the plane that is asked for is absurd
std::optional<Candidate> BoundingSearch::findSymmetric(const Run& run, std::string& objection)
{
    Symmetry best = planeFor(run);
    const bool isAnyAllowed = run.options.symmetry == CageSymmetry::automatic;
    const double limit = isAnyAllowed ? run.options.symmetryTolerance : policy::largestRequestedDeviation;
    const std::string finding = "the model misses " + nameOf(best.plane) + " by " + percentOfSide(best.deviation);
    if (!isAnyAllowed && best.deviation > limit) {
        throw InputError("--symmetry", "'" + nameOf(best.plane) + "' is not allowed: " + finding +
                                           "; it may be at most " + detail::numberText(100 * limit) + " %");
    }
    if (best.deviation <= limit) {
        if (auto candidate = tightest(run, best.plane)) {
            best.plane = *guardFor(run, best.plane).symmetry();
            candidate->symmetry = best;
            return candidate;
        }
        objection = "no symmetric cage with so few faces was certified";
        return std::nullopt;
    }
    if (auto candidate = findTilted(run, objection)) return candidate;
    if (!objection.empty()) return std::nullopt;
    objection = finding + ", which is more than " + detail::numberText(100 * limit) + " %";
    if (best.deviation <= policy::largestRequestedDeviation) {
        objection += ": --symmetry " + nameOf(best.plane) + " takes it all the same";
    }
    return std::nullopt;
}

/// In a plane of any direction that is not missed by more than the tolerance. `objection` is set if there is such a
/// plane but no such cage, or if a greater tolerance would do and no axis is as good.
std::optional<Candidate> BoundingSearch::findTilted(const Run& run, std::string& objection)
{
    const auto varies = [](const ScaleField& field) { return field.grid || !field.regions.empty(); };
    const CageOptions& options = run.options;
    const bool isPlaced = varies(options.scale) || varies(options.density) || !options.joints.list.empty();
    if (isPlaced || longestSide(boundingBox(model_)) < policy::leastTurnedSide) return std::nullopt;
    if (!tilted_) {
        const Stage stage(run.interrupter, StageName::symmetry);
        tilted_ = std::make_unique<TiltedSearch>(model_, bestTiltedSymmetry(model_, run.interrupter), certifier_);
    }
    const double deviation = tilted_->plane().deviation;
    if (deviation <= run.options.symmetryTolerance) {
        if (auto candidate = tilted_->run(run.options, run.interrupter)) return candidate;
        objection = "no symmetric cage with so few faces was certified";
    } else if (deviation < 0.5 * symmetry_.deviation && deviation <= policy::largestRequestedDeviation) {
        const openvdb::Vec3d& n = tilted_->plane().normal;
        std::ostringstream text;
        text << "the model misses the plane across (" << std::setprecision(2) << n[0] << ", " << n[1] << ", " << n[2]
             << ") by " << percentOfSide(deviation) << ", which is more than "
             << detail::numberText(100 * run.options.symmetryTolerance) << " %: --symmetry-tolerance "
             << tolerance(deviation) << " takes it all the same";
        objection = text.str();
    }
    return std::nullopt;
}

/// The best plane of those that are asked for; the model has the same one in every run.
const Symmetry& BoundingSearch::planeFor(const Run& run)
{
    const CageSymmetry wanted = run.options.symmetry;
    if (wanted == soughtSymmetry_) return symmetry_;
    const Stage stage(run.interrupter, StageName::symmetry);
    if (wanted == CageSymmetry::automatic) {
        constexpr double any =
            std::numeric_limits<double>::infinity(); // of a model too large for doubles there is none
        symmetry_ = findSymmetry(model_, any, run.interrupter).value_or(Symmetry{{}, any});
    } else {
        const int axis = wanted == CageSymmetry::x ? 0 : wanted == CageSymmetry::y ? 1 : 2;
        symmetry_ = bestSymmetry(model_, axis, run.interrupter);
    }
    soughtSymmetry_ = wanted;
    return symmetry_;
}

const BoundingGuard& BoundingSearch::guardFor(const Run& run, const std::optional<SymmetryPlane>& plane)
{
    GuardOptions options = guardOptions(run.options, run.isSheet);
    options.symmetry = plane;
    if (!guard_ || options.clearance != guardOptions_.clearance || options.precision != guardOptions_.precision ||
        options.minAngleDegrees != guardOptions_.minAngleDegrees || options.spacing != guardOptions_.spacing ||
        !(run.density == density_) || options.joints != guardOptions_.joints ||
        options.jointDensity != guardOptions_.jointDensity || !(plane == guardOptions_.symmetry)) {
        const Stage stage(run.interrupter, StageName::guard);
        starts_.clear(); // they are under the guard
        axes_.reset();
        turned_.reset();
        guard_.reset();
        guard_ = std::make_unique<const BoundingGuard>(model_, options, run.interrupter);
        guardOptions_ = options;
        density_ = run.density;
    }
    return *guard_;
}

/// The tightest cage; nothing if there is none.
std::optional<Candidate> BoundingSearch::tightest(const Run& run, const std::optional<SymmetryPlane>& plane)
{
    std::optional<Candidate> best = tightestOfCompeting(run, guardFor(run, plane));
    if (!best || !mayFewerBeTighter(run.options, best->check, faceCount(model_))) return best;
    // Where flat surroundings have no use for more faces, their points only stand out.
    std::optional<Candidate> worthIt;
    const auto offer = [&](std::optional<Candidate> candidate) {
        if (!candidate) return;
        if (worthIt && !areWorthTheirFaces(candidate->check, worthIt->check, run.options.clearance)) return;
        worthIt = std::move(candidate);
    };
    for (const CageOptions& options : fewerFaces(run.options)) {
        const Run fewer{options, run.scale, run.density, run.interrupter, run.isSheet};
        offer(tightestOfCompeting(fewer, guardFor(fewer, plane)));
    }
    offer(std::move(best));
    return worthIt;
}

/// The tightest of the cages that compete; nothing if there is none.
std::optional<Candidate> BoundingSearch::tightestOfCompeting(const Run& run, const BoundingGuard& guard)
{
    std::optional<Candidate> best;
    const auto take = [&](std::optional<Candidate> candidate, double advance) {
        if (!candidate || (best && best->looseness <= candidate->looseness - advance)) return;
        best = std::move(candidate);
    };
    const double share = shareFor(run, guard);
    for (const CageOptions& options : competitors(run.options)) {
        const Run of{options, run.scale, run.density, run.interrupter, run.isSheet, share};
        take(climb(of, guard), 0);
        // That a cage of more faces lies on the model more closely than a box is not worth them.
        if (isOfFewFaces(options)) take(shrinkOnto(of, simpleSolids(of, guard), guard), options.clearance);
    }
    return best;
}

/// The tightest cage from the first rungs of the ladders that lead to few enough faces, or else from the convex hull;
/// nothing if that has too many too.
std::optional<Candidate> BoundingSearch::climb(const Run& run, const BoundingGuard& guard)
{
    const std::vector<std::vector<Voxels>> all = ladders(run.options, run.share);
    std::vector<std::size_t> next(all.size(), 0); // rung of each
    std::size_t climbed = 1;                      // the first alone, until others may be tighter
    for (;;) {
        Candidates starts;
        for (std::size_t i = 0; i < climbed; ++i) {
            Candidates found;
            while (found.empty() && next[i] < all[i].size()) {
                Voxels voxels = all[i][next[i]++];
                voxels.plane = guard.symmetry();
                found = startsFrom(run, voxels, guard);
            }
            if (found.empty() ||
                mayCoarserBeTighter(run.options, run.share, found.front().voxels, found.front().topology)) {
                climbed = all.size();
            }
            std::move(found.begin(), found.end(), std::back_inserter(starts));
        }
        if (starts.empty()) break;
        if (auto candidate = shrinkOnto(run, std::move(starts), guard)) return candidate;
    }
    Voxels voxels = all.front().front();
    voxels.resolution = std::min(voxels.resolution, policy::hullResolution);
    voxels.plane = guard.symmetry();
    return shrinkOnto(run, {begin(run, voxels, CageStart::hull, guard)}, guard);
}

/// What cages may be shrunk from with voxels like these: nothing if there are too many handles.
BoundingSearch::Candidates BoundingSearch::startsFrom(const Run& run, const Voxels& voxels, const BoundingGuard& guard)
{
    const int resolution = resolutionFor(run, voxels);
    Candidates starts;
    const auto beginWith = [&](double scale, bool isTurned) {
        Voxels scaled = voxels;
        scaled.resolution = static_cast<int>(std::lround(scale * resolution));
        scaled.turned = isTurned;
        Candidate candidate = begin(run, scaled, CageStart::closing, guard);
        if (hasFewEnoughHandles(run.options, candidate.topology)) starts.push_back(std::move(candidate));
    };
    for (const double scale : startScales(run.options)) {
        beginWith(scale, false);
        if (starts.empty()) break;
    }
    if (mayBeTurned(run.options)) {
        const AlignedAxes& axes = axesFor(run, guard);
        // About as many quads as along x, y and z.
        if (axes.share <= policy::worthTurning) {
            const double sides = longestSide(boundingBox(turnedModel().model)) / longestSide(boundingBox(model_));
            beginWith(sides / std::sqrt(axes.share), true);
        }
    }
    return starts;
}

/// The model's own axes; in a symmetric run one is across the plane.
const AlignedAxes& BoundingSearch::axesFor(const Run& run, const BoundingGuard& guard)
{
    if (!axes_) {
        const auto plane = guard.symmetry();
        axes_ = alignedAxes(model_, plane ? std::optional<int>(plane->axis) : std::nullopt, run.interrupter);
    }
    return *axes_;
}

/// \pre axesFor() was called
BoundingSearch::Turned& BoundingSearch::turnedModel()
{
    if (!turned_) turned_ = std::make_unique<Turned>(turned(model_, axes_->rows));
    return *turned_;
}

/// What cages of few faces may be shrunk from beside closings.
BoundingSearch::Candidates BoundingSearch::simpleSolids(const Run& run, const BoundingGuard& guard)
{
    Voxels voxels = finestVoxels(run.options, run.share);
    voxels.plane = guard.symmetry();
    Candidates starts{begin(run, voxels, CageStart::orientedBox, guard)};
    const bool isBoxTooMuch = run.options.mesh == CageFaces::triangles && run.options.faces < policy::trianglesOfBox;
    if (isBoxTooMuch && !guard.symmetry()) starts.push_back(begin(run, voxels, CageStart::tetrahedron, guard));
    return starts;
}

int BoundingSearch::resolutionFor(const Run& run, const Voxels& voxels)
{
    if (!dependsOnSurface(run.options)) return voxels.resolution;
    return affordableResolution(run.options, run.share, voxels, quadsOf(run, voxels));
}

double BoundingSearch::shareFor(const Run& run, const BoundingGuard& guard)
{
    const double side = longestSide(boundingBox(model_));
    const openvdb::Vec3d extents = boundingBox(model_).extents() / side;
    const auto largest = [&] {
        if (!largestPart_) largestPart_ = largestPart(model_) / side;
        return *largestPart_;
    };
    const auto quads = [&](Voxels voxels) {
        voxels.plane = guard.symmetry();
        return quadsOf(run, voxels);
    };
    return shareOfSide(run.options, {extents[0] * extents[1] * extents[2], largest, quads});
}

/// How many faces the surface of a closing has.
std::size_t BoundingSearch::quadsOf(const Run& run, const Voxels& voxels)
{
    ClosingKey key = closingKey(run.options, run.scale, voxels);
    const auto isIt = [&](const Counted& counted) { return counted.key == key; };
    const auto known = std::find_if(counted_.begin(), counted_.end(), isIt);
    if (known != counted_.end()) return known->quads;
    const auto closing = volumes_.closing(run.options, run.scale, voxels, run.interrupter);
    const std::size_t quads = faceCount(*surfaceOf(*closing, run.interrupter));
    constexpr std::size_t most = 64; // of many runs
    if (counted_.size() >= most) counted_.clear();
    counted_.push_back({std::move(key), quads});
    return quads;
}

/// A candidate with what it is made from: of the run before, or anew.
Candidate BoundingSearch::begin(const Run& run, const Voxels& voxels, CageStart kind, const BoundingGuard& guard)
{
    const ClosingKey key = closingKey(run.options, run.scale, voxels);
    const auto isIt = [&](const auto& start) {
        return start->kind == kind && start->turned == voxels.turned && start->closing->key == key;
    };
    auto known = std::find_if(starts_.begin(), starts_.end(), isIt);
    if (known == starts_.end()) {
        const auto closingOf = [&](Volumes& volumes) {
            return volumes.closing(run.options, run.scale, voxels, run.interrupter);
        };
        auto closing = closingOf(volumes_);
        auto start = std::make_shared<StartingSurface>();
        if (kind == CageStart::orientedBox || kind == CageStart::tetrahedron) {
            const openvdb::Mat3d& axes = axesFor(run, guard).rows;
            *start =
                simpleSolid(std::move(closing), kind, model_, axes, thinnestBox(guardOptions_), guard, run.interrupter);
        } else if (voxels.turned) {
            *start = startingSurface(closingOf(turnedModel().volumes), kind, axes_->rows, guard, run.interrupter);
            start->closing = std::move(closing); // which is where the model is
        } else {
            *start = startingSurface(std::move(closing), kind, std::nullopt, guard, run.interrupter);
        }
        start->turned = voxels.turned;
        known = starts_.insert(starts_.end(), std::move(start));
    }
    const std::shared_ptr<StartingSurface>& start = *known;
    start->isUsed = true;
    Candidate candidate;
    candidate.voxels = voxels;
    candidate.start = kind;
    candidate.offsetVoxels = start->offsetVoxels;
    candidate.from = start;
    candidate.closing = start->closing;
    candidate.surface = start->surface;
    candidate.minAngle = guardOptions_.minAngleDegrees;
    candidate.sideShare = run.share;
    candidate.topology = start->topology;
    return candidate;
}

/// Makes cages of the candidates' surfaces, side by side; the tightest that has few enough faces and is certified.
std::optional<Candidate> BoundingSearch::shrinkOnto(const Run& run, Candidates starts, const BoundingGuard& guard)
{
    const CageOptions& options = run.options;
    if (options.mesh == CageFaces::loops) {
        collapseLoops(run, starts, guard);
    } else {
        decimateAndTighten(run, starts, guard);
    }
    keepAtMost(static_cast<std::size_t>(options.faces), &Candidate::cage, starts);
    if (const int sweeps = smoothing(options); sweeps > 0) {
        forEach(starts, run.interrupter, StageName::smooth, [&](Candidate& candidate, Interrupter* piece) {
            candidate.cage = smooth(candidate.cage, guard, {sweeps}, piece);
        });
    }
    for (Candidate& candidate : starts) candidate.smoothed = candidate.cage;
    if (options.mesh == CageFaces::triangles) {
        const Stage stage(run.interrupter, StageName::coplanar);
        for (Candidate& candidate : starts) {
            candidate.cage = bendNearCoplanarEdges(candidate.cage, guard, run.interrupter);
        }
    }
    return tightestCertified(run, std::move(starts), guard);
}

/// Those whose surfaces are large one after the other, then the others side by side. \throw Cancelled
template <typename Change>
void BoundingSearch::forEachSurface(Candidates& candidates, Interrupter* interrupter, StageName name,
                                    const Change& change) const
{
    const Stage stage(interrupter, name);
    std::vector<double> faces;
    for (const Candidate& candidate : candidates) faces.push_back(static_cast<double>(faceCount(*candidate.surface)));
    StagesSideBySide pieces(interrupter, faces);
    const auto changeOne = [&](std::size_t i) { change(candidates[i], pieces.passedOn(i)); };
    for (std::size_t i = 0; i < candidates.size(); ++i) {
        if (isLarge(candidates[i])) changeOne(i);
    }
    parallelFor(std::size_t(0), candidates.size(), [&](std::size_t i) {
        if (!isLarge(candidates[i])) changeOne(i);
    });
}

/// Cages of quads in loops; what is not of quads only is left out.
void BoundingSearch::collapseLoops(const Run& run, Candidates& starts, const BoundingGuard& guard) const
{
    QuadLoopsOptions options;
    options.faces = static_cast<std::size_t>(run.options.faces);
    options.tightening = tightenOptions(run.options.effort);
    options.exchanges = loopExchanges(run.options.effort);
    forEachSurface(starts, run.interrupter, StageName::loops, [&](Candidate& candidate, Interrupter* piece) {
        candidate.cage = quadLoops(*candidate.surface, guard, options, piece);
        candidate.decimated = candidate.cage;
    });
    const auto hasTriangles = [](const Candidate& candidate) { return !candidate.cage.triangles.empty(); };
    starts.erase(std::remove_if(starts.begin(), starts.end(), hasTriangles), starts.end());
}

/// Cages of triangles, or of triangles and quads.
void BoundingSearch::decimateAndTighten(const Run& run, Candidates& starts, const BoundingGuard& guard) const
{
    const CageOptions& options = run.options;
    Interrupter* const interrupter = run.interrupter;
    const auto faces = static_cast<std::size_t>(options.faces);
    const bool onlyTriangles = options.mesh == CageFaces::triangles;
    BoundingDecimateOptions decimation;
    decimation.faces = onlyTriangles ? faces : policy::trianglesPerQuad * faces;
    decimation.effort = options.effort;
    // Simple solids are cages as they are.
    const auto isCage = [&](const Candidate& candidate) {
        const Mesh& surface = *candidate.surface;
        const bool isSimple = candidate.start == CageStart::orientedBox || candidate.start == CageStart::tetrahedron;
        return isSimple && surface.triangles.size() + (onlyTriangles ? 2 : 1) * surface.quads.size() <= faces;
    };
    forEachSurface(starts, interrupter, StageName::decimate, [&](Candidate& candidate, Interrupter* piece) {
        const Mesh& surface = *candidate.surface;
        if (isCage(candidate)) {
            candidate.decimated = onlyTriangles ? triangulated(surface) : surface;
            return;
        }
        if (isLarge(candidate)) {
            candidate.decimated = decimate(surface, guard, decimation, piece);
            return;
        }
        auto& known = candidate.from->decimation;
        if (!known) known.emplace(surface, guard, piece);
        candidate.decimated = known->to(decimation, piece);
    });
    keepAtMost(decimation.faces, &Candidate::decimated, starts);

    TightenOptions tightening = tightenOptions(options.effort);
    if (guard.symmetry()) tightening.perturbations *= policy::symmetricPerturbations;
    if (onlyTriangles) {
        forEach(starts, interrupter, StageName::tighten, [&](Candidate& candidate, Interrupter* piece) {
            candidate.cage = withoutPeaks(tighten(candidate.decimated, guard, tightening, piece), guard, piece);
        });
    } else {
        BoundingTriquadOptions pairing;
        pairing.mergeAngleDegrees = mergeAngle(options);
        pairing.faces = faces;
        pairing.quadShape = options.quadShape;
        if (options.mesh == CageFaces::quads) pairing.quads = policy::mostlyQuads;
        pairing.tightening = tightening;
        forEach(starts, interrupter, StageName::quads, [&](Candidate& candidate, Interrupter* piece) {
            const Mesh& decimated = candidate.decimated;
            candidate.cage = isCage(candidate) ? tighten(decimated, guard, tightening, piece)
                                               : triquad(decimated, guard, pairing, piece);
        });
    }
}

std::optional<Candidate> BoundingSearch::tightestCertified(const Run& run, Candidates candidates,
                                                           const BoundingGuard& guard)
{
    const bool isWeighted = modelOf(guard).hasDensity();
    for (Candidate& candidate : candidates) {
        candidate.check = certifier_.check(candidate.cage, run.interrupter);
        candidate.looseness =
            isWeighted ? meanDistance(candidate.cage, guard, run.interrupter) : candidate.check.meanDistance;
    }
    std::stable_sort(candidates.begin(), candidates.end(),
                     [](const Candidate& a, const Candidate& b) { return a.looseness < b.looseness; });
    for (Candidate& candidate : candidates) {
        if (!candidate.check.bounding()) continue;
        candidate.boundsAsFloats = certifier_.boundsAsFloats(candidate.cage, run.options.precision, run.interrupter);
        if (candidate.boundsAsFloats) return std::move(candidate);
    }
    return std::nullopt;
}

/// The last resort.
Candidate BoundingSearch::box(const Run& run, const BoundingGuard& guard)
{
    openvdb::BBoxd box = boundingBox(model_);
    box.expand(std::max(2 * guard.clearance(), policy::boxMargin * longestSide(box)));
    Candidate candidate;
    candidate.voxels = ladders(run.options).back().back();
    candidate.start = CageStart::box;
    candidate.closing = volumes_.closing(run.options, run.scale, candidate.voxels, run.interrupter);
    const bool areTriangles = run.options.mesh == CageFaces::triangles;
    const bool isBoxTooMuch = areTriangles && run.options.faces < policy::trianglesOfBox;
    Mesh surface = isBoxTooMuch ? tetrahedronMesh(box) : boxMesh(box);
    if (areTriangles) surface = triangulated(std::move(surface));
    candidate.surface = std::make_shared<const Mesh>(std::move(surface));
    candidate.topology = analyzeTopology(*candidate.surface, nullptr);
    candidate.decimated = candidate.smoothed = candidate.cage =
        certifier_.rounded(*candidate.surface, run.options.precision);
    candidate.check = certifier_.check(candidate.cage, run.interrupter);
    candidate.boundsAsFloats = certifier_.boundsAsFloats(candidate.cage, run.options.precision, run.interrupter);
    return candidate;
}

} // namespace vdbcage::detail
