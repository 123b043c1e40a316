#include <tools/files/posed_cage.h>

#include <tools/files/naming_files.h>

namespace vdbcage::files {

PosedPoints posedPointsOf(const std::filesystem::path& path, const Mesh& posed, const Mesh& cage)
{
    return namingFiles({{"posed cage", path.string()}}, [&] { return posedPoints(cage, posed); });
}

std::string describeOrder(const std::filesystem::path& path, std::size_t reordered, std::size_t frames)
{
    if (reordered == 0) return {};
    const std::string which =
        frames == 1 ? "" : std::to_string(reordered) + " of " + std::to_string(frames) + " frames: ";
    return path.string() + ": " + which + "the points are in another order than the cage's; matched by the faces";
}

} // namespace vdbcage::files
