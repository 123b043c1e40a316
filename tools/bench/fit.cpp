// vdbcage-bench fit: fits of cages that cut their models: how many bound in the end, how tight they are, whether they
// keep the shape that was drawn, and their cost beside that of making a cage.

#include <cmath>
#include <iostream>
#include <map>
#include <optional>

#include <tools/report/quad_quality.h>
#include <vdbcage/bounding/fit.h>
#include <vdbcage/bounding/tighten.h>
#include <vdbcage/check/check.h>
#include <vdbcage/core/error.h>
#include <vdbcage/mesh/mesh_io.h>

#include "bench.h"
#include "drawn_cages.h"

namespace vdbcage::bench {

namespace {

constexpr double tightnesses[] = {0, 0.5, 1};

/// A mean of ratios.
class GeometricMean {
public:
    void add(double ratio)
    {
        sum_ += std::log(ratio);
        ++count_;
    }
    Json value() const { return count_ > 0 ? Json(std::exp(sum_ / count_)) : Json(); }

private:
    double sum_ = 0;
    int count_ = 0;
};

struct Tally {
    int certified = 0, all = 0;

    void add(bool isCertified)
    {
        certified += isCertified ? 1 : 0;
        ++all;
    }
    std::string text() const { return std::to_string(certified) + " of " + std::to_string(all); }
};

/// The results over all cages.
struct Summary {
    static constexpr double littleNoise = 4; // %

    Tally little, rest;
    std::map<double, GeometricMean> distances; ///< by tightness: over that of tightness 1
    GeometricMean ofTighten, ofMake;           ///< distance at tightness 1 over tighten()'s; CPU time over make's
    double angleChange = 0; ///< of the 95th percentile of quads' corners at tightness 0.5, degrees, summed
    int withQuads = 0;      ///< cages that have quads
    bool keepsFaces = true;

    Json toJson() const
    {
        Json line{{"certified_up_to_4_percent_noise", little.text()},
                  {"certified_others", rest.text()},
                  {"keeps_faces", keepsFaces}};
        for (const auto& [tightness, mean] : distances)
            line["distance_at_" + asText(tightness) + "_over_tightest"] = mean.value();
        line["tightest_over_tighten"] = ofTighten.value();
        line["cpu_over_make"] = ofMake.value();
        line["mean_corner_change_degrees"] = withQuads > 0 ? Json(angleChange / withQuads) : Json();
        return line;
    }
    static std::string asText(double tightness) { return Json(tightness).dump(); }
};

/// Measures the fits of a cage, and adds them to the summary.
Json measure(const DrawnCage& drawn, const BoundingGuard& guard, const CageChecker& checker, Summary& summary)
{
    Json line{{"cage", drawn.name}, {"faces", faceCount(drawn.mesh)}};
    std::map<double, double> distances;
    std::optional<Mesh> loosest;
    const double drawnCorners = report::quadQuality(drawn.mesh).corner95th;
    line["corner_p95_drawn"] = drawnCorners;
    for (const double tightness : tightnesses) {
        FitOptions options;
        options.tightness = tightness;
        options.tightening = tightenOptions(Effort::fair);
        Fit fit;
        const Cost cost = costOf([&] { fit = fitCage(drawn.mesh, guard, options); });
        const CageCheck check = checker.check(fit.cage);
        const bool isCertified = fit.obstacle == Fit::Obstacle::none && check.bounding();
        summary.keepsFaces =
            summary.keepsFaces && fit.cage.triangles == drawn.mesh.triangles && fit.cage.quads == drawn.mesh.quads;
        Json result{{"certified", isCertified}, {"cpu_seconds", cost.cpuSeconds}};
        if (isCertified) {
            distances[tightness] = check.meanDistance;
            result["mean_distance_percent"] = 100 * check.meanDistance;
            result["corner_p95"] = report::quadQuality(fit.cage).corner95th;
        }
        if (tightness == 0.5) {
            const bool isLittle = drawn.noisePercent > 0 && drawn.noisePercent <= Summary::littleNoise;
            (isLittle ? summary.little : summary.rest).add(isCertified);
            if (isCertified && drawn.makeCpuSeconds > 0) summary.ofMake.add(cost.cpuSeconds / drawn.makeCpuSeconds);
            if (isCertified && !drawn.mesh.quads.empty()) {
                summary.angleChange += result["corner_p95"].get<double>() - drawnCorners;
                ++summary.withQuads;
            }
        }
        if (tightness == 0 && isCertified) loosest = fit.cage;
        line["tight_" + Summary::asText(tightness)] = result;
    }
    if (distances.size() == std::size(tightnesses)) {
        for (const auto& [tightness, distance] : distances)
            summary.distances[tightness].add(distance / distances.at(1));
        const double tightened = checker.check(tighten(*loosest, guard, tightenOptions(Effort::fair))).meanDistance;
        line["tighten_mean_distance_percent"] = 100 * tightened;
        summary.ofTighten.add(distances.at(1) / tightened);
    }
    return line;
}

} // namespace

int runFit(int argc, char** argv)
{
    std::vector<std::string> models;
    std::string only;
    CLI::App app("vdbcage-bench fit: fits of cages that cut their models, as JSON lines; the last is of all of them");
    app.add_option("models", models, "models to measure on")->required()->type_name("MODEL");
    app.add_option("--only", only, "only cages whose name has this in it")->type_name("TEXT");
    CLI11_PARSE(app, argc - 1, argv + 1);
    Summary summary;
    for (const std::string& path : models) {
        const Mesh model = readMesh(path);
        const BoundingGuard guard(model, fitGuardOptions());
        const CageChecker checker(model);
        for (const DrawnCage& drawn : drawnCages(model)) {
            if (drawn.name.find(only) == std::string::npos) continue;
            Json line{{"model", path}};
            try {
                line.update(measure(drawn, guard, checker, summary));
            } catch (const InputError& error) {
                line.update({{"cage", drawn.name}, {"refused", error.what()}});
            }
            std::cout << line.dump() << std::endl;
        }
    }
    std::cout << summary.toJson().dump() << std::endl;
    return 0;
}

} // namespace vdbcage::bench
