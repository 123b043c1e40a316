#pragma once

#include <string>
#include <vector>

#include <vdbcage/pipeline/detail/search_policy.h>

namespace vdbcage::detail {

/// The attempts of a search for a cage, in order. They determine the time and the memory of a run.
struct SearchPlan {
    /// Options whose cages compete with those of the others for the tightest.
    struct Competitor {
        CageOptions options;
        std::vector<std::vector<Voxels>> ladders; ///< ladders()
        std::vector<double> startScales;          ///< startScales()
        bool mayBeTurned = false;                 ///< mayBeTurned()
        bool followsSurface = false;              ///< dependsOnSurface()
        bool hasSimpleSolids = false;             ///< the box along the model's own axes competes, too
    };
    double share = 1; ///< shareOfSide()
    std::vector<Competitor> competitors;
};

/// Returns the plan for some options. \pre `share` is shareOfSide() of these
SearchPlan searchPlan(const CageOptions& options, double share);

/// Returns a line for each competitor, for people.
std::vector<std::string> describe(const SearchPlan& plan);

} // namespace vdbcage::detail
