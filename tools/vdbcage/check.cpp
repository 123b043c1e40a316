#include <iostream>
#include <optional>

#include <tools/report/report.h>
#include <vdbcage/check/check.h>
#include <vdbcage/core/version.h>
#include <vdbcage/mesh/mesh_io.h>

#include "commands.h"
#include "interrupt.h"
#include "outputs.h"

namespace vdbcage::tool {

int runCheck(std::vector<std::string> words)
{
    std::filesystem::path cagePath, modelPath, reportPath;
    bool quiet = false;
    CLI::App app("vdbcage check CAGE MODEL [OPTIONS]\n"
                 "Examines a cage against its model.\n"
                 "Exit status 2: it is not a valid cage, or does not bound the model.",
                 "check");
    app.add_option("cage", cagePath)->required()->type_name("CAGE");
    app.add_option("model", modelPath)->required()->type_name("MODEL");
    app.add_option("--report", reportPath, "the verdict as JSON")->type_name("FILE.json");
    app.add_flag("-q,--quiet", quiet, "print nothing, only exit");
    if (!parse(app, std::move(words))) return exitGood;
    Outputs outputs;
    outputs.reads(cagePath);
    outputs.reads(modelPath);
    if (!reportPath.empty()) outputs.writes(reportPath);

    std::optional<Progress> progress(verbosityOf(quiet));
    const Mesh cage = readMesh(cagePath);
    const MeshFile file = readMeshFile(modelPath);
    const CageCheck check = checkCage(cage, file.mesh, {}, &*progress);
    if (!reportPath.empty()) {
        const Json report{{"vdbcage", VDBCAGE_VERSION},
                          {"cage", cagePath.string()},
                          {"model", toJson(file.mesh, file.summary, modelPath)},
                          {"check", toJson(check)}};
        outputs.add(reportPath, [&](std::ostream& out) { out << toText(report); });
    }
    progress.reset();
    if (!quiet) {
        std::cout << printable(cagePath) << ": "
                  << (check.bounding() ? "bounding"
                      : check.valid()  ? "NOT bounding"
                                       : "NOT a valid cage")
                  << '\n'
                  << describe(file.summary) << describe(check);
        flushOutput();
    }
    outputs.commit();
    return check.bounding() ? exitGood : exitNotBounding;
}

} // namespace vdbcage::tool
