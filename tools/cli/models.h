#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include <tools/report/report.h>
#include <vdbcage/check/check.h>
#include <vdbcage/core/interrupter.h>
#include <vdbcage/mesh/mesh_io.h>

namespace vdbcage::cli {

/// One of the models that a cage is to bound.
struct ModelFile {
    std::filesystem::path path;
    Mesh mesh;
    ReadSummary summary;
    report::Json facts;                  ///< toJson of the three above, with its hash if that was asked for
    std::optional<CageCheck> check = {}; ///< the verdict on the cage against this model alone
};

/// Whether files are to be hashed, for reports.
enum class Hashes { none, sha256 };

/// Reads them. \throw IoError; InputError if one is named twice
std::vector<ModelFile> readModels(const std::vector<std::filesystem::path>& paths, Hashes hashes);

/// All models as one. A lone model gives its mesh away.
Mesh takeMesh(std::vector<ModelFile>& models);

/// Where there are several: sets the verdict of each, without parts of a longest side below `leastSide`.
/// \throw InputError, Cancelled
void checkEach(std::vector<ModelFile>& models, const Mesh& cage, double leastSide, Interrupter* interrupter);

/// A list of their facts. Where there are several, each has its "check".
report::Json entryOf(const std::vector<ModelFile>& models);

/// Their names for messages: "body.obj, shirt.obj".
std::string namesOf(const std::vector<ModelFile>& models);

/// Where there are several: the verdict of each, with what speaks against it. Distances from the cage to one model
/// would count what is around the others, too. Lines with their ends.
std::string describe(const std::vector<ModelFile>& models);

/// Whether some of several models lie so far from the others that they may have been meant to get a cage each.
bool lieApart(const std::vector<ModelFile>& models);

/// The warningLines() of all.
std::string warningLines(const std::vector<ModelFile>& models);

/// readMesh() that appends the warningLines() of the file.
Mesh readMesh(const std::filesystem::path& path, std::string& warnings);

/// "bounding", "NOT bounding" or "NOT a valid cage".
const char* verdict(const CageCheck& check);

} // namespace vdbcage::cli
