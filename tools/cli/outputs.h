#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <tuple>
#include <vector>

#include <vdbcage/core/detail/atomic_file.h>

#include <tools/cli/interrupt.h>

namespace vdbcage::cli {

/// All files that one command writes: they appear together at the end, or none does. The command first says what it
/// reads and writes; no output may be an input or another output, by whatever name.
class Outputs {
public:
    Outputs() = default;
    ~Outputs();
    Outputs(const Outputs&) = delete;
    Outputs& operator=(const Outputs&) = delete;

    /// Says that the command reads `path`, which need not exist. All inputs come before all outputs.
    void reads(const std::filesystem::path& path);
    /// Says that files will be written into the folder `path`, which is made if it does not exist. \throw IoError
    void writesInto(const std::filesystem::path& path);
    /// Says that the command writes `path`. \throw IoError if that cannot be done; InputError if it is an input or is
    /// written already
    void writes(const std::filesystem::path& path);

    /// Writes one of the files under a temporary name. From here on signals wait, and end the command by Cancelled
    /// between two files. \throw IoError naming `path`; Cancelled
    void add(const std::filesystem::path& path, const FileWriter& write);
    /// Gives every file its name. \throw IoError; Cancelled
    void commit();

    /// Takes away what has been written and not committed, for a sudden end of the process. Allocates nothing.
    static void abandon() noexcept;

private:
    /// What a path leads to, whether it exists or not: the nearest folder that does, and the names below it.
    using Identity = std::tuple<unsigned long long, unsigned long long, std::filesystem::path>;
    static Identity identityOf(const std::filesystem::path& path);

    /// Folders that go again, if they are empty.
    struct MadeFolders {
        MadeFolders() = default;
        ~MadeFolders() { remove(); }
        void remove() noexcept;
        MadeFolders(const MadeFolders&) = delete;
        MadeFolders& operator=(const MadeFolders&) = delete;
        std::vector<std::filesystem::path> paths;
    };

    std::optional<SignalHold> hold_;
    std::map<Identity, std::filesystem::path> known_; // the name of an input; none of an output
    std::vector<std::filesystem::path> toMake_;       // folders
    MadeFolders made_;
    PendingFiles files_; // goes before the folders that it is in
};

} // namespace vdbcage::cli
