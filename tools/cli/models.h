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

/// A model that the cage must bound.
struct ModelFile {
    std::filesystem::path path;
    Mesh mesh;
    ReadSummary summary;
    report::Json facts;                  ///< toJson of the three above, with its hash if requested
    std::optional<CageCheck> check = {}; ///< the verdict on the cage against this model alone
};

/// Whether files are hashed, for reports.
enum class Hashes { none, sha256 };

/// Reads the models. \throw IoError; InputError if one is named twice
std::vector<ModelFile> readModels(const std::vector<std::filesystem::path>& paths, Hashes hashes);

/// Returns all models as one. A lone model's mesh is moved.
Mesh takeMesh(std::vector<ModelFile>& models);

/// Sets the verdict of each of several models, leaving out parts with a longest side below `leastSide`.
/// \throw InputError, Cancelled
void checkEach(std::vector<ModelFile>& models, const Mesh& cage, double leastSide, Interrupter* interrupter);

/// Returns the list of their facts. If there are several, each has its "check".
report::Json entryOf(const std::vector<ModelFile>& models);

/// Returns their names for messages: "body.obj, shirt.obj".
std::string namesOf(const std::vector<ModelFile>& models);

/// Returns lines with the verdict of each of several models, with its defects. Distances from the cage to one model are
/// left out, as they would count the surroundings of the others.
std::string describe(const std::vector<ModelFile>& models);

/// Returns whether some of several models lie so far apart that they may need a cage each.
bool lieApart(const std::vector<ModelFile>& models);

/// Returns the warningLines() of all.
std::string warningLines(const std::vector<ModelFile>& models);

/// Reads a mesh and appends the warningLines() of the file.
Mesh readMesh(const std::filesystem::path& path, std::string& warnings);

/// Returns the bytes of a file of this name that holds the mesh. \throw IoError
std::string bytesOf(const Mesh& mesh, const std::filesystem::path& path);

/// Returns "bounding", "NOT bounding" or "NOT a valid cage".
const char* verdict(const CageCheck& check);

} // namespace vdbcage::cli
