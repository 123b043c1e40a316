#include <iomanip>
#include <iostream>
#include <optional>
#include <sstream>
#include <string>
#include <utility>

#include <tools/report/report.h>
#include <tools/report/run_facts.h>
#include <vdbcage/check/check.h>
#include <vdbcage/core/error.h>
#include <vdbcage/mesh/io/formats.h>
#include <vdbcage/mesh/mesh_io.h>
#include <vdbcage/surface/repair.h>

#include <tools/cli/arguments/talk_arguments.h>
#include <tools/cli/commands.h>
#include <tools/cli/interrupt.h>
#include <tools/cli/models.h>
#include <tools/cli/outputs.h>

namespace vdbcage::cli {

namespace {

report::Json toJson(const RepairMeasures& measures)
{
    return {{"faces", measures.faces}, {"parts", measures.parts}, {"area", measures.area}, {"volume", measures.volume}};
}

report::Json toJson(const RepairReport& report)
{
    return {{"merged_points", report.mergedPoints},
            {"removed_faces", report.removedFaces},
            {"hanging_faces", report.hangingFaces},
            {"split_vertices", report.splitVertices},
            {"stitched_edges", report.stitchedEdges},
            {"filled_holes", report.filledHoles},
            {"unfilled_holes", report.unfilledHoles},
            {"moved_points", report.movedPoints},
            {"cut_faces", report.cutFaces},
            {"self_intersections_before", report.selfIntersectionsBefore},
            {"self_intersections_after", report.selfIntersectionsAfter},
            {"reoriented", report.reoriented},
            {"before", toJson(report.before)},
            {"after", toJson(report.after)}};
}

/// Returns the defects that keep a mesh from being a valid cage.
std::string defects(const CageCheck& check)
{
    const std::pair<std::size_t, const char*> counts[] = {
        {check.boundaryEdges, "boundary edges"},        {check.nonManifoldEdges, "non-manifold edges"},
        {check.misorientedEdges, "misoriented edges"},  {check.nonManifoldVertices, "non-manifold vertices"},
        {check.inwardComponents, "inward components"},  {check.degenerateFaces, "degenerate faces"},
        {check.selfIntersections, "self-intersections"}};
    std::string text;
    for (const auto& [count, name] : counts) {
        if (count > 0) text += (text.empty() ? "" : ", ") + std::to_string(count) + ' ' + name;
    }
    return text;
}

/// Returns the repairs of the cage in words, with their numbers, as far as there are any.
std::string describe(const RepairReport& report)
{
    std::ostringstream text;
    text << std::setprecision(4);
    const report::Json facts = toJson(report);
    for (const auto& measure : facts["before"].items()) {
        const report::Json& after = facts["after"][measure.key()];
        text << "  " << measure.key() << ": ";
        if (after.is_number_float()) {
            text << measure.value().get<double>() << " -> " << after.get<double>() << '\n';
        } else {
            text << measure.value() << " -> " << after << '\n';
        }
    }
    for (const auto& fact : facts.items()) {
        const bool isSaid = fact.value().is_boolean() ? fact.value().get<bool>() : fact.value() != 0;
        if (!fact.value().is_object() && isSaid) text << "  " << fact.key() << ": " << fact.value() << '\n';
    }
    return text.str();
}

bool areEqual(const Mesh& a, const Mesh& b)
{
    return a.points == b.points && a.triangles == b.triangles && a.quads == b.quads;
}

} // namespace

int runRepair(Call call)
{
    std::filesystem::path cagePath, outputPath, reportPath;
    CLI::App app("vdbcage repair CAGE -o OUT [OPTIONS]\n"
                 "Stitches, orients, fills holes and resolves self-intersections.\n"
                 "Exit status 2: OUT is mended as far as possible, but no valid cage.",
                 "repair");
    app.add_option("cage", cagePath)->required()->type_name("CAGE");
    app.add_option("-o,--output", outputPath, "the mended cage to write")->required()->type_name("OUT");
    app.add_option("--report", reportPath, "the repairs and remaining faults, as JSON")->type_name("FILE.json");
    const TalkArguments talk(app);
    const std::vector<std::string> arguments = call.words;
    if (!parse(app, std::move(call))) return exitGood;
    if (!hasRepair())
        throw InputError("this vdbcage was built without its GPL part (VDBCAGE_WITH_CGAL_GPL), and so without repair");
    detail::requireMeshExtension(outputPath);
    Outputs outputs;
    outputs.reads(cagePath);
    outputs.writes(outputPath);
    if (!reportPath.empty()) outputs.writes(reportPath);

    std::optional<Progress> progress(talk.progressForm());
    const MeshFile cage = readMeshFile(cagePath);
    // The cage as the output's format stores it: roundings and losses are mended too.
    const Mesh given = detail::parseMesh(bytesOf(cage.mesh, outputPath), outputPath).mesh;
    const RepairedCage mended = repair(given, &*progress);
    const std::string bytes = bytesOf(mended.cage, outputPath);
    // The verdict is on the written cage alone: any model does.
    CheckOptions unmeasured;
    unmeasured.measure = false;
    const CageCheck check = checkCage(detail::parseMesh(bytes, outputPath).mesh, given, unmeasured, &*progress);
    const bool isValid = check.valid();
    outputs.add(outputPath, [&](std::ostream& out) { out << bytes; });
    if (!reportPath.empty()) {
        report::Json facts = report::runFacts("repair", arguments);
        facts["cage"] = cagePath.string();
        facts["cage_warnings"] = cage.summary.warnings;
        facts["repaired"] = outputPath.string();
        facts["valid"] = isValid;
        facts["repair"] = toJson(mended.report);
        outputs.add(reportPath, [&](std::ostream& out) { out << report::toText(facts); });
    }
    progress->succeed();
    progress.reset();
    if (!talk.quiet()) {
        std::cout << printable(outputPath) << ": " << (isValid ? "a valid cage" : "not a valid cage: " + defects(check))
                  << '\n';
        if (areEqual(mended.cage, given)) {
            std::cout << (isValid ? "  nothing had to be mended" : "  nothing could be mended")
                      << ": it is the same mesh\n";
        } else {
            std::cout << describe(mended.report);
        }
        if (!isValid) {
            std::cout << "  a new cage around it is made by: vdbcage make " << printable(cagePath) << " -o CAGE\n";
        }
        flushOutput();
    }
    outputs.commit();
    if (!talk.quiet()) std::cerr << report::warningLines(cagePath, cage.summary);
    return isValid ? exitGood : exitNotBounding;
}

} // namespace vdbcage::cli
