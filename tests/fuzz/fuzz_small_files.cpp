// Any bytes at all, for every reader of small files that has no target of its own: presets, parameters of poses,
// preferences, recent files, reports of jobs, pictures. Each refuses them in one line, or takes them whole.

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>

#include <fuzz/bytes.h>
#include <support/shapes.h>
#include <tools/draw/picture.h>
#include <tools/report/job_results.h>
#include <tools/view/files/folder.h>
#include <tools/view/files/preferences.h>
#include <tools/view/state/pose_files.h>
#include <tools/view/state/preset.h>
#include <vdbcage/core/error.h>

using namespace vdbcage;
using fuzz::require;

namespace {

void orRefused(const std::function<void()>& read)
{
    try {
        read();
    } catch (const InputError& error) {
        fuzz::requireOneLine(error.what());
    } catch (const IoError& error) {
        fuzz::requireOneLine(error.what());
    }
}

void readPreset(const std::string& text)
{
    const CageOptions options = view::optionsOf(text, "fuzz");
    const std::string again = view::presetText(options);
    require(view::areEqual(view::optionsOf(again, "again"), options));
}

void readParameters(const std::filesystem::path& path)
{
    const auto cage =
        std::make_shared<view::PosableCage>(std::make_shared<const Mesh>(test::box({0, 0, 0}, {1, 1, 1})));
    const view::Document document = view::withOpenedPoses({}, cage, path, 3);
    require(document.poses.keys().size() == 2);
    for (const view::PoseKey& key : document.poses.keys()) {
        if (!key.pose) continue; // at rest
        for (const openvdb::Vec3d& p : key.pose->points) require(p.isFinite());
    }
}

void readReport(const std::filesystem::path& path)
{
    const auto results = report::readJobResults({path});
    require(results.size() == 1);
    require(!report::tableOf(results).empty() && !report::csvOf(results).empty() && !report::sumOf(results).empty());
}

void readPicture(const std::string& bytes)
{
    const draw::Picture picture = draw::decodePng(bytes, "fuzz");
    require(picture.width > 0 && picture.height > 0);
    require(picture.rgb.size() == std::size_t(3) * std::size_t(picture.width) * std::size_t(picture.height));
    if (picture.rgb.size() > 100000) return; // would take its time
    require(draw::decodePng(draw::encodePng(picture), "again").rgb == picture.rgb);
    const draw::Picture small = draw::smaller(picture, 7);
    require(small.rgb.size() == std::size_t(3) * std::size_t(small.width) * std::size_t(small.height));
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    const std::string bytes = fuzz::textOf(data, size);
    const std::filesystem::path path = fuzz::file("a.param", bytes);
    orRefused([&] { readPreset(bytes); });
    orRefused([&] { readParameters(path); });
    orRefused([&] { readReport(path); });
    orRefused([&] { readPicture(bytes); });
    // These two take what they understand.
    view::readPreferences(path);
    require(view::recentFiles(path).size() <= 10);
    return 0;
}
