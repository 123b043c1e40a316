#include <tools/cli/commands/compare_families.h>

#include <array>
#include <cstdio>
#include <list>
#include <optional>

#include <vdbcage/core/error.h>
#include <vdbcage/deform/distortion.h>
#include <vdbcage/deform/inversions.h>

#include <tools/cli/render.h>

namespace vdbcage::cli {

namespace {

std::string lineOf(const std::array<std::string, 5>& cells)
{
    std::array<char, 128> line{};
    std::snprintf(line.data(), line.size(), "%-10s %10s %10s %10s %10s\n", cells[0].c_str(), cells[1].c_str(),
                  cells[2].c_str(), cells[3].c_str(), cells[4].c_str());
    return line.data();
}

std::string rounded(const char* format, double value)
{
    std::array<char, 64> text{};
    std::snprintf(text.data(), text.size(), format, value);
    return text.data();
}

/// Returns the number of triangles that the pose turns inside out; - if the family is not defined just below the
/// surface.
std::string invertedText(const Binding& binding, const Mesh& model, const Mesh& posed, Interrupter* interrupter)
{
    try {
        return std::to_string(invertedTriangles(binding, model, {posed.points}, interrupter).front().size());
    } catch (const InputError&) {
        return "-";
    }
}

} // namespace

FamilyComparison compareFamilies(const Mesh& cage, const Mesh& posed, const Mesh& model,
                                 const std::function<CoordinateOptions(Coordinates)>& optionsOf,
                                 Interrupter* interrupter)
{
    FamilyComparison comparison;
    comparison.table = lineOf({"family", "distortion", "99th pct", "volume", "inverted"});
    std::list<Mesh> models; // the panels point at them
    Scene scene;
    scene.sameView = true;
    std::optional<InputError> objection;
    for (const FamilyInfo& family : coordinateFamilies()) {
        try {
            const Binding binding(cage, model.points, optionsOf(family.family), interrupter);
            Mesh& moved = models.emplace_back(model);
            moved.points = binding.pose(posed.points);
            const Distortion distortion = poseDistortion(model, moved.points);
            comparison.table +=
                lineOf({family.name, rounded("%.3f", distortion.mean), rounded("%.3f", distortion.percentile99),
                        distortion.volume ? rounded("%.1f %%", 100 * *distortion.volume) : "-",
                        invertedText(binding, model, posed, interrupter)});
            scene.panels.push_back({shadedLayer(moved), wireframeLayer(posed)});
        } catch (const InputError& error) {
            objection = error;
            comparison.table += std::string(family.name) + ": " + error.what() + '\n';
        }
    }
    if (scene.panels.empty()) throw *objection;
    constexpr int side = 640;
    const int panels = static_cast<int>(scene.panels.size());
    while (scene.columns * scene.columns < panels) ++scene.columns;
    const int rows = (panels + scene.columns - 1) / scene.columns;
    comparison.sheet = renderScene(scene, side * scene.columns, side * rows);
    return comparison;
}

} // namespace vdbcage::cli
