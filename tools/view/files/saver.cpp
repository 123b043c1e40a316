#include <tools/view/files/saver.h>

#include <utility>

#include <tools/files/frames.h>
#include <tools/view/files/saving.h>
#include <tools/view/state/move.h>
#include <vdbcage/core/error.h>

namespace vdbcage::view {

namespace {

namespace fs = std::filesystem;
using Write = std::function<void(Interrupter*)>;

PosedScene posedScene(const Saver::Source& source, bool isSequence)
{
    const State& state = source.state;
    const TimeLine& poses = state.document.poses;
    const CarriedPoses carried = state.carried ? *state.carried : CarriedPoses(state.cage);
    const int first = isSequence ? poses.firstFrame() : state.view.frame;
    const int last = isSequence ? poses.finalFrame() : first;
    const auto binding = source.posing.follower().bindingOf(state);
    return {bindOrder(state), binding, state.document.elasticity, poses, carried, first, last};
}

Write writePosed(const Saver::Source& source, const std::string& verb, const fs::path& file)
{
    // Of the cage that is seen; a new one may not have its poses yet.
    if (source.state.cage.get() != &currentCage(source.planner, verb).cage) {
        throw InputError(verb + ": the poses are not carried over to the new cage yet");
    }
    for (const PoseKey& key : source.state.document.poses.keys()) {
        if (source.state.carried && source.state.carried->isGivenUp(key.pose)) {
            throw InputError(verb + ": a pose cannot be carried over to this cage: " + source.posing.error());
        }
    }
    if (verb == "save-weights") {
        return [order = bindOrder(source.state), file](Interrupter* i) { saveWeights(order, file, i); };
    }
    const bool isCage = verb.rfind("save-posed-cage", 0) == 0;
    return [scene = posedScene(source, isSequence(verb)), isCage, file](Interrupter* i) {
        if (isCage) return savePosedCages(scene, file, i);
        savePosedModels(scene, file, i);
    };
}

Write writeColours(const Saver::Source& source, const fs::path& file)
{
    const auto values = source.posing.follower().values();
    if (!values) {
        throw InputError("save-colours: the model shows none; in mode pose, once it is bound, it can show influence, "
                         "stretch, or what is inverted");
    }
    const OpenedMeshPtr model = source.state.document.model;
    const PosedModel& posed = source.posing.follower().model();
    std::vector<openvdb::Vec3d> points = posed.isWhole() ? posed.points() : model->mesh.points;
    return [model, points = std::move(points), values, file](Interrupter*) {
        saveColours(model->mesh, points, *values, file);
    };
}

Write writerOf(const Saver::Source& source, const std::string& verb, const fs::path& file)
{
    if (verb == "save-options") {
        return [options = source.state.document.options, file](Interrupter*) { saveOptions(options, file); };
    }
    if (verb == "save-colours") return writeColours(source, file);
    if (verb == "save-cage" || verb == "save-report") {
        currentCage(source.planner, verb);
        return [cage = source.planner.shown(), isReport = verb == "save-report", file](Interrupter* interrupter) {
            if (isReport) return saveReport(*cage, file);
            saveCage(*cage, file, interrupter);
        };
    }
    return writePosed(source, verb, file);
}

} // namespace

bool isSequence(const std::string& verb)
{
    return verb == "save-posed-cages" || verb == "save-posed-models";
}

Saver::Saver(std::function<void()> wake)
    : worker_(
          [](const Job& job, Interrupter& interrupter, const auto&) {
              job.write(&interrupter);
              return job.name;
          },
          std::move(wake))
{
}

void Saver::save(const Source& source, const std::string& verb, const fs::path& path)
{
    if (isBusy_) throw InputError(path.string() + ": another file is still being written");
    fs::path file = path;
    if (isSequence(verb)) file = files::patternFor(path);
    Write write = writerOf(source, verb, file);
    isBusy_ = true;
    worker_.start({file.filename().string(), std::move(write)});
}

std::optional<std::string> Saver::take()
{
    const auto outcome = worker_.take();
    if (!outcome) return std::nullopt;
    isBusy_ = false;
    if (!outcome->error.empty()) throw InputError(outcome->error);
    return outcome->result;
}

const CageResult& currentCage(const Planner& planner, std::string_view verb)
{
    if (planner.standing() != Planner::Standing::current) {
        throw InputError(std::string(verb) + ": the cage of these options is not made yet");
    }
    return *planner.shown();
}

} // namespace vdbcage::view
