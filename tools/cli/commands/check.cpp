#include <iostream>
#include <optional>

#include <tools/cli/models.h>
#include <tools/report/run_facts.h>
#include <vdbcage/check/check.h>
#include <vdbcage/core/range.h>
#include <vdbcage/mesh/io/formats.h>
#include <vdbcage/mesh/parts.h>

#include <tools/cli/arguments/talk_arguments.h>
#include <tools/cli/commands.h>
#include <tools/cli/interrupt.h>
#include <tools/cli/outputs.h>

namespace vdbcage::cli {

int runCheck(Call call)
{
    std::filesystem::path cagePath, reportPath;
    std::vector<std::filesystem::path> modelPaths;
    CLI::App app("vdbcage check CAGE MODEL... [OPTIONS]\n"
                 "Examines a cage against its models, together and each alone.\n"
                 "Exit status 2: it is not a valid cage, or does not bound them.",
                 "check");
    app.add_option("cage", cagePath)->required()->type_name("CAGE");
    app.add_option("models", modelPaths)->required()->type_name("MODEL...");
    app.add_option("--report", reportPath, "the verdict as JSON")->type_name("FILE.json");
    double leastPart = 0;
    app.add_option("--least-part", leastPart, "leaves smaller parts out, 0 to 1 [0]")->type_name("F");
    const TalkArguments talk(app);
    const std::vector<std::string> arguments = call.words;
    if (!parse(app, std::move(call))) return exitGood;
    requireWithin({0, 1}, leastPart, "--least-part");
    Outputs outputs;
    outputs.reads(cagePath);
    for (const std::filesystem::path& model : modelPaths) outputs.reads(model);
    if (!reportPath.empty()) outputs.writes(reportPath);

    std::optional<Progress> progress(talk.progressForm());
    const std::string cageFile = detail::readMeshBytes(cagePath);
    const MeshFile cageRead = detail::parseMesh(cageFile, cagePath);
    const Mesh& cage = cageRead.mesh;
    std::vector<ModelFile> models = readModels(modelPaths, reportPath.empty() ? Hashes::none : Hashes::sha256);
    Mesh model = takeMesh(models);
    LargeParts parts;
    if (leastPart > 0) {
        parts = largeParts(model, leastPart);
        model = std::move(parts.mesh);
    }
    const CageCheck check = checkCage(cage, model, {}, &*progress);
    checkEach(models, cage, parts.leastSide, &*progress);
    if (!reportPath.empty()) {
        report::Json report = report::runFacts("check", arguments);
        report["models"] = entryOf(models);
        report["cage"] = cagePath.string();
        report["cage_sha256"] = report::sha256Of(cageFile);
        report["cage_warnings"] = cageRead.summary.warnings;
        report["quads"] = cage.quads.empty() ? report::Json() : report::toJson(report::quadQuality(cage));
        report["parts_left_out"] = parts.partsLeftOut;
        report["faces_left_out"] = parts.facesLeftOut;
        report["check"] = report::toJson(check);
        outputs.add(reportPath, [&](std::ostream& out) { out << report::toText(report); });
    }
    progress->succeed();
    progress.reset();
    if (!talk.quiet()) {
        std::cout << printable(cagePath) << ": " << verdict(check) << '\n' << describe(models);
        if (parts.partsLeftOut > 0) {
            std::cout << "  left out, so not looked at: " << parts.partsLeftOut << " small parts with "
                      << parts.facesLeftOut << " faces\n";
        }
        std::cout << report::describe(check) << report::warningLines(cagePath, cageRead.summary)
                  << warningLines(models);
        flushOutput();
    }
    outputs.commit();
    return check.bounding() ? exitGood : exitNotBounding;
}

} // namespace vdbcage::cli
