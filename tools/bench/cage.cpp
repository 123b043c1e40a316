// vdbcage-bench cage: costs of cages, their tightness and the shape of their triangles, by number of faces and effort,
// beside plain quadric decimation of the model, which cuts it.

#include <algorithm>
#include <iostream>
#include <optional>

#include <openvdb/math/Mat3.h>
#include <tbb/global_control.h>
#include <tbb/info.h>
#include <vdbcage/core/detail/pi.h>
#include <vdbcage/core/error.h>
#include <vdbcage/mesh/mesh_io.h>
#include <vdbcage/pipeline/pipeline.h>
#include <vdbcage/surface/decimate.h>

#include "bench.h"

namespace vdbcage::bench {

namespace {

/// Returns a copy of a model: the same shape, but other voxels and other ties. Copy 0 is the model itself.
Mesh copyOf(Mesh model, int copy)
{
    constexpr double radians = 0.3 * detail::pi / 180;
    const auto turn = openvdb::math::rotation<openvdb::Mat3d>(openvdb::Vec3d(1, 2, 3).unit(), copy * radians);
    for (openvdb::Vec3d& point : model.points) point = turn * point;
    return model;
}

/// Returns the quality. Distances are in % of the diagonal, as in papers on cages.
Json quality(const Mesh& cage, const CageCheck& check)
{
    return {{"faces", faceCount(cage)},
            {"valid", check.valid()},
            {"bounding", check.bounding()},
            {"mean_distance_percent", 100 * check.meanDistance / check.diagonal},
            {"max_distance_percent", 100 * check.maxDistance / check.diagonal},
            {"volume_ratio", check.volumeRatio},
            {"angle_percentile_degrees",
             {{"0", check.minAngleDegrees}, {"1", check.angle1stPercentileDegrees}, {"50", check.medianAngleDegrees}}}};
}

/// Returns the model decimated to that number of triangles; null if it is no surface that can be decimated.
Json decimated(const Mesh& model, int faces)
{
    StageClock clock;
    DecimateOptions target;
    target.faces = static_cast<std::size_t>(faces);
    std::optional<Stage> decimating(std::in_place, &clock, StageName::decimate);
    Mesh plain;
    try {
        plain = decimate(model, target);
    } catch (const InputError&) {
        return nullptr;
    }
    decimating.reset();
    Json line = toJson(clock.stages());
    line.update(quality(plain, checkCage(plain, model)));
    return line;
}

/// Measures one run in this process.
Json measure(const std::string& model, int copy, const std::string& effort, CageOptions options)
{
    setOption(options, "effort", effort);
    StageClock clock;
    const double began = costSoFar().wallSeconds;
    std::optional<Stage> reading(std::in_place, &clock, StageName::read);
    Mesh mesh = readMesh(model);
    reading.reset();
    Pipeline pipeline(copyOf(std::move(mesh), copy));
    pipeline.run(options, &clock);
    const double wall = costSoFar().wallSeconds - began;
    Json line{{"model", model},
              {"faces", faceCount(pipeline.model())},
              {"faces_asked", options.faces},
              {"effort", effort},
              {"threads", tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism)},
              {"wall_seconds", wall}};
    line.update(usage()); // before the other decimation adds to it
    line.update(toJson(clock.stages()));
    line["resolution"] = pipeline.report().resolution;
    line["cage"] = quality(pipeline.cage(), pipeline.report().check);

    line["qem"] = decimated(pipeline.model(), options.faces);
    return line;
}

/// Merges several runs into one: of numbers the median (of an even count the greater of the two), of truths whether all
/// hold, of texts the first; a number that a run lacks is 0, such as the time of a stage that it skipped.
Json median(std::vector<Json> runs)
{
    const Json& first = runs.front();
    if (first.is_object()) {
        Json merged = Json::object();
        for (const Json& run : runs) {
            for (const auto& item : run.items()) {
                if (merged.contains(item.key())) continue;
                std::vector<Json> values;
                for (const Json& other : runs) values.push_back(other.value(item.key(), Json(0)));
                merged[item.key()] = median(std::move(values));
            }
        }
        return merged;
    }
    if (first.is_boolean()) {
        return std::all_of(runs.begin(), runs.end(), [](const Json& run) { return run.get<bool>(); });
    }
    if (!first.is_number()) return first;
    std::sort(runs.begin(), runs.end());
    return runs[runs.size() / 2];
}

} // namespace

int runCage(int argc, char** argv)
{
    std::vector<std::string> models, faceCounts{"50", "100", "400", "1000"}, efforts{"fast", "fair", "best"};
    int copies = 1, threads = tbb::info::default_concurrency(), copy = -1;
    CageOptions options;
    CLI::App app("vdbcage-bench cage: cost, tightness and shape of cages beside plain decimation, as JSON lines");
    app.add_option("models", models, "models to measure on")->required()->type_name("MODEL");
    addList(app, "--faces", faceCounts, "list of face counts [50,100,400,1000]")->type_name("N,N");
    addList(app, "--efforts", efforts, "list of efforts [fast,fair,best]")->type_name("E,E");
    app.add_option("--copies", copies, "medians over the model turned by 0, 0.3, 0.6 ... degrees [1]")->type_name("K");
    app.add_option("--copy", copy, "only this copy, from 0, in this process")->type_name("K");
    app.add_option("--threads", threads, "[all]")->type_name("N");
    std::vector<std::string> passedOn;
    addCageOptions(app, {"faces", "effort", "bounding"}, options, passedOn);
    CLI11_PARSE(app, argc - 1, argv + 1);
    requirePositive("--copies", copies);
    requirePositive("--threads", threads);
    for (const std::string& faces : faceCounts) setOption(options, "faces", faces);
    for (const std::string& effort : efforts) setOption(options, "effort", effort);

    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(threads));
    for (const std::string& model : models) {
        for (const std::string& faces : faceCounts) {
            for (const std::string& effort : efforts) {
                setOption(options, "faces", faces);
                Json line;
                if (copy >= 0) {
                    line = measure(model, copy, effort, options);
                } else {
                    std::vector<Json> runs;
                    for (int k = 0; k < copies; ++k) {
                        std::vector<std::string> words{argv[0],
                                                       "cage",
                                                       model,
                                                       "--faces",
                                                       faces,
                                                       "--efforts",
                                                       effort,
                                                       "--threads",
                                                       std::to_string(threads),
                                                       "--copy",
                                                       std::to_string(k)};
                        words.insert(words.end(), passedOn.begin(), passedOn.end());
                        runs.push_back(Json::parse(runSelf(words)));
                    }
                    line = median(std::move(runs));
                    line["copies"] = copies;
                }
                std::cout << line.dump() << std::endl;
            }
        }
    }
    return 0;
}

} // namespace vdbcage::bench
