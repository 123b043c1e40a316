#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <support/temporary_folder.h>

extern char** environ;

namespace vdbcage::test {

struct CommandResult {
    int status = -1; ///< exit status; 128 + n if signal n ended it
    std::string out, err;
};

/// Starts `words` (the program first) with standard output and error going to files `out` and `err`.
inline pid_t startCommand(const std::vector<std::string>& words, const std::filesystem::path& out,
                          const std::filesystem::path& err)
{
    std::vector<char*> argv;
    for (const std::string& word : words) argv.push_back(const_cast<char*>(word.c_str()));
    argv.push_back(nullptr);
    posix_spawn_file_actions_t actions;
    ::posix_spawn_file_actions_init(&actions);
    ::posix_spawn_file_actions_addopen(&actions, 0, "/dev/null", O_RDONLY, 0);
    ::posix_spawn_file_actions_addopen(&actions, 1, out.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0644);
    ::posix_spawn_file_actions_addopen(&actions, 2, err.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0644);
    pid_t child = -1;
    const int error = ::posix_spawnp(&child, argv[0], &actions, nullptr, argv.data(), environ);
    ::posix_spawn_file_actions_destroy(&actions);
    if (error != 0) throw std::runtime_error("cannot start " + words.front());
    return child;
}

inline int waitFor(pid_t child)
{
    int status = 0;
    ::waitpid(child, &status, 0);
    return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

inline CommandResult runCommand(const std::vector<std::string>& words)
{
    const TemporaryFolder folder;
    CommandResult result;
    result.status = waitFor(startCommand(words, folder / "out", folder / "err"));
    result.out = readText(folder / "out");
    result.err = readText(folder / "err");
    return result;
}

} // namespace vdbcage::test
