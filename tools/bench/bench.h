#pragma once

#include <algorithm>
#include <string>
#include <type_traits>
#include <vector>

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>
#include <vdbcage/core/interrupter.h>
#include <vdbcage/pipeline/options.h>

namespace vdbcage::bench {

using Json = nlohmann::ordered_json;

/// Run a benchmark with the program's name as the first argument, and return the exit status. \throw Error
int runStages(int argc, char** argv);
int runCage(int argc, char** argv);
int runClosing(int argc, char** argv);
int runDeform(int argc, char** argv);
int runFit(int argc, char** argv);
int runVoxelize(int argc, char** argv);
int runView(int argc, char** argv); ///< in builds with the window

/// Adds a flag to `app` for every option of a cage except those in `except`; it sets `options`. The used flags and
/// their values, as typed, are added to `words`, for another process with the same options.
void addCageOptions(CLI::App& app, const std::vector<std::string>& except, CageOptions& options,
                    std::vector<std::string>& words);

/// Adds an option for a list such as "50,100": a single word, so that models may follow it.
template <typename T>
CLI::Option* addList(CLI::App& app, const std::string& name, std::vector<T>& values, const std::string& help)
{
    return app.add_option(name, values, help)->delimiter(',')->allow_extra_args(false);
}

/// \throw InputError unless `count` is at least 1
void requirePositive(const char* option, int count);

/// Returns the resources that this process has used so far: "cpu_seconds" and "memory_peak_mib".
Json usage();

/// Returns the value of a line of /proc/self/status in MiB, such as VmHWM.
double processMemory(const std::string& name);

/// The cost of work, in seconds: of the clock, and of all threads of the process.
struct Cost {
    double wallSeconds = 0, cpuSeconds = 0;
};

/// Returns the cost of the process since some fixed moment; only differences have a meaning.
Cost costSoFar();

/// Returns the cost since `before`.
Cost costSince(const Cost& before);

/// Returns the cost of `work`, except that of freeing its result.
template <class Work>
Cost costOf(const Work& work)
{
    const Cost before = costSoFar();
    if constexpr (std::is_void_v<decltype(work())>) {
        work();
        return costSince(before);
    } else {
        const auto result = work();
        return costSince(before);
    }
}

/// Returns the lesser of each: other processes can only lengthen times.
inline Cost leastOf(const Cost& a, const Cost& b)
{
    return {std::min(a.wallSeconds, b.wallSeconds), std::min(a.cpuSeconds, b.cpuSeconds)};
}

/// Returns the least cost of several runs of `work`.
template <class Work>
Cost leastCost(int runs, const Work& work)
{
    Cost least = costOf(work);
    for (int i = 1; i < runs; ++i) least = leastOf(least, costOf(work));
    return least;
}

/// Returns "wall_seconds" and "cpu_seconds".
Json toJson(const Cost& cost);

/// Returns the stages by name: "stage_seconds" of wall clock, "stage_cpu_seconds" of all threads.
Json toJson(const std::vector<StageTime>& stages);

/// Runs this program again with `words` (the first is its name) in a process of its own, which has its own peak memory
/// and warm-up. Returns its output. \throw Error if it fails
std::string runSelf(const std::vector<std::string>& words);

} // namespace vdbcage::bench
