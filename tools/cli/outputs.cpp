#include <tools/cli/outputs.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <iostream>
#include <system_error>

#include <sys/stat.h>
#include <unistd.h>

#include <vdbcage/core/detail/io_failure.h>
#include <vdbcage/core/error.h>

namespace vdbcage::cli {

namespace fs = std::filesystem;

namespace {

// A command has one Outputs. A handler that ends the process can use only static storage.
std::atomic<Outputs*> pending{nullptr};

std::string notMade(const fs::path& path)
{
    return path.string() + ": the folder cannot be made";
}

fs::path folderOf(const fs::path& path)
{
    return path.has_parent_path() ? path.parent_path() : fs::path(".");
}

} // namespace

void Outputs::MadeFolders::remove() noexcept
{
    for (auto folder = paths.rbegin(); folder != paths.rend(); ++folder) ::rmdir(folder->c_str());
}

Outputs::~Outputs()
{
    pending = nullptr;
}

void Outputs::abandon() noexcept
{
    Outputs* const outputs = pending.exchange(nullptr);
    if (!outputs) return;
    outputs->files_.clear();
    outputs->made_.remove();
}

Outputs::Identity Outputs::identityOf(const fs::path& path)
{
    std::error_code error;
    // Absolute first: a relative path without a target would stay relative.
    const fs::path absolute = fs::absolute(path, error);
    fs::path existing = fs::weakly_canonical(absolute, error);
    if (error) existing = absolute.lexically_normal();
    fs::path below;
    for (;;) {
        struct stat status {};
        if (::stat(existing.c_str(), &status) == 0) return {status.st_dev, status.st_ino, below};
        if (!existing.has_relative_path()) return {0, 0, path};
        below = below.empty() ? existing.filename() : existing.filename() / below;
        existing = existing.parent_path();
    }
}

void Outputs::reads(const fs::path& path)
{
    known_.emplace(identityOf(path), path);
}

void Outputs::writesInto(const fs::path& given)
{
    const fs::path path = given.has_filename() ? given : given.parent_path(); // without the last slash
    std::error_code error;
    const fs::file_status status = fs::status(path, error);
    if (fs::is_directory(status)) return;
    if (error && error.value() != ENOENT) detail::throwIoError(notMade(path), error.value());
    if (fs::exists(status)) throw IoError(notMade(path) + ": something else has that name");
    const fs::path folder = folderOf(path);
    if (!fs::is_directory(folder, error))
        throw IoError(notMade(path) + ": the folder " + folder.string() + " does not exist");
    if (::access(folder.c_str(), W_OK) != 0) detail::throwIoError(notMade(path), errno);
    toMake_.push_back(path);
}

void Outputs::writes(const fs::path& path)
{
    const Identity folder = identityOf(folderOf(path));
    const bool isFolderMade =
        std::any_of(toMake_.begin(), toMake_.end(), [&](const fs::path& made) { return identityOf(made) == folder; });
    if (!isFolderMade) requireWritable(path);
    const auto [known, isFirst] = known_.emplace(identityOf(path), fs::path());
    if (isFirst) return;
    throw InputError(path.string(), "this file is named twice; " + (known->second.empty()
                                                                        ? "all outputs must be different files"
                                                                        : "it is the input " + known->second.string() +
                                                                              ", which would be overwritten"));
}

void Outputs::add(const fs::path& path, const FileWriter& write)
{
    if (!hold_) hold_.emplace();
    pending = this;
    if (signalled()) throw Cancelled();
    for (const fs::path& folder : toMake_) {
        std::error_code error;
        made_.paths.push_back(folder);
        if (!fs::create_directory(folder, error)) made_.paths.pop_back();
        if (error) detail::throwIoError(notMade(folder), error.value());
    }
    toMake_.clear();
    files_.add(path, write);
    if (signalled()) throw Cancelled();
}

void Outputs::commit()
{
    if (signalled()) throw Cancelled();
    files_.commit();
    made_.paths.clear();
    ignoreSignals();
}

void flushOutput()
{
    errno = 0;
    std::cout.flush();
    if (std::cout) return;
    detail::throwIoError("standard output: cannot be written", errno);
}

} // namespace vdbcage::cli
