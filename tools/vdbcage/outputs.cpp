#include "outputs.h"

#include <string>
#include <system_error>

#include <unistd.h>

#include <vdbcage/core/atomic_file.h>
#include <vdbcage/core/error.h>

namespace vdbcage::tool {

namespace fs = std::filesystem;

Outputs::~Outputs()
{
    std::error_code ignored;
    for (const auto& file : files_) fs::remove(file.first, ignored);
    for (auto folder = folders_.rbegin(); folder != folders_.rend(); ++folder) fs::remove(*folder, ignored);
}

void Outputs::addFolder(const fs::path& path)
{
    std::error_code error;
    if (fs::is_directory(path, error)) return;
    if (!fs::create_directory(path, error)) {
        throw IoError(path.string() +
                      ": the folder cannot be made: " + (error ? error.message() : "something else has that name"));
    }
    folders_.push_back(path);
}

void Outputs::add(const fs::path& path, const Writer& write)
{
    requireWritable(path);
    // Unique among processes by its number, within this one by the count of files.
    const fs::path temporary = path.parent_path() / ("." + path.stem().string() + "." + std::to_string(::getpid()) +
                                                     "." + std::to_string(files_.size()) + path.extension().string());
    files_.emplace_back(temporary, path);
    try {
        write(temporary);
    } catch (const IoError& error) {
        // The user knows the file by its final name.
        std::string text = error.what();
        const std::string name = temporary.string();
        for (std::size_t at = text.find(name); at != std::string::npos; at = text.find(name)) {
            text.replace(at, name.size(), path.string());
        }
        throw IoError(text);
    }
}

void Outputs::commit()
{
    for (const auto& file : files_) {
        std::error_code error;
        fs::rename(file.first, file.second, error);
        if (error) throw IoError(file.second.string() + ": cannot be written: " + error.message());
    }
    files_.clear();
    folders_.clear();
}

} // namespace vdbcage::tool
