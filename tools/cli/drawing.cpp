#include <tools/cli/drawing.h>

#include <vdbcage/core/error.h>

namespace vdbcage::cli {

void requirePngExtension(const std::filesystem::path& path)
{
    if (path.extension() != ".png") {
        throw InputError(path.string(), "pictures are written as .png; the name must end so");
    }
}

Picture drawCage(const Mesh& model, const Mesh& cage)
{
    Scene scene;
    scene.panels = {{shadedLayer(model), wireframeLayer(cage)}};
    return renderScene(scene, 1200, 900);
}

} // namespace vdbcage::cli
