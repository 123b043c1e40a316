#pragma once

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

#include <sys/wait.h>

/// Observations of a command that was started.
namespace vdbcage::test {

inline std::filesystem::path procFolder(pid_t process)
{
    return "/proc/" + std::to_string(process);
}

/// Returns whether it has ended; its status can still be waited for.
inline bool hasEnded(pid_t process)
{
    siginfo_t info{};
    return ::waitid(P_PID, static_cast<id_t>(process), &info, WEXITED | WNOHANG | WNOWAIT) != 0 || info.si_pid != 0;
}

/// Returns the processor time that a process or thread has used, in clock ticks (hundredths of a second). `folder` is
/// its own in /proc; 0 if it is gone.
inline long ticks(const std::filesystem::path& folder)
{
    std::ifstream file(folder / "stat");
    std::string stat;
    std::getline(file, stat);
    std::istringstream in(stat.substr(std::min(stat.size(), stat.rfind(')') + 2)));
    std::string skipped;
    for (int i = 0; i < 11; ++i) in >> skipped;
    long user = 0, system = 0;
    in >> user >> system;
    return user + system;
}

} // namespace vdbcage::test
