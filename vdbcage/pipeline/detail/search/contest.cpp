#include <vdbcage/pipeline/detail/search/contest.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include <vdbcage/bounding/detail/guard/wishes.h>
#include <vdbcage/bounding/detail/triangles/peaks.h>
#include <vdbcage/bounding/detail/triangles/tightening.h>
#include <vdbcage/bounding/near_coplanar.h>
#include <vdbcage/bounding/quad_loops.h>
#include <vdbcage/bounding/smooth.h>
#include <vdbcage/bounding/tighten.h>
#include <vdbcage/bounding/triquad.h>
#include <vdbcage/core/detail/longest_side.h>
#include <vdbcage/core/detail/parallel.h>
#include <vdbcage/core/detail/stage_parts.h>
#include <vdbcage/pipeline/detail/search/memory_demand.h>
#include <vdbcage/pipeline/detail/stages/mesh_tools.h>
#include <vdbcage/pipeline/detail/stages/simple_solids.h>

namespace vdbcage::detail {

namespace {

/// Changes candidates side by side. \throw Cancelled
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

} // namespace

Rules Contest::rulesFor(const CageOptions& options)
{
    return cache_.rules(options, request_.density, ofSheet_, plane_, request_.interrupter);
}

std::optional<Candidate> Contest::tightest()
{
    const CageOptions& options = request_.options;
    std::optional<Candidate> best = tightestFor(options);
    if (!best || !mayFewerBeTighter(options, best->check, faceCount(cache_.model()))) return best;
    // In flat surroundings that do not need more faces, their points only stand out.
    std::optional<Candidate> worthIt;
    const auto offer = [&](std::optional<Candidate> candidate) {
        if (!candidate) return;
        if (worthIt && !areWorthTheirFaces(candidate->check, worthIt->check, options.clearance)) return;
        worthIt = std::move(candidate);
    };
    for (const CageOptions& fewer : fewerFaces(options)) offer(tightestFor(fewer));
    offer(std::move(best));
    return worthIt;
}

/// Returns the tightest of the competing cages; nothing if there is none.
std::optional<Candidate> Contest::tightestFor(const CageOptions& options)
{
    const Rules rules = rulesFor(options);
    const auto quads = [&](const Voxels& voxels) { return quadsOf(options, rules, voxels); };
    const SearchPlan plan = searchPlan(options, shareOfSide(options, cache_.model(), quads));
    if (request_.memoryLimit < unlimitedMemory) {
        MemoryDemand(cache_.model(), options, plan.share, quads).requireWithin(request_.memoryLimit);
    }
    std::optional<Candidate> best;
    const auto take = [&](std::optional<Candidate> candidate, double advance) {
        if (!candidate || (best && best->looseness <= candidate->looseness - advance)) return;
        best = std::move(candidate);
    };
    for (const SearchPlan::Competitor& competitor : plan.competitors) {
        const Contestant contestant{competitor, plan.share, rules};
        take(climb(contestant), 0);
        // A box wins even if a cage of more faces is nearer to the model, by less than the clearance.
        if (competitor.hasSimpleSolids) take(shrinkOnto(contestant, simpleSolids(contestant)), options.clearance);
    }
    if (best) best->plan = describe(plan);
    return best;
}

/// Returns the tightest cage from the first entries of the ladders that lead to few enough faces, or else from the
/// convex hull; nothing if that has too many, too.
std::optional<Candidate> Contest::climb(const Contestant& contestant)
{
    const std::vector<std::vector<Voxels>>& ladders = contestant.competitor.ladders;
    std::vector<std::size_t> next(ladders.size(), 0); // by ladder: its next entry
    std::size_t climbed = 1;                          // only the first, until others may be tighter
    for (;;) {
        Candidates starts;
        for (std::size_t i = 0; i < climbed; ++i) {
            Candidates ladderStarts;
            while (ladderStarts.empty() && next[i] < ladders[i].size()) {
                Voxels voxels = ladders[i][next[i]++];
                voxels.plane = contestant.guard().symmetry();
                ladderStarts = startsFrom(contestant, voxels);
            }
            if (ladderStarts.empty() ||
                mayCoarserBeTighter(contestant.options(), contestant.share, ladderStarts.front().voxels,
                                    ladderStarts.front().topology)) {
                climbed = ladders.size();
            }
            std::move(ladderStarts.begin(), ladderStarts.end(), std::back_inserter(starts));
        }
        if (starts.empty()) break;
        if (auto candidate = shrinkOnto(contestant, std::move(starts))) return candidate;
    }
    Voxels voxels = ladders.front().front();
    voxels.resolution = std::min(voxels.resolution, policy::hullResolution);
    voxels.plane = contestant.guard().symmetry();
    return shrinkOnto(contestant, {candidateFrom(contestant, voxels, CageStart::hull)});
}

/// Makes the surfaces from which cages may be shrunk, with voxels like these: none if there are too many parts or
/// tunnels.
Contest::Candidates Contest::startsFrom(const Contestant& contestant, const Voxels& voxels)
{
    const CageOptions& options = contestant.options();
    int resolution = voxels.resolution;
    if (contestant.competitor.followsSurface) {
        resolution =
            affordableResolution(options, contestant.share, voxels, quadsOf(options, contestant.rules, voxels));
    }
    Candidates starts;
    const auto beginWith = [&](double scale, bool isTurned) {
        Voxels scaled = voxels;
        scaled.resolution = static_cast<int>(std::lround(scale * resolution));
        scaled.turned = isTurned;
        Candidate candidate = candidateFrom(contestant, scaled, CageStart::closing);
        if (leavesFacesForShape(options, candidate.topology)) starts.push_back(std::move(candidate));
    };
    for (const double scale : contestant.competitor.startScales) {
        beginWith(scale, false);
        if (starts.empty()) break;
    }
    if (contestant.competitor.mayBeTurned) {
        const auto plane = contestant.guard().symmetry();
        const double share = cache_.axes(plane, request_.interrupter).share;
        // Makes about as many quads as along x, y and z.
        if (share <= policy::worthTurning) {
            beginWith(cache_.turnedSide(plane, request_.interrupter) / std::sqrt(share), true);
        }
    }
    return starts;
}

/// Makes the surfaces other than closings from which cages of few faces may be shrunk.
Contest::Candidates Contest::simpleSolids(const Contestant& contestant)
{
    const CageOptions& options = contestant.options();
    Voxels voxels = contestant.competitor.ladders.front().front();
    voxels.plane = contestant.guard().symmetry();
    Candidates starts{candidateFrom(contestant, voxels, CageStart::orientedBox)};
    if (isBoxTooMuch(options) && !contestant.guard().symmetry()) {
        starts.push_back(candidateFrom(contestant, voxels, CageStart::tetrahedron));
    }
    return starts;
}

/// Returns the number of quads of a closing's surface.
std::size_t Contest::quadsOf(const CageOptions& options, const Rules& rules, Voxels voxels)
{
    voxels.plane = rules.guard->symmetry();
    return cache_.quadsOf(options, request_.scale, voxels, request_.interrupter);
}

/// Makes a candidate with its starting surface.
Candidate Contest::candidateFrom(const Contestant& contestant, const Voxels& voxels, CageStart kind)
{
    Candidate candidate;
    candidate.keptStart =
        cache_.keptStart(contestant.options(), request_.scale, voxels, kind, contestant.rules, request_.interrupter);
    const StartingSurface& start = candidate.keptStart->surface;
    candidate.voxels = voxels;
    candidate.startKind = kind;
    candidate.offsetVoxels = start.offsetVoxels;
    candidate.closing = start.closing;
    candidate.surface = start.surface;
    candidate.minAngle = contestant.rules.key.guard.minAngleDegrees;
    candidate.sideShare = contestant.share;
    candidate.topology = start.topology;
    return candidate;
}

/// Makes cages of the candidates' surfaces, side by side. Returns the tightest that has few enough faces and is
/// certified.
std::optional<Candidate> Contest::shrinkOnto(const Contestant& contestant, Candidates starts)
{
    const CageOptions& options = contestant.options();
    if (options.mesh == CageFaces::loops) {
        collapseLoops(contestant, starts);
    } else {
        decimateAndTighten(contestant, starts);
    }
    keepAtMost(static_cast<std::size_t>(options.faces), &Candidate::cage, starts);
    if (const int sweeps = smoothing(options); sweeps > 0) {
        forEach(starts, request_.interrupter, StageName::smooth, [&](Candidate& candidate, Interrupter* piece) {
            candidate.cage = smooth(candidate.cage, contestant.guard(), {sweeps}, piece);
        });
    }
    for (Candidate& candidate : starts) candidate.smoothed = candidate.cage;
    if (options.mesh == CageFaces::triangles) {
        const Stage stage(request_.interrupter, StageName::coplanar);
        for (Candidate& candidate : starts) {
            candidate.cage = bendNearCoplanarEdges(candidate.cage, contestant.guard(), request_.interrupter);
        }
    }
    return tightestCertified(contestant, std::move(starts));
}

/// Changes candidates with large surfaces one after the other, then the others side by side. \throw Cancelled
template <typename Change>
void Contest::forEachSurface(Candidates& candidates, StageName name, const Change& change) const
{
    const Stage stage(request_.interrupter, name);
    std::vector<double> faces;
    for (const Candidate& candidate : candidates) faces.push_back(static_cast<double>(faceCount(*candidate.surface)));
    StagesSideBySide pieces(request_.interrupter, faces);
    const auto changeOne = [&](std::size_t i) { change(candidates[i], pieces.passedOn(i)); };
    for (std::size_t i = 0; i < candidates.size(); ++i) {
        if (isLarge(candidates[i])) changeOne(i);
    }
    parallelFor(std::size_t(0), candidates.size(), [&](std::size_t i) {
        if (!isLarge(candidates[i])) changeOne(i);
    });
}

/// Makes cages of quads in loops; removes candidates that do not consist of quads.
void Contest::collapseLoops(const Contestant& contestant, Candidates& starts) const
{
    QuadLoopsOptions options;
    options.faces = static_cast<std::size_t>(contestant.options().faces);
    options.tightening = tightenOptions(contestant.options().effort);
    options.exchanges = loopExchanges(contestant.options().effort);
    forEachSurface(starts, StageName::loops, [&](Candidate& candidate, Interrupter* piece) {
        candidate.cage = quadLoops(*candidate.surface, contestant.guard(), options, contestant.rules.wishes, piece);
        candidate.decimated = candidate.cage;
    });
    const auto hasTriangles = [](const Candidate& candidate) { return !candidate.cage.triangles.empty(); };
    starts.erase(std::remove_if(starts.begin(), starts.end(), hasTriangles), starts.end());
}

/// Makes cages of triangles, or of triangles and quads.
void Contest::decimateAndTighten(const Contestant& contestant, Candidates& starts) const
{
    const CageOptions& options = contestant.options();
    const BoundingGuard& guard = contestant.guard();
    const FaceWishes& wishes = contestant.rules.wishes;
    Interrupter* const interrupter = request_.interrupter;
    const auto faces = static_cast<std::size_t>(options.faces);
    const bool onlyTriangles = options.mesh == CageFaces::triangles;
    BoundingDecimateOptions decimation;
    decimation.faces = onlyTriangles ? faces : policy::trianglesPerQuad * faces;
    decimation.effort = options.effort;
    // Simple solids are cages already.
    const auto isCage = [&](const Candidate& candidate) {
        const Mesh& surface = *candidate.surface;
        return isSimpleSolid(candidate.startKind) &&
               surface.triangles.size() + (onlyTriangles ? 2 : 1) * surface.quads.size() <= faces;
    };
    forEachSurface(starts, StageName::decimate, [&](Candidate& candidate, Interrupter* piece) {
        const Mesh& surface = *candidate.surface;
        if (isCage(candidate)) {
            candidate.decimated = onlyTriangles ? triangulated(surface) : surface;
            return;
        }
        if (isLarge(candidate)) {
            candidate.decimated = decimate(surface, guard, decimation, wishes, piece);
            return;
        }
        RecordedDecimation& recorded = candidate.keptStart->decimation.of(
            contestant.rules.key, [&] { return RecordedDecimation(surface, guard, wishes, piece); });
        candidate.decimated = recorded.to(decimation, piece);
    });
    keepAtMost(decimation.faces, &Candidate::decimated, starts);

    TightenOptions tightening = tightenOptions(options.effort);
    if (guard.symmetry()) tightening.perturbations *= policy::symmetricPerturbations;
    if (onlyTriangles) {
        forEach(starts, interrupter, StageName::tighten, [&](Candidate& candidate, Interrupter* piece) {
            candidate.cage =
                withoutPeaks(tighten(candidate.decimated, guard, tightening, wishes, piece), guard, wishes, piece);
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
            candidate.cage = isCage(candidate) ? tighten(decimated, guard, tightening, wishes, piece)
                                               : triquad(decimated, guard, pairing, wishes, piece);
        });
    }
}

std::optional<Candidate> Contest::tightestCertified(const Contestant& contestant, Candidates candidates)
{
    const bool isWeighted = wishesOf(contestant.rules.wishes).hasDensity();
    for (Candidate& candidate : candidates) {
        candidate.check = certifier_.check(candidate.cage, request_.interrupter);
        candidate.looseness =
            isWeighted ? meanDistance(candidate.cage, contestant.guard(), contestant.rules.wishes, request_.interrupter)
                       : candidate.check.meanDistance;
    }
    std::stable_sort(candidates.begin(), candidates.end(),
                     [](const Candidate& a, const Candidate& b) { return a.looseness < b.looseness; });
    for (Candidate& candidate : candidates) {
        if (!candidate.check.bounding()) continue;
        candidate.boundsAsFloats =
            certifier_.boundsAsFloats(candidate.cage, contestant.options().precision, request_.interrupter);
        if (candidate.boundsAsFloats) return std::move(candidate);
    }
    return std::nullopt;
}

Candidate Contest::box()
{
    const CageOptions& options = request_.options;
    const BoundingGuard& guard = *rulesFor(options).guard;
    openvdb::BBoxd box = boundingBox(cache_.model());
    box.expand(std::max(2 * guard.clearance(), policy::boxMargin * longestSide(box)));
    Candidate candidate;
    candidate.voxels = ladders(options).back().back();
    candidate.startKind = CageStart::box;
    candidate.closing = cache_.volumes().closing(options, request_.scale, candidate.voxels, request_.interrupter);
    Mesh surface = isBoxTooMuch(options) ? tetrahedronMesh(box) : boxMesh(box);
    if (options.mesh == CageFaces::triangles) surface = triangulated(std::move(surface));
    candidate.surface = std::make_shared<const Mesh>(std::move(surface));
    candidate.topology = analyzeTopology(*candidate.surface, nullptr);
    candidate.decimated = candidate.smoothed = candidate.cage =
        certifier_.rounded(*candidate.surface, options.precision);
    candidate.check = certifier_.check(candidate.cage, request_.interrupter);
    candidate.boundsAsFloats = certifier_.boundsAsFloats(candidate.cage, options.precision, request_.interrupter);
    return candidate;
}

} // namespace vdbcage::detail
