#include <tools/files/posed_cage.h>

#include <vdbcage/core/error.h>

namespace vdbcage::files {

std::string namingFile(const std::string& text, const std::map<std::string, std::filesystem::path>& files)
{
    const std::size_t colon = text.find(": ");
    const auto file = files.find(text.substr(0, colon));
    return colon == std::string::npos || file == files.end() ? text : file->second.string() + text.substr(colon);
}

PosedPoints posedPointsOf(const std::filesystem::path& path, const Mesh& posed, const Mesh& cage)
{
    const std::map<std::string, std::filesystem::path> files{{"posed cage", path}};
    try {
        return posedPoints(cage, posed);
    } catch (const InputError& error) {
        throw InputError(namingFile(error.what(), files));
    }
}

std::string describeOrder(const std::filesystem::path& path, std::size_t reordered, std::size_t frames)
{
    if (reordered == 0) return {};
    const std::string which =
        frames == 1 ? "" : std::to_string(reordered) + " of " + std::to_string(frames) + " frames: ";
    return path.string() + ": " + which + "the points are in another order than the cage's; matched by the faces";
}

} // namespace vdbcage::files
