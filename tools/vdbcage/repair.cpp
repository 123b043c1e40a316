#include <iostream>
#include <optional>
#include <sstream>

#include <tools/report/report.h>
#include <tools/report/run_facts.h>
#include <vdbcage/check/check.h>
#include <vdbcage/core/error.h>
#include <vdbcage/mesh/io/formats.h>
#include <vdbcage/mesh/mesh_io.h>
#include <vdbcage/surface/repair.h>

#include "commands.h"
#include "interrupt.h"
#include "outputs.h"
#include "talk_arguments.h"

namespace vdbcage::tool {

namespace {

Json toJson(const RepairReport& report)
{
    return {{"merged_points", report.mergedPoints},
            {"removed_faces", report.removedFaces},
            {"split_vertices", report.splitVertices},
            {"stitched_edges", report.stitchedEdges},
            {"filled_holes", report.filledHoles},
            {"unfilled_holes", report.unfilledHoles},
            {"self_intersections_before", report.selfIntersectionsBefore},
            {"self_intersections_after", report.selfIntersectionsAfter},
            {"reoriented", report.reoriented}};
}

} // namespace

int runRepair(Call call)
{
    std::filesystem::path cagePath, outputPath, reportPath;
    CLI::App app("vdbcage repair CAGE -o OUT [OPTIONS]\n"
                 "Stitches, orients, fills holes and removes self-intersections.\n"
                 "The result is triangles.",
                 "repair");
    app.add_option("cage", cagePath)->required()->type_name("CAGE");
    app.add_option("-o,--output", outputPath, "the mended cage to write")->required()->type_name("OUT");
    app.add_option("--report", reportPath, "what was done and what could not be, as JSON")->type_name("FILE.json");
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
    const RepairedCage mended = repair(cage.mesh, &*progress);
    outputs.add(outputPath, [&](std::ostream& out) { writeMesh(mended.cage, out, outputPath); });
    if (!reportPath.empty()) {
        Json facts = runFacts("repair", arguments);
        facts["cage"] = cagePath.string();
        facts["cage_warnings"] = cage.summary.warnings;
        facts["repaired"] = outputPath.string();
        facts["repair"] = toJson(mended.report);
        outputs.add(reportPath, [&](std::ostream& out) { out << toText(facts); });
    }
    std::ostringstream lines;
    if (!talk.quiet()) {
        const Json facts = toJson(mended.report);
        for (const auto& fact : facts.items()) lines << "  " << fact.key() << ": " << fact.value() << '\n';
        lines << warningLines(cagePath, cage.summary);
    }
    const std::string text = lines.str();
    outputs.commit();
    progress->succeed();
    progress.reset();
    std::cerr << text;
    return exitGood;
}

} // namespace vdbcage::tool
