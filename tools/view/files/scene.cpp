#include <tools/view/files/scene.h>

#include <algorithm>
#include <map>
#include <set>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>
#include <tools/files/frames.h>
#include <tools/files/posed_cage.h>
#include <tools/view/state/command.h>
#include <tools/view/state/words.h>
#include <vdbcage/core/detail/atomic_file.h>
#include <vdbcage/core/detail/read_file.h>
#include <vdbcage/core/error.h>
#include <vdbcage/core/range.h>
#include <vdbcage/core/version.h>
#include <vdbcage/mesh/mesh_io.h>

namespace vdbcage::view {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

namespace {

constexpr int formatVersion = 1;

/// Returns a file as named in a scene: relative to the scene's folder if it is in or below it, so that the folder can
/// be moved.
Json fileOf(const fs::path& path, const fs::path& scene)
{
    const fs::path folder = fs::absolute(scene).lexically_normal().parent_path();
    const fs::path relative = path.lexically_relative(folder);
    const bool isBelow = !relative.empty() && *relative.begin() != "..";
    return {{"file", (isBelow ? relative : path).string()}, {"digest", digestOf(path)}};
}

/// Returns the path of the file. \throw InputError it has changed
fs::path sameFile(const Json& file, const fs::path& scene)
{
    const fs::path path = scene.parent_path() / file.at("file").get<std::string>();
    const std::string digest = digestOf(path);
    const auto saved = file.at("digest").get<std::string>();
    if (digest != saved) {
        throw InputError(path.string(), "it is not the file that the scene " + scene.string() +
                                            " was saved with (its digest is " + digest + ", not " + saved + ")");
    }
    return path;
}

Json toJson(const Elasticity& elasticity)
{
    return {{"nu", elasticity.nu},
            {"rotations", rotationsName(elasticity.rotations)},
            {"local_bulging", elasticity.localBulging},
            {"global_bulging", elasticity.globalBulging}};
}

/// \throw InputError
Elasticity elasticityOf(const Json& json)
{
    const Elasticity elasticity{json.at("nu").get<double>(), rotationsNamed(json.at("rotations").get<std::string>()),
                                json.at("local_bulging").get<double>(), json.at("global_bulging").get<double>()};
    requireElasticity(elasticity);
    return elasticity;
}

/// Reads an edited cage, which has no file of its own.
OpenedMeshPtr editedCage(const fs::path& file)
{
    OpenedMesh edited;
    edited.mesh = readMesh(file);
    return std::make_shared<const OpenedMesh>(std::move(edited));
}

/// \throw InputError there is no cage to be fitted, or the tightness is out of range
void readFit(const Json& tightness, Document& document)
{
    document.tightness = tightness.get<double>();
    requireWithin(FitOptions::tightnesses, document.tightness, "fit");
    if (!document.cage) throw InputError("fit", "the scene has no opened or edited cage");
    document.isFitted = true;
}

/// \throw InputError it is no list of points of the cage
void readLocked(const Json& points, Document& document)
{
    std::set<openvdb::Index32> locked;
    for (const Json& point : points) {
        const auto number = point.get<std::uint64_t>();
        if (!document.cage || number >= document.cage->mesh.points.size()) {
            throw InputError("locked_points", std::to_string(number) + " is no point of the cage");
        }
        locked.insert(static_cast<openvdb::Index32>(number));
    }
    document.locked.assign(locked.begin(), locked.end());
}

/// A reader of poses from files beside a scene. Poses of one cage at rest share its file.
class PoseReader {
public:
    explicit PoseReader(fs::path folder) : folder_(std::move(folder)) {}

    TimeLine read(const Json& list)
    {
        TimeLine poses;
        for (const Json& entry : list) {
            PoseKey key;
            key.frame = entry.at("frame").get<int>();
            if (key.frame < 0 || key.frame > lastFrame) {
                throw InputError("poses", "frame " + std::to_string(key.frame) +
                                              " is not allowed; it must be from 0 to " + std::to_string(lastFrame));
            }
            key.name = entry.at("name").get<std::string>();
            if (!entry.at("posed").is_null()) {
                key.pose = readPose(folder_ / entry.at("rest").get<std::string>(),
                                    folder_ / entry.at("posed").get<std::string>());
            }
            poses = poses.with(std::move(key));
        }
        return poses;
    }

private:
    PosePtr readPose(const fs::path& restPath, const fs::path& posedPath)
    {
        MeshPtr& rest = rests_[restPath];
        if (!rest) rest = std::make_shared<const Mesh>(readMesh(restPath));
        return std::make_shared<const Pose>(
            Pose{rest, files::posedPointsOf(posedPath, readMesh(posedPath), *rest).points});
    }

    fs::path folder_;
    std::map<fs::path, MeshPtr> rests_;
};

} // namespace

fs::path cageBeside(const fs::path& scene)
{
    return fs::path(scene).replace_extension(".cage.obj");
}

fs::path restBeside(const fs::path& scene, std::size_t number)
{
    return fs::path(scene).replace_extension(".rest" + (number == 0 ? "" : '.' + std::to_string(number)) + ".obj");
}

fs::path poseBeside(const fs::path& scene, int frame)
{
    return files::framePath(fs::path(scene).replace_extension(".pose.%04d.obj"), frame);
}

void saveScene(const State& state, const CageResult* current, const fs::path& path)
{
    if (path.extension() != ".json") throw InputError(path.string(), "scenes are written as .json");
    const Document& document = state.document;
    if (!document.model) throw InputError(path.string(), "there is no model yet, so there is no scene to save");
    Json options = Json::object(), view = Json::array();
    for (const auto& [name, value] : optionValues(document.options)) options[name] = value;
    for (const Command& command : commandsFor(state.view)) view.push_back(toText(command));
    const bool hasMade = current && !document.cage;
    const bool isEdited = document.cage && document.cage->path.empty();
    const auto nameOf = [](const fs::path& file) { return file.filename().string(); };
    Json poses = Json::array();
    std::vector<MeshPtr> rests;
    std::vector<Mesh> posed; // one for each key with a pose
    for (const PoseKey& key : document.poses.keys()) {
        Json entry{{"frame", key.frame}, {"name", key.name}, {"rest", nullptr}, {"posed", nullptr}};
        if (key.pose) {
            auto rest = std::find(rests.begin(), rests.end(), key.pose->rest);
            if (rest == rests.end()) rest = rests.insert(rest, key.pose->rest);
            entry["rest"] = nameOf(restBeside(path, static_cast<std::size_t>(rest - rests.begin())));
            entry["posed"] = nameOf(poseBeside(path, key.frame));
            posed.push_back(*key.pose->rest);
            posed.back().points = key.pose->points;
        }
        poses.push_back(std::move(entry));
    }
    const Json scene{{"vdbcage_scene", formatVersion},
                     {"version", VDBCAGE_VERSION},
                     {"model", fileOf(document.model->path, path)},
                     {"options", options},
                     {"opened_cage", document.cage && !isEdited ? fileOf(document.cage->path, path) : Json()},
                     {"made_cage", hasMade ? Json(nameOf(cageBeside(path))) : Json()},
                     {"edited_cage", isEdited ? Json(nameOf(cageBeside(path))) : Json()},
                     {"fit", document.isFitted ? Json(document.tightness) : Json()},
                     {"locked_points", document.locked},
                     {"poses", poses},
                     {"coordinates", coordinatesName(document.coordinates)},
                     {"weights", document.weights ? fileOf(document.weights->path, path) : Json()},
                     {"elasticity", toJson(document.elasticity)},
                     {"view", view}};
    std::string text;
    try {
        text = scene.dump(2) + '\n';
    } catch (const Json::exception&) {
        throw InputError(path.string(), "a name of a file is not UTF-8, as JSON must be");
    }
    PendingFiles files;
    const auto add = [&](const Mesh& mesh, const fs::path& file) {
        files.add(file, [&mesh, file](std::ostream& out) { writeMesh(mesh, out, file); });
    };
    if (hasMade) add(current->cage, cageBeside(path));
    if (isEdited) add(document.cage->mesh, cageBeside(path));
    for (std::size_t i = 0; i < rests.size(); ++i) add(*rests[i], restBeside(path, i));
    std::size_t next = 0;
    for (const PoseKey& key : document.poses.keys()) {
        if (key.pose) add(posed[next++], poseBeside(path, key.frame));
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
            if (changesDocument(command))
                throw InputError("view", "'" + line.get<std::string>() + "' is not of a view");
            state = applied(state, command);
        }
        state.document.model = openMesh(sameFile(scene.at("model"), path));
        if (!scene.at("opened_cage").is_null()) state.document.cage = openMesh(sameFile(scene.at("opened_cage"), path));
        // Older scenes lack these.
        if (scene.contains("edited_cage") && !scene["edited_cage"].is_null()) {
            state.document.cage = editedCage(path.parent_path() / scene["edited_cage"].get<std::string>());
        }
        if (scene.contains("fit") && !scene["fit"].is_null()) readFit(scene["fit"], state.document);
        if (scene.contains("locked_points")) readLocked(scene["locked_points"], state.document);
        PoseReader poses(path.parent_path());
        if (scene.contains("poses")) state.document.poses = poses.read(scene["poses"]);
        if (scene.contains("pose") && !scene["pose"].is_null()) { // an older scene with a single pose
            const Json& one = scene["pose"];
            state.document.poses = poses.read(
                Json::array({Json{{"frame", 0}, {"name", ""}, {"rest", one.at("rest")}, {"posed", one.at("posed")}}}));
        }
        if (scene.contains("weights") && !scene["weights"].is_null()) {
            state.document.weights = openWeights(sameFile(scene["weights"], path));
            state.document.coordinates = Coordinates::given;
        } else if (scene.contains("coordinates")) {
            state.document.coordinates = coordinatesNamed(scene["coordinates"].get<std::string>());
        }
        if (scene.contains("elasticity")) state.document.elasticity = elasticityOf(scene["elasticity"]);
    } catch (const Json::exception& error) {
        throw InputError(path.string(), std::string("it is no scene: ") + error.what());
    } catch (const InputError& error) {
        throw InputError(path.string(), error.what());
    }
    return state;
}

} // namespace vdbcage::view
