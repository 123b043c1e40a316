#include <vdbcage/pipeline/detail/search/search_plan.h>

#include <utility>

#include <vdbcage/core/detail/joined.h>
#include <vdbcage/core/detail/number_text.h>

namespace vdbcage::detail {

namespace {

/// Returns the value of an option as text.
std::string valueOf(const CageOptions& options, const std::string& name)
{
    for (auto& [option, value] : optionValues(options)) {
        if (option == name) return std::move(value);
    }
    return {};
}

} // namespace

SearchPlan searchPlan(const CageOptions& options, double share)
{
    SearchPlan plan;
    plan.share = share;
    for (CageOptions& competing : competitors(options)) {
        SearchPlan::Competitor competitor;
        competitor.ladders = ladders(competing, share);
        competitor.startScales = startScales(competing);
        competitor.mayBeTurned = mayBeTurned(competing);
        competitor.followsSurface = dependsOnSurface(competing);
        competitor.hasSimpleSolids = isOfFewFaces(competing);
        competitor.options = std::move(competing);
        plan.competitors.push_back(std::move(competitor));
    }
    return plan;
}

std::vector<std::string> describe(const SearchPlan& plan)
{
    std::vector<std::string> lines;
    for (const SearchPlan::Competitor& competitor : plan.competitors) {
        std::string line = valueOf(competitor.options, "mesh") + ", " + valueOf(competitor.options, "effort") + ": ";
        line += joined(competitor.ladders, "; ", [](const std::vector<Voxels>& ladder) {
            const std::string to = ladder.size() > 1 ? " to " + numberText(ladder.back().closeRadius) : "";
            return std::to_string(ladder.front().resolution) + " voxels, close radius " +
                   numberText(ladder.front().closeRadius) + to;
        });
        if (competitor.startScales.size() > 1) {
            line += "; begun with";
            for (const double scale : competitor.startScales) line += ' ' + numberText(scale);
            line += " times as many";
        }
        if (competitor.followsSurface) line += "; fewer or more as the surface is large or small";
        if (competitor.mayBeTurned) line += "; also along the model's own axes";
        if (competitor.hasSimpleSolids) line += "; also a box";
        lines.push_back(std::move(line));
    }
    return lines;
}

} // namespace vdbcage::detail
