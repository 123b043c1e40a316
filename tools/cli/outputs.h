#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <tuple>
#include <vector>

#include <vdbcage/core/detail/atomic_file.h>

#include <tools/cli/interrupt.h>

namespace vdbcage::cli {

/// All files that one command writes: they appear together at the end, or none does. The command first declares its
/// inputs and outputs; no output may be an input or another output, by whatever name.
class Outputs {
public:
    Outputs() = default;
    ~Outputs();
    Outputs(const Outputs&) = delete;
    Outputs& operator=(const Outputs&) = delete;

    /// Declares that the command reads `path`, which need not exist. All inputs come before all outputs.
    void reads(const std::filesystem::path& path);
    /// Declares that files will be written into the folder `path`, which is made if it does not exist. \throw IoError
    void writesInto(const std::filesystem::path& path);
    /// Declares that the command writes `path`. \throw IoError if that is impossible; InputError if it is an input or
    /// declared already
    void writes(const std::filesystem::path& path);

    /// Writes a file under a temporary name. From here on signals wait, and end the command by Cancelled between two
    /// files. \throw IoError naming `path`; Cancelled
    void add(const std::filesystem::path& path, const FileWriter& write);
    /// Gives all files their names. \throw IoError; Cancelled
    void commit();

    /// Removes written files that are not committed, for a sudden end of the process. Allocates nothing.
    static void abandon() noexcept;

private:
    /// The target of a path, whether it exists or not: the nearest folder that does, and the names below it.
    using Identity = std::tuple<unsigned long long, unsigned long long, std::filesystem::path>;
    static Identity identityOf(const std::filesystem::path& path);

    /// Folders that are removed at the end if they are empty.
    struct MadeFolders {
        MadeFolders() = default;
        ~MadeFolders() { remove(); }
        void remove() noexcept;
        MadeFolders(const MadeFolders&) = delete;
        MadeFolders& operator=(const MadeFolders&) = delete;
        std::vector<std::filesystem::path> paths;
    };

    std::optional<SignalHold> hold_;
    std::map<Identity, std::filesystem::path> known_; // the names of inputs; empty for outputs
    std::vector<std::filesystem::path> toMake_;       // folders
    MadeFolders made_;
    PendingFiles files_; // destroyed before the folders that it is in
};

/// Flushes standard output. \throw IoError if the text does not arrive
void flushOutput();

} // namespace vdbcage::cli
