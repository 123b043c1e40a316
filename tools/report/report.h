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

/// JSON forms of what is reported, as REPORT.md has them. Lengths are fractions of the model's longest side.
Json toJson(const CageCheck& check);
Json toJson(const QuadQuality& quality);
Json toJson(const CageReport& report);
Json toJson(const Mesh& mesh, const ReadSummary& summary, const std::filesystem::path& path);
Json toJson(const std::vector<StageTime>& stages);
Json toJson(const CageOptions& options);

/// What was asked for, by the command or in the window.
struct CageOrder {
    std::vector<std::string> arguments; ///< see runFacts()
    Json models;                        ///< see cli::entryOf()
    std::string inputs;                 ///< cli::fingerprint() of what it was to be made from; empty: not known
    std::filesystem::path cage;         ///< where it is, or will be, written; empty: nowhere
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
/// What `make --report` tells.
Json reportOf(const CageOrder& order, const CageMade& made);
/// The same of an order that failed, for `error`, with an exit status.
Json reportOf(const CageOrder& order, const std::string& error, int status);

/// Largest amount of memory this process has held, in MiB.
double peakMemory();

/// `report` as indented text with a last line break.
std::string toText(const Json& report);

/// The verdict in words, one line a finding, for a person.
std::string describe(const CageCheck& check);
/// How the cage came about, where that is worth telling: what it was shrunk from and why, its symmetry, what made its
/// voxels, parts and handles. One line each, without a line break.
std::vector<std::string> remarks(const CageReport& report, const CageOptions& options);
/// What the file has otherwise than its format: "  warning: FILE: line 7: ...", one line each with its end.
std::string warningLines(const std::filesystem::path& path, const ReadSummary& summary);

} // namespace vdbcage::report
