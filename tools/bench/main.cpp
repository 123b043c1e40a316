// vdbcage-bench: stage times and peak memory as JSON lines, one a run. Each run is a process of its own, so that its
// peak memory and its warm-up are its own.

#include <cstdio>
#include <exception>
#include <iostream>
#include <string>
#include <vector>

#include <spawn.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>
#include <tbb/global_control.h>
#include <vdbcage/core/error.h>
#include <vdbcage/core/interrupter.h>
#include <vdbcage/core/version.h>
#include <vdbcage/mesh/mesh_io.h>
#include <vdbcage/pipeline/pipeline.h>

extern char** environ;

namespace {

using namespace vdbcage;
using Json = nlohmann::ordered_json;

double seconds(const timeval& time)
{
    return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
}

/// One run in this process.
void measure(const std::string& model, int threads, const CageOptions& options)
{
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(threads));
    StageClock clock;
    const auto began = std::chrono::steady_clock::now();
    std::optional<Stage> reading(std::in_place, &clock, "read");
    Mesh mesh = readMesh(model);
    reading.reset();
    Pipeline pipeline(std::move(mesh));
    pipeline.run(options, &clock);
    const double wall = std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count();
    rusage usage{};
    ::getrusage(RUSAGE_SELF, &usage);

    Json stages = Json::object();
    for (const StageTime& stage : clock.stages()) stages[stage.name] = stage.seconds;
    const CageReport& report = pipeline.report();
    std::cout << Json{{"model", model},
                      {"faces", faceCount(pipeline.model())},
                      {"resolution", report.resolution},
                      {"threads", threads},
                      {"wall_seconds", wall},
                      {"cpu_seconds", seconds(usage.ru_utime) + seconds(usage.ru_stime)},
                      {"memory_peak_mib", static_cast<double>(usage.ru_maxrss) / 1024},
                      {"stage_seconds", stages},
                      {"cage_faces", faceCount(pipeline.cage())},
                      {"bounding", report.check.bounding()},
                      {"mean_distance", report.check.meanDistance},
                      {"max_distance", report.check.maxDistance},
                      {"volume_ratio", report.check.volumeRatio}}
                     .dump()
              << std::endl;
}

/// Runs this program again with `words`; its standard output is ours.
void spawnSelf(const std::vector<std::string>& words)
{
    std::vector<char*> argv;
    for (const std::string& word : words) argv.push_back(const_cast<char*>(word.c_str()));
    argv.push_back(nullptr);
    pid_t child = -1;
    int status = 0;
    if (::posix_spawn(&child, "/proc/self/exe", nullptr, nullptr, argv.data(), environ) != 0 ||
        ::waitpid(child, &status, 0) != child || status != 0) {
        throw Error("a run failed");
    }
}

int run(int argc, char** argv)
{
    std::vector<std::string> models;
    std::vector<int> resolutions{32, 64, 128, 256, 512}, threads{1, 2};
    CageOptions options;
    CLI::App app("vdbcage-bench " VDBCAGE_VERSION ": stage times and peak memory of whole runs, as JSON lines");
    app.add_option("models", models, "models to measure on")->required()->type_name("MODEL...");
    app.add_option("--resolutions", resolutions, "list of resolutions [32,64,128,256,512]")
        ->delimiter(',')
        ->type_name("N,N...");
    app.add_option("--threads", threads, "list of thread counts [1,2]")->delimiter(',')->type_name("N,N...");
    std::vector<std::string> passedOn;
    for (const OptionText& option : describeOptions()) {
        if (option.name == "resolution") continue;
        app.add_option_function<std::string>(
               "--" + option.name,
               [&options, &passedOn, name = option.name](const std::string& value) {
                   setOption(options, name, value);
                   passedOn.insert(passedOn.end(), {"--" + name, value});
               },
               option.help + " [" + option.defaultValue + "]")
            ->type_name(option.value);
    }
    CLI11_PARSE(app, argc, argv);
    for (const int count : threads) {
        if (count < 1) throw InputError("--threads: " + std::to_string(count) + " is not allowed; at least 1");
    }
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
                spawnSelf(words);
            }
        }
    }
    return 0;
}

} // namespace

int main(int argc, char** argv)
{
    try {
        return run(argc, argv);
    } catch (const std::exception& error) {
        std::fprintf(stderr, "vdbcage-bench: error: %s\n", error.what());
        return 1;
    }
}
