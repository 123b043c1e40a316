#include "bench.h"

#include <algorithm>
#include <chrono>
#include <ctime>
#include <fstream>

#include <spawn.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <vdbcage/core/error.h>

extern char** environ;

namespace vdbcage::bench {

namespace {

double seconds(const timeval& time)
{
    return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
}

} // namespace

void addCageOptions(CLI::App& app, const std::vector<std::string>& except, CageOptions& options,
                    std::vector<std::string>& words)
{
    for (const OptionText& option : describeOptions()) {
        if (std::find(except.begin(), except.end(), option.name) != except.end()) continue;
        app.add_option_function<std::string>(
               "--" + option.name,
               [&options, &words, name = option.name](const std::string& value) {
                   setOption(options, name, value);
                   words.insert(words.end(), {"--" + name, value});
               },
               option.help + " [" + option.defaultValue + "]")
            ->type_name(option.value);
    }
}

void requirePositive(const char* option, int count)
{
    if (count < 1) throw InputError(option, std::to_string(count) + " is not allowed; at least 1");
}

Json usage()
{
    rusage used{};
    ::getrusage(RUSAGE_SELF, &used);
    // Not ru_maxrss: a child's begins with the memory that its parent held when it started.
    return {{"cpu_seconds", seconds(used.ru_utime) + seconds(used.ru_stime)},
            {"memory_peak_mib", processMemory("VmHWM")}};
}

double processMemory(const std::string& name)
{
    std::ifstream status("/proc/self/status");
    for (std::string word; status >> word;) {
        double kib = 0;
        if (word == name + ":" && status >> kib) return kib / 1024;
    }
    return 0;
}

Cost costSoFar()
{
    timespec cpu{};
    ::clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &cpu);
    const auto wall = std::chrono::steady_clock::now().time_since_epoch();
    return {std::chrono::duration<double>(wall).count(),
            static_cast<double>(cpu.tv_sec) + 1e-9 * static_cast<double>(cpu.tv_nsec)};
}

Cost costSince(const Cost& before)
{
    const Cost now = costSoFar();
    return {now.wallSeconds - before.wallSeconds, now.cpuSeconds - before.cpuSeconds};
}

Json toJson(const Cost& cost)
{
    return {{"wall_seconds", cost.wallSeconds}, {"cpu_seconds", cost.cpuSeconds}};
}

Json toJson(const std::vector<StageTime>& stages)
{
    Json json{{"stage_seconds", Json::object()}, {"stage_cpu_seconds", Json::object()}};
    for (const StageTime& stage : stages) {
        json["stage_seconds"][stage.name] = stage.seconds;
        json["stage_cpu_seconds"][stage.name] = stage.cpuSeconds;
    }
    return json;
}

std::string runSelf(const std::vector<std::string>& words)
{
    std::vector<char*> argv;
    for (const std::string& word : words) argv.push_back(const_cast<char*>(word.c_str()));
    argv.push_back(nullptr);
    int ends[2];
    if (::pipe(ends) != 0) throw Error("there is no pipe to be had");
    posix_spawn_file_actions_t actions;
    ::posix_spawn_file_actions_init(&actions);
    ::posix_spawn_file_actions_adddup2(&actions, ends[1], STDOUT_FILENO);
    ::posix_spawn_file_actions_addclose(&actions, ends[0]);
    ::posix_spawn_file_actions_addclose(&actions, ends[1]);
    pid_t child = -1;
    const bool started = ::posix_spawn(&child, "/proc/self/exe", &actions, nullptr, argv.data(), environ) == 0;
    ::posix_spawn_file_actions_destroy(&actions);
    ::close(ends[1]);
    std::string printed;
    char buffer[4096];
    for (ssize_t size = 0; started && (size = ::read(ends[0], buffer, sizeof buffer)) > 0;) {
        printed.append(buffer, static_cast<std::size_t>(size));
    }
    ::close(ends[0]);
    int status = 0;
    if (!started || ::waitpid(child, &status, 0) != child || status != 0) throw Error("a run failed");
    return printed;
}

} // namespace vdbcage::bench
