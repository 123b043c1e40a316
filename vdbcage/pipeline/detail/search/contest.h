#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include <vdbcage/pipeline/detail/search/bounding_search.h>
#include <vdbcage/pipeline/detail/search/search_plan.h>
#include <vdbcage/pipeline/detail/stages/stage_cache.h>

namespace vdbcage::detail {

/// The contest of the cages under one plane of symmetry, or none, which the tightest wins.
class Contest {
public:
    /// All but `plane` must outlive this. `largeSurface` is as for BoundingSearch.
    Contest(StageCache& cache, Certifier& certifier, const BoundingSearch::Request& request, std::size_t largeSurface,
            bool ofSheet, const std::optional<SymmetryPlane>& plane)
        : cache_(cache), certifier_(certifier), request_(request), largeSurface_(largeSurface), ofSheet_(ofSheet),
          plane_(plane)
    {
    }

    /// Returns the tightest certified cage; nothing if there is none.
    /// \throw MemoryError
    /// \throw Cancelled
    std::optional<Candidate> tightest();
    /// Returns the model's bounding box, the last resort, with its verdict.
    Candidate box();

private:
    using Candidates = std::vector<Candidate>;
    /// A competitor of a plan, with the data that all share.
    struct Contestant {
        const SearchPlan::Competitor& competitor;
        double share;
        const Rules& rules;

        const CageOptions& options() const { return competitor.options; }
        const BoundingGuard& guard() const { return *rules.guard; }
    };

    Rules rulesFor(const CageOptions& options);
    std::optional<Candidate> tightestFor(const CageOptions& options);
    std::optional<Candidate> climb(const Contestant& contestant);
    Candidates startsFrom(const Contestant& contestant, const Voxels& voxels);
    Candidates simpleSolids(const Contestant& contestant);
    Candidate candidateFrom(const Contestant& contestant, const Voxels& voxels, CageStart kind);
    std::size_t quadsOf(const CageOptions& options, const Rules& rules, Voxels voxels);
    std::optional<Candidate> shrinkOnto(const Contestant& contestant, Candidates starts);
    void collapseLoops(const Contestant& contestant, Candidates& starts) const;
    void decimateAndTighten(const Contestant& contestant, Candidates& starts) const;
    bool isLarge(const Candidate& candidate) const { return faceCount(*candidate.surface) > largeSurface_; }
    template <typename Change>
    void forEachSurface(Candidates& candidates, StageName name, const Change& change) const;
    std::optional<Candidate> tightestCertified(const Contestant& contestant, Candidates candidates);

    StageCache& cache_;
    Certifier& certifier_;
    const BoundingSearch::Request& request_;
    const std::size_t largeSurface_;
    const bool ofSheet_;
    const std::optional<SymmetryPlane> plane_;
};

} // namespace vdbcage::detail
