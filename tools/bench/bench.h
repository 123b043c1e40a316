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

/// One benchmark: its arguments with the program's name first; returns the exit status. \throw Error
int runStages(int argc, char** argv);
int runCage(int argc, char** argv);
int runClosing(int argc, char** argv);
int runDeform(int argc, char** argv);
int runVoxelize(int argc, char** argv);
int runView(int argc, char** argv); ///< in builds with the window

/// Gives `app` a flag for every option of a cage but those in `except`; it sets `options`. The flags in use and their
/// values, as given, are added to `words`, for another process that is to have the same.
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

/// What this process has used so far: "cpu_seconds" and "memory_peak_mib".
Json usage();

/// A line of /proc/self/status in MiB, as VmHWM.
double processMemory(const std::string& name);

/// What work has cost, in seconds: of the clock, and of all of the process's threads.
struct Cost {
    double wallSeconds = 0, cpuSeconds = 0;
};

/// What the process has cost since some fixed moment; only differences mean anything.
Cost costSoFar();

/// What it has cost since `before`.
Cost costSince(const Cost& before);

/// What `work` costs; to free what it returns is not part of it.
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

/// The least of each: times are only ever longer for what others do on the machine.
inline Cost leastOf(const Cost& a, const Cost& b)
{
    return {std::min(a.wallSeconds, b.wallSeconds), std::min(a.cpuSeconds, b.cpuSeconds)};
}

/// The least of several runs of `work`.
template <class Work>
Cost leastCost(int runs, const Work& work)
{
    Cost least = costOf(work);
    for (int i = 1; i < runs; ++i) least = leastOf(least, costOf(work));
    return least;
}

/// "wall_seconds" and "cpu_seconds".
Json toJson(const Cost& cost);

/// The stages by name: "stage_seconds" of wall clock, "stage_cpu_seconds" of all threads.
Json toJson(const std::vector<StageTime>& stages);

/// Runs this program again with `words` (the first is its name), in a process of its own, so that its peak memory and
/// its warm-up are its own. Returns what it prints. \throw Error if it fails
std::string runSelf(const std::vector<std::string>& words);

} // namespace vdbcage::bench
