// Any bytes at all, as a scene of the window that lies beside a model, cages and a pose: one line that names the file,
// or a state that is saved, opened and saved again as it was.

#include <cstddef>
#include <cstdint>
#include <filesystem>

#include <fuzz/bytes.h>
#include <support/shapes.h>
#include <tools/view/files/scene.h>
#include <vdbcage/core/error.h>
#include <vdbcage/mesh/mesh_io.h>

using namespace vdbcage;
using fuzz::require;

namespace {

/// What the scenes of the corpus name. The corpus has the digest of the model, so it is never written otherwise.
void writeFilesBeside(const std::filesystem::path& scene)
{
    fuzz::file("model.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n");
    writeMesh(test::box({-1, -1, -1}, {2, 2, 2}), view::cageBeside(scene));
    writeMesh(test::box({-1, -1, -1}, {2, 2, 2}), view::restBeside(scene, 0));
    writeMesh(test::box({-1, -1, -1}, {2, 2, 3}), view::poseBeside(scene, 0));
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    const std::filesystem::path path = fuzz::folder() / "a.json";
    static const bool isWritten = (writeFilesBeside(path), true);
    require(isWritten);
    fuzz::file("a.json", fuzz::textOf(data, size));
    view::State state;
    try {
        state = view::openScene(path);
    } catch (const InputError& error) {
        fuzz::requireOneLine(error.what());
        require(std::string_view(error.what()).rfind(fuzz::folder().string(), 0) == 0);
        return 0;
    } catch (const IoError& error) { // of any file that the scene names
        fuzz::requireOneLine(error.what());
        return 0;
    }
    const std::filesystem::path again = fuzz::folder() / "again.json";
    saveScene(state, nullptr, again);
    const std::string text = test::readText(again);
    const view::State opened = view::openScene(again);
    require(opened.view == state.view);
    require(view::areEqual(opened.document.options, state.document.options));
    saveScene(opened, nullptr, again);
    require(test::readText(again) == text);
    return 0;
}
