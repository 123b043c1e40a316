#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace vdbcage::report {

/// The content of a report of `make` or `fit`.
struct JobResult {
    std::filesystem::path report; ///< the file
    std::string cage;             ///< as the report names it
    std::string models;           ///< as the report names them, with ", " between several
    int status = 0;               ///< exit status; not 0: no cage was made
    std::string error;            ///< of a failure
    bool isBounding = false;
    std::size_t triangles = 0, quads = 0;
    /// Fractions of the model's longest side.
    double meanDistance = 0, maxDistance = 0;
    double volumeRatio = 0;     ///< the cage's volume over the model's; 0: one of them is not closed
    double minAngleDegrees = 0; ///< of the cage's faces
    double seconds = 0, memoryMib = 0;
};

/// Reads reports, also those in folders and below them. Failures come first, then cages that do not bound, then the
/// loosest; equal ones by name. Other JSON files in folders are ignored.
/// \throw IoError a file or folder cannot be read; a file that was named is no report of
/// `make` or `fit`; there are none
std::vector<JobResult> readJobResults(const std::vector<std::filesystem::path>& paths);

/// Returns lines for a terminal, with a heading and a sum.
std::string tableOf(const std::vector<JobResult>& results);
/// Returns a table for spreadsheets, quoted by RFC 4180: a line for each report, after one with the names of the
/// columns.
std::string csvOf(const std::vector<JobResult>& results);
/// Returns a sum such as "6 jobs: 5 certified, 1 failed".
std::string sumOf(const std::vector<JobResult>& results);

} // namespace vdbcage::report
