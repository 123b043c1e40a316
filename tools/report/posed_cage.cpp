#include <tools/report/posed_cage.h>

#include <vdbcage/core/error.h>

namespace vdbcage::tool {

void requireSameFaces(const std::filesystem::path& posedPath, const Mesh& posed, const std::string& cageName,
                      const Mesh& cage)
{
    const auto triangles = [](const Mesh& mesh) { return mesh.triangles.size() + 2 * mesh.quads.size(); };
    const auto counts = [](const Mesh& mesh) {
        return std::to_string(mesh.points.size()) + " points, " + std::to_string(mesh.triangles.size()) +
               " triangles and " + std::to_string(mesh.quads.size()) + " quads";
    };
    if (posed.points.size() != cage.points.size() || triangles(posed) != triangles(cage)) {
        throw InputError(posedPath.string() + ": has " + counts(posed) + "; " + cageName + " has " + counts(cage));
    }
}

} // namespace vdbcage::tool
