#include <tools/view/state/scene.h>

#include <array>
#include <charconv>

#include <nlohmann/json.hpp>
#include <tools/view/state/command.h>
#include <tools/view/state/words.h>
#include <vdbcage/core/detail/atomic_file.h>
#include <vdbcage/core/detail/read_file.h>
#include <vdbcage/core/error.h>
#include <vdbcage/core/version.h>
#include <vdbcage/mesh/mesh_io.h>

namespace vdbcage::view {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

namespace {

constexpr int formatVersion = 1;

std::string hexadecimal(std::uint64_t value)
{
    std::array<char, 17> digits{};
    char* const end = std::to_chars(digits.data(), digits.data() + digits.size(), value, 16).ptr;
    const std::string text(digits.data(), end);
    return std::string(16 - text.size(), '0') + text;
}

/// A file as it is named in a scene: from the scene's folder where both have a common one, so that a folder with a
/// scene can be moved.
Json fileOf(const OpenedMesh& mesh, const fs::path& scene)
{
    const fs::path folder = fs::absolute(scene).lexically_normal().parent_path();
    const fs::path relative = mesh.path.lexically_relative(folder);
    const bool isBelow = !relative.empty() && *relative.begin() != "..";
    return {{"file", (isBelow ? relative : mesh.path).string()}, {"digest", hexadecimal(digestOf(mesh.path))}};
}

OpenedMeshPtr openFile(const Json& file, const fs::path& scene)
{
    const fs::path path = scene.parent_path() / file.at("file").get<std::string>();
    const std::string digest = hexadecimal(digestOf(path));
    const auto saved = file.at("digest").get<std::string>();
    if (digest != saved) {
        throw InputError(path.string() + ": it is not the file that the scene " + scene.string() +
                         " was saved with (its digest is " + digest + ", not " + saved + ")");
    }
    return openMesh(path);
}

/// A cage that was edited has no file of its own.
OpenedMeshPtr editedCage(const fs::path& file)
{
    OpenedMesh edited;
    edited.mesh = readMesh(file);
    return std::make_shared<const OpenedMesh>(std::move(edited));
}

PosePtr poseOf(const fs::path& rest, const fs::path& posed)
{
    Pose pose{std::make_shared<const Mesh>(readMesh(rest)), readMesh(posed).points};
    if (pose.points.size() != pose.rest->points.size()) {
        throw InputError(posed.string() + ": it has " + std::to_string(pose.points.size()) +
                         " points; the cage at rest " + rest.string() + " has " +
                         std::to_string(pose.rest->points.size()));
    }
    return std::make_shared<const Pose>(std::move(pose));
}

} // namespace

fs::path cageBeside(const fs::path& scene)
{
    return fs::path(scene).replace_extension(".cage.obj");
}

fs::path restBeside(const fs::path& scene)
{
    return fs::path(scene).replace_extension(".rest.obj");
}

fs::path poseBeside(const fs::path& scene)
{
    return fs::path(scene).replace_extension(".pose.obj");
}

void saveScene(const State& state, const CageResult* current, const fs::path& path)
{
    if (path.extension() != ".json") throw InputError(path.string() + ": scenes are written as .json");
    const Document& document = state.document;
    if (!document.model) throw InputError(path.string() + ": there is no model yet, so there is no scene to save");
    Json options = Json::object(), view = Json::array();
    for (const auto& [name, value] : optionValues(document.options)) options[name] = value;
    for (const Command& command : commandsFor(state.view)) view.push_back(toText(command));
    const bool hasMade = current && !document.cage;
    const bool isEdited = document.cage && document.cage->path.empty();
    const auto nameOf = [](const fs::path& file) { return file.filename().string(); };
    const Json scene{{"vdbcage_scene", formatVersion},
                     {"version", VDBCAGE_VERSION},
                     {"model", fileOf(*document.model, path)},
                     {"options", options},
                     {"opened_cage", document.cage && !isEdited ? fileOf(*document.cage, path) : Json()},
                     {"made_cage", hasMade ? Json(nameOf(cageBeside(path))) : Json()},
                     {"edited_cage", isEdited ? Json(nameOf(cageBeside(path))) : Json()},
                     {"pose", document.pose
                                  ? Json{{"rest", nameOf(restBeside(path))}, {"posed", nameOf(poseBeside(path))}}
                                  : Json()},
                     {"coordinates", coordinatesName(document.coordinates)},
                     {"view", view}};
    std::string text;
    try {
        text = scene.dump(2) + '\n';
    } catch (const Json::exception&) {
        throw InputError(path.string() + ": a name of a file is not UTF-8, as JSON must be");
    }
    PendingFiles files;
    const auto add = [&](const Mesh& mesh, const fs::path& file) {
        files.add(file, [&mesh, file](std::ostream& out) { writeMesh(mesh, out, file); });
    };
    Mesh posed;
    if (hasMade) add(current->cage, cageBeside(path));
    if (isEdited) add(document.cage->mesh, cageBeside(path));
    if (document.pose) {
        posed = *document.pose->rest;
        posed.points = document.pose->points;
        add(*document.pose->rest, restBeside(path));
        add(posed, poseBeside(path));
    }
    files.add(path, [&](std::ostream& out) { out << text; });
    files.commit();
}

State openScene(const fs::path& given)
{
    const fs::path path = fs::absolute(given).lexically_normal();
    const std::string text = detail::readFile(path);
    State state;
    try {
        const Json scene = Json::parse(text);
        const int version = scene.at("vdbcage_scene").get<int>();
        if (version != formatVersion) {
            throw InputError("it is a scene of version " + std::to_string(version) + "; only version " +
                             std::to_string(formatVersion) + " is known");
        }
        for (const auto& option : scene.at("options").items()) {
            setOption(state.document.options, option.key(), option.value().get<std::string>());
        }
        for (const Json& line : scene.at("view")) {
            const Command command = commandOf(wordsOf(line.get<std::string>()));
            if (changesDocument(command)) throw InputError("view: '" + line.get<std::string>() + "' is not of a view");
            state = applied(state, command);
        }
        state.document.model = openFile(scene.at("model"), path);
        if (!scene.at("opened_cage").is_null()) state.document.cage = openFile(scene.at("opened_cage"), path);
        // Scenes of before there were poses have none of these.
        if (scene.contains("edited_cage") && !scene["edited_cage"].is_null()) {
            state.document.cage = editedCage(path.parent_path() / scene["edited_cage"].get<std::string>());
        }
        if (scene.contains("pose") && !scene["pose"].is_null()) {
            state.document.pose = poseOf(path.parent_path() / scene["pose"].at("rest").get<std::string>(),
                                         path.parent_path() / scene["pose"].at("posed").get<std::string>());
        }
        if (scene.contains("coordinates")) {
            state.document.coordinates = coordinatesNamed(scene["coordinates"].get<std::string>());
        }
    } catch (const Json::exception& error) {
        throw InputError(path.string() + ": it is no scene: " + error.what());
    } catch (const InputError& error) {
        throw InputError(path.string() + ": " + error.what());
    }
    return state;
}

} // namespace vdbcage::view
