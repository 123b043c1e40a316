#include <tools/cli/models.h>

#include <algorithm>
#include <cstdint>
#include <sstream>
#include <system_error>

#include <tools/report/run_facts.h>
#include <vdbcage/core/detail/joined.h>
#include <vdbcage/core/detail/printable.h>
#include <vdbcage/core/error.h>
#include <vdbcage/geometry/union_find.h>
#include <vdbcage/mesh/io/formats.h>
#include <vdbcage/mesh/parts.h>

namespace vdbcage::cli {

namespace {

/// Appends the points and faces of `mesh` to those of `all`.
void append(const Mesh& mesh, Mesh& all)
{
    const auto before = static_cast<openvdb::Index32>(all.points.size());
    all.points.insert(all.points.end(), mesh.points.begin(), mesh.points.end());
    const auto appendFaces = [before](const auto& from, auto& to) {
        for (auto face : from) {
            for (int i = 0; i < face.size; ++i) face[i] += before;
            to.push_back(face);
        }
    };
    appendFaces(mesh.triangles, all.triangles);
    appendFaces(mesh.quads, all.quads);
    appendFaces(mesh.alternatives, all.alternatives);
}

/// Returns whether the boxes overlap, or the gap between them is a small part of the longest side of both. Parts of one
/// thing touch or nearly do, as a hat above a head.
bool areNear(const openvdb::BBoxd& a, const openvdb::BBoxd& b)
{
    constexpr double smallPart = 0.1;
    double side = 0, gap = 0; // along the axis where each is largest
    for (int axis = 0; axis < 3; ++axis) {
        side = std::max({side, a.extents()[axis], b.extents()[axis]});
        gap = std::max({gap, a.min()[axis] - b.max()[axis], b.min()[axis] - a.max()[axis]});
    }
    return gap <= smallPart * side;
}

} // namespace

std::vector<ModelFile> readModels(const std::vector<std::filesystem::path>& paths, Hashes hashes)
{
    std::vector<ModelFile> models;
    for (const std::filesystem::path& path : paths) {
        for (const ModelFile& other : models) {
            std::error_code ignored; // reading reports the error
            if (std::filesystem::equivalent(path, other.path, ignored)) {
                throw InputError(path.string(), "this model is named twice");
            }
        }
        const std::string bytes = detail::readMeshBytes(path);
        MeshFile file = detail::parseMesh(bytes, path);
        report::Json facts = report::toJson(file.mesh, file.summary, path);
        if (hashes == Hashes::sha256) facts["sha256"] = report::sha256Of(bytes);
        models.push_back({path, std::move(file.mesh), file.summary, std::move(facts)});
    }
    return models;
}

Mesh takeMesh(std::vector<ModelFile>& models)
{
    if (models.size() == 1) return std::move(models.front().mesh);
    Mesh all;
    for (const ModelFile& model : models) append(model.mesh, all);
    return all;
}

void checkEach(std::vector<ModelFile>& models, const Mesh& cage, double leastSide, Interrupter* interrupter)
{
    if (models.size() == 1) return;
    for (ModelFile& model : models) {
        if (leastSide > 0) model.mesh = partsFrom(model.mesh, leastSide).mesh;
        if (faceCount(model.mesh) > 0) model.check = checkCage(cage, model.mesh, {}, interrupter);
    }
}

report::Json entryOf(const std::vector<ModelFile>& models)
{
    report::Json list = report::Json::array();
    for (const ModelFile& model : models) {
        list.push_back(model.facts);
        if (model.check) list.back()["check"] = report::toJson(*model.check);
    }
    return list;
}

std::string namesOf(const std::vector<ModelFile>& models)
{
    return detail::joined(models, ", ", [](const ModelFile& model) { return model.path.string(); });
}

std::string describe(const std::vector<ModelFile>& models)
{
    std::string text;
    for (const ModelFile& model : models) {
        if (!model.check) continue;
        text += "  " + detail::printable(model.path.string()) + ": " + verdict(*model.check);
        if (model.check->valid() && !model.check->bounding()) {
            text += ", faces touching it " + std::to_string(model.check->contactFaces) + ", its vertices outside " +
                    std::to_string(model.check->modelVerticesOutside);
        }
        text += '\n';
    }
    return text;
}

bool lieApart(const std::vector<ModelFile>& models)
{
    if (models.size() == 1) return false; // its mesh may be gone
    std::vector<openvdb::BBoxd> boxes;
    for (const ModelFile& model : models) {
        if (faceCount(model.mesh) > 0) boxes.push_back(boundingBox(model.mesh)); // all may have been left out
    }
    detail::UnionFind groups(boxes.size());
    for (std::uint32_t i = 0; i < boxes.size(); ++i) {
        for (std::uint32_t j = 0; j < i; ++j) {
            if (areNear(boxes[i], boxes[j])) groups.unite(i, j);
        }
    }
    for (std::uint32_t i = 0; i < boxes.size(); ++i) {
        if (groups.find(i) != 0) return true;
    }
    return false;
}

std::string warningLines(const std::vector<ModelFile>& models)
{
    std::string lines;
    for (const ModelFile& model : models) lines += report::warningLines(model.path, model.summary);
    return lines;
}

Mesh readMesh(const std::filesystem::path& path, std::string& warnings)
{
    MeshFile file = readMeshFile(path);
    warnings += report::warningLines(path, file.summary);
    return std::move(file.mesh);
}

std::string bytesOf(const Mesh& mesh, const std::filesystem::path& path)
{
    std::ostringstream out;
    out.exceptions(std::ios::badbit); // the stream would hide a lack of memory
    writeMesh(mesh, out, path);
    return out.str();
}

const char* verdict(const CageCheck& check)
{
    return check.bounding() ? "bounding" : check.valid() ? "NOT bounding" : "NOT a valid cage";
}

} // namespace vdbcage::cli
