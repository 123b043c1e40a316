#include <vdbcage/pipeline/detail/search/bounding_search.h>

#include <cmath>
#include <iomanip>
#include <sstream>
#include <string>
#include <utility>

#include <vdbcage/core/detail/longest_side.h>
#include <vdbcage/core/detail/number_text.h>
#include <vdbcage/core/error.h>
#include <vdbcage/pipeline/detail/search/contest.h>
#include <vdbcage/pipeline/detail/search/tilted_search.h>
#include <vdbcage/pipeline/detail/stages/stage_cache.h>

namespace vdbcage::detail {

namespace {

/// Returns a text such as "4.2 % of its longest side".
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

/// Returns a fraction of the longest side for a user to pass as a tolerance: rounded up.
std::string tolerance(double deviation)
{
    std::ostringstream text;
    text << std::ceil(deviation * 1e4) / 1e4;
    return text.str();
}

} // namespace

BoundingSearch::BoundingSearch(const Mesh& model, Volumes& volumes, Certifier& certifier,
                               const std::optional<Symmetry>& acrossX, std::size_t largeSurface)
    : cache_(std::make_unique<StageCache>(model, volumes, acrossX)), certifier_(certifier), largeSurface_(largeSurface)
{
}

BoundingSearch::~BoundingSearch() = default;

Candidate BoundingSearch::run(const Request& request)
{
    cache_->beginRun();
    try {
        Candidate best = find(request, cache_->isSheet(request.options, request.interrupter));
        best.keptStart.reset();
        cache_->endRun();
        return best;
    } catch (const Cancelled&) {
        throw; // thrown between two steps, so the records of decimations are right
    } catch (...) {
        cache_->forgetStarts();
        tilted_.reset();
        throw;
    }
}

/// Returns a symmetric cage where there is a plane, or else one that is not.
Candidate BoundingSearch::find(const Request& request, bool ofSheet)
{
    std::string noSymmetry;
    if (request.options.symmetry != CageSymmetry::off) {
        if (auto candidate = findSymmetric(request, ofSheet, noSymmetry)) return *std::move(candidate);
    }
    Contest contest{*cache_, certifier_, request, largeSurface_, ofSheet, std::nullopt};
    std::optional<Candidate> tightest = contest.tightest();
    Candidate candidate = tightest ? *std::move(tightest) : contest.box();
    candidate.noSymmetry = noSymmetry;
    return candidate;
}

/// Returns a cage that is symmetric in a plane across an axis or, where any plane may be taken, in another one. If
/// there is none, sets `objection` to the reason.
/// \throw InputError the plane that is asked for is absurd
std::optional<Candidate> BoundingSearch::findSymmetric(const Request& request, bool ofSheet, std::string& objection)
{
    const CageOptions& options = request.options;
    Symmetry best = cache_->symmetry(options.symmetry, request.interrupter);
    const bool isAnyAllowed = options.symmetry == CageSymmetry::automatic;
    const double limit = isAnyAllowed ? options.symmetryTolerance : policy::largestRequestedDeviation;
    const std::string finding = "the model misses " + nameOf(best.plane) + " by " + percentOfSide(best.deviation);
    if (!isAnyAllowed && best.deviation > limit) {
        throw InputError("--symmetry", "'" + nameOf(best.plane) + "' is not allowed: " + finding +
                                           "; it may be at most " + numberText(100 * limit) + " %");
    }
    if (best.deviation <= limit) {
        Contest contest{*cache_, certifier_, request, largeSurface_, ofSheet, best.plane};
        if (auto candidate = contest.tightest()) {
            best.plane = *candidate->voxels.plane;
            candidate->symmetry = best;
            return candidate;
        }
        objection = "no symmetric cage with so few faces was certified";
        return std::nullopt;
    }
    if (auto candidate = findTilted(request, objection)) return candidate;
    if (!objection.empty()) return std::nullopt;
    objection = finding + ", which is more than " + numberText(100 * limit) + " %";
    if (best.deviation <= policy::largestRequestedDeviation) {
        objection += ": --symmetry " + nameOf(best.plane) + " takes it all the same";
    }
    return std::nullopt;
}

/// Returns a cage that is symmetric in a plane of any direction, from which the model deviates by at most the
/// tolerance. Sets `objection` if there is such a plane but no such cage, or if a greater tolerance would be enough and
/// no axis is as good.
std::optional<Candidate> BoundingSearch::findTilted(const Request& request, std::string& objection)
{
    const CageOptions& options = request.options;
    const bool isPlaced = !options.scale.isNone() || !options.density.isNone() || !options.joints.list.empty();
    if (isPlaced || longestSide(boundingBox(cache_->model())) < policy::leastTurnedSide) return std::nullopt;
    if (!tilted_) {
        const Stage stage(request.interrupter, StageName::symmetry);
        tilted_ = std::make_unique<TiltedSearch>(cache_->model(),
                                                 bestTiltedSymmetry(cache_->model(), request.interrupter), certifier_);
    }
    const double deviation = tilted_->plane().deviation;
    if (deviation <= options.symmetryTolerance) {
        if (auto candidate = tilted_->run(options, request.memoryLimit, request.interrupter)) return candidate;
        objection = "no symmetric cage with so few faces was certified";
    } else if (deviation < 0.5 * cache_->symmetry(options.symmetry, request.interrupter).deviation &&
               deviation <= policy::largestRequestedDeviation) {
        const openvdb::Vec3d& n = tilted_->plane().normal;
        std::ostringstream text;
        text << "the model misses the plane across (" << std::setprecision(2) << n[0] << ", " << n[1] << ", " << n[2]
             << ") by " << percentOfSide(deviation) << ", which is more than "
             << numberText(100 * options.symmetryTolerance) << " %: --symmetry-tolerance " << tolerance(deviation)
             << " takes it all the same";
        objection = text.str();
    }
    return std::nullopt;
}

} // namespace vdbcage::detail
