// vdbcage-bench: stage times and peak memory of whole runs, by resolution and number of threads.

#include <iostream>

#include <tbb/global_control.h>
#include <vdbcage/core/version.h>
#include <vdbcage/mesh/mesh_io.h>
#include <vdbcage/pipeline/pipeline.h>

#include "bench.h"

namespace vdbcage::bench {

namespace {

/// Measures one run in this process.
void measure(const std::string& model, int threads, const CageOptions& options)
{
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(threads));
    StageClock clock;
    const double began = costSoFar().wallSeconds;
    std::optional<Stage> reading(std::in_place, &clock, StageName::read);
    Mesh mesh = readMesh(model);
    reading.reset();
    Pipeline pipeline(std::move(mesh));
    pipeline.run(options, &clock);
    const double wall = costSoFar().wallSeconds - began;
    const CageReport& report = pipeline.report();
    Json line{{"model", model},
              {"faces", faceCount(pipeline.model())},
              {"resolution", report.resolution},
              {"threads", threads},
              {"wall_seconds", wall}};
    line.update(usage());
    line.update(toJson(clock.stages()));
    line.update({{"cage_faces", faceCount(pipeline.cage())},
                 {"bounding", report.check.bounding()},
                 {"mean_distance", report.check.meanDistance},
                 {"max_distance", report.check.maxDistance},
                 {"volume_ratio", report.check.volumeRatio}});
    std::cout << line.dump() << std::endl;
}

} // namespace

int runStages(int argc, char** argv)
{
    std::vector<std::string> models;
    std::vector<int> resolutions{32, 64, 128, 256, 512}, threads{1, 2};
    CageOptions options;
    CLI::App app("vdbcage-bench " VDBCAGE_VERSION ": stage times and peak memory of whole runs, as JSON lines.\n"
                 "vdbcage-bench cage --help: tightness of cages beside plain decimation\n"
                 "vdbcage-bench closing --help: dilation, erosion and closing beside alternatives\n"
                 "vdbcage-bench voxelize --help: the voxelizers side by side\n"
                 "vdbcage-bench deform --help: binding and posing");
    app.add_option("models", models, "models to measure on")->required()->type_name("MODEL");
    addList(app, "--resolutions", resolutions, "list of resolutions [32,64,128,256,512]")->type_name("N,N");
    addList(app, "--threads", threads, "list of thread counts [1,2]")->type_name("N,N");
    std::vector<std::string> passedOn;
    addCageOptions(app, {"resolution"}, options, passedOn);
    CLI11_PARSE(app, argc, argv);
    for (const int count : threads) requirePositive("--threads", count);
    for (const int resolution : resolutions) setOption(options, "resolution", std::to_string(resolution));
    if (models.size() * resolutions.size() * threads.size() == 1) {
        measure(models[0], threads[0], options);
        return 0;
    }
    for (const std::string& model : models) {
        for (const int resolution : resolutions) {
            for (const int count : threads) {
                std::vector<std::string> words{
                    argv[0], model, "--resolutions", std::to_string(resolution), "--threads", std::to_string(count)};
                words.insert(words.end(), passedOn.begin(), passedOn.end());
                std::cout << runSelf(words) << std::flush;
            }
        }
    }
    return 0;
}

} // namespace vdbcage::bench
