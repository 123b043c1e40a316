#pragma once

#include <filesystem>
#include <functional>
#include <utility>
#include <vector>

namespace vdbcage::tool {

/// All files that one command writes: they appear together at the end, or none does.
class Outputs {
public:
    using Writer = std::function<void(const std::filesystem::path&)>;

    Outputs() = default;
    ~Outputs();
    Outputs(const Outputs&) = delete;
    Outputs& operator=(const Outputs&) = delete;

    /// Makes sure that the folder `path` exists; one that is made here goes again unless the outputs are committed.
    /// \throw IoError
    void addFolder(const std::filesystem::path& path);
    /// Has `write` write a temporary file beside `path`, with the same extension. \throw IoError naming `path`
    void add(const std::filesystem::path& path, const Writer& write);
    /// Gives every file its name. \throw IoError
    void commit();

private:
    std::vector<std::pair<std::filesystem::path, std::filesystem::path>> files_; // temporary, final
    std::vector<std::filesystem::path> folders_;
};

} // namespace vdbcage::tool
