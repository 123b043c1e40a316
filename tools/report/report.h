#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>
#include <tools/report/quad_quality.h>
#include <vdbcage/check/check.h>
#include <vdbcage/core/interrupter.h>
#include <vdbcage/mesh/mesh_io.h>
#include <vdbcage/pipeline/pipeline.h>

namespace vdbcage::report {

using Json = nlohmann::ordered_json;

/// Return JSON forms, as REPORT.md describes them. Lengths are fractions of the model's longest side.
Json toJson(const CageCheck& check);
Json toJson(const QuadQuality& quality);
Json toJson(const CageReport& report);
Json toJson(const Mesh& mesh, const ReadSummary& summary, const std::filesystem::path& path);
Json toJson(const std::vector<StageTime>& stages);
Json toJson(const CageOptions& options);

/// The order of a cage, by the command or in the window.
struct CageOrder {
    std::vector<std::string> arguments; ///< see runFacts()
    Json models;                        ///< see cli::entryOf()
    std::string inputs;                 ///< cli::fingerprint() of its inputs; empty: not known
    std::filesystem::path cage;         ///< the file that it is, or will be, written to; empty: none
    const CageOptions& options;
};
/// A cage that was made.
struct CageMade {
    const Mesh& cage;
    std::string sha256; ///< of its file; empty: there is none
    double seconds = 0; ///< wall clock
    const std::vector<StageTime>& stages;
    const CageReport& report;
};
/// Returns the content of `make --report`.
Json reportOf(const CageOrder& order, const CageMade& made);
/// Returns the same for an order that failed by `error`, with an exit status.
Json reportOf(const CageOrder& order, const std::string& error, int status);

/// Returns the largest amount of memory that this process has held, in MiB.
double peakMemory();

/// Returns `report` as indented text with a last line break.
std::string toText(const Json& report);

/// Returns the verdict in words, a line for each finding.
std::string describe(const CageCheck& check);
/// Returns remarks on how the cage came about: its start and the reason for it, its symmetry, the voxelizer, parts and
/// handles. One line each, without a line break.
std::vector<std::string> remarks(const CageReport& report, const CageOptions& options);
/// Returns the file's deviations from its format: "  warning: FILE: line 7: ...", one line each with its end.
std::string warningLines(const std::filesystem::path& path, const ReadSummary& summary);

} // namespace vdbcage::report
