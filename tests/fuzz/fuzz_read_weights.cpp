// Any bytes at all, as weights of vdbcage or of others (.npy, .dmat), for one cage and model: one line that begins with
// the file's name, or a binding whose points at rest stay where they are.

#include <cstddef>
#include <cstdint>
#include <filesystem>

#include <fuzz/bytes.h>
#include <support/shapes.h>
#include <vdbcage/core/error.h>
#include <vdbcage/deform/weights_io.h>

using namespace vdbcage;
using fuzz::require;

namespace {

void read(const std::filesystem::path& path)
{
    static const Mesh cage = test::box({0, 0, 0}, {1, 1, 1});
    static const std::vector<openvdb::Vec3d> points{{0.25, 0.5, 0.5}, {0.5, 0.5, 0.75}, {0.5, 0.125, 0.5}};
    try {
        const Binding binding = readWeights(path, cage, points);
        require(binding.pose(cage.points) == points);
        std::vector<openvdb::Vec3d> moved = cage.points;
        for (openvdb::Vec3d& p : moved) p += openvdb::Vec3d(1, 0, 0);
        require(binding.pose(moved).size() == points.size());
    } catch (const IoError& error) {
        fuzz::requireOneLine(error.what());
        require(std::string_view(error.what()).rfind(path.string() + ": ", 0) == 0);
    }
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    const std::string bytes = fuzz::textOf(data, size);
    read(fuzz::file("weights.npy", bytes));
    read(fuzz::file("weights.dmat", bytes));
    return 0;
}
