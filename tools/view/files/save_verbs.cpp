#include <tools/view/files/save_verbs.h>

#include <utility>

#include <tools/view/files/file_contents.h>
#include <vdbcage/core/error.h>

namespace vdbcage::view {

namespace fs = std::filesystem;

namespace {

/// \throw InputError the shown cage is not the current one, or lacks a pose
void requirePoses(const SaveSource& source, const std::string& verb)
{
    // The poses belong to the shown cage; a new one may not have them yet.
    const CageResultPtr current = currentCage(source.planner, verb);
    if (!source.cage || source.cage->rest().get() != &current->cage) {
        throw InputError(verb, "the poses are not carried over to the new cage yet");
    }
    for (const PoseKey& key : source.state.document.poses.keys()) {
        if (source.cage->isGivenUp(key.pose)) {
            throw InputError(verb, "a pose cannot be carried over to this cage: " + source.posing.error());
        }
    }
}

/// Returns the poses at the frames of the verb T. \throw as requirePoses
template <class T>
PosedScene posedScene(const SaveSource& source)
{
    requirePoses(source, T::info().name);
    const State& state = source.state;
    const TimeLine& poses = state.document.poses;
    const int first = T::isSequence ? poses.firstFrame() : state.view.frame;
    const int last = T::isSequence ? poses.finalFrame() : first;
    const BindOrder order = bindOrder(state.document, source.cage->rest());
    const auto binding = source.posing.follower().bindingIfReady(order);
    return {order, binding, state.document.elasticity, poses, *source.cage, first, last};
}

} // namespace

Write SavePosedCage::writer(const SaveSource& source, const fs::path& file)
{
    return [scene = posedScene<SavePosedCage>(source), file](Interrupter* i) { savePosedCages(scene, file, i); };
}

Write SavePosedModel::writer(const SaveSource& source, const fs::path& file)
{
    return [scene = posedScene<SavePosedModel>(source), file](Interrupter* i) { savePosedModels(scene, file, i); };
}

Write SavePosedCages::writer(const SaveSource& source, const fs::path& file)
{
    return [scene = posedScene<SavePosedCages>(source), file](Interrupter* i) { savePosedCages(scene, file, i); };
}

Write SavePosedModels::writer(const SaveSource& source, const fs::path& file)
{
    return [scene = posedScene<SavePosedModels>(source), file](Interrupter* i) { savePosedModels(scene, file, i); };
}

Write SaveColours::writer(const SaveSource& source, const fs::path& file)
{
    const auto values = source.posing.follower().values();
    if (!values) {
        throw InputError("save-colours", "the model shows none; in mode pose, once it is bound, it can show influence, "
                                         "stretch, or inverted triangles");
    }
    const OpenedMeshPtr model = source.state.document.model;
    const PosedModel& posed = source.posing.follower().model();
    std::vector<openvdb::Vec3d> points = posed.isWhole() ? posed.points() : model->mesh.points;
    return [model, points = std::move(points), values, file](Interrupter*) {
        saveColours(model->mesh, points, *values, file);
    };
}

Write SaveWeights::writer(const SaveSource& source, const fs::path& file)
{
    requirePoses(source, "save-weights");
    return [order = bindOrder(source.state.document, source.cage->rest()), file](Interrupter* i) {
        saveWeights(order, file, i);
    };
}

Write SaveCage::writer(const SaveSource& source, const fs::path& file)
{
    return [cage = currentCage(source.planner, "save-cage"), file](Interrupter* i) { saveCage(*cage, file, i); };
}

Write SaveReport::writer(const SaveSource& source, const fs::path& file)
{
    return [cage = currentCage(source.planner, "save-report"), file](Interrupter*) { saveReport(*cage, file); };
}

Write SaveOptions::writer(const SaveSource& source, const fs::path& file)
{
    return [options = source.state.document.options, file](Interrupter*) { saveOptions(options, file); };
}

CageResultPtr currentCage(const Planner& planner, const std::string& verb)
{
    if (planner.standing() != Planner::Standing::current) {
        throw InputError(verb, "the cage of these options is not made yet");
    }
    return planner.made();
}

} // namespace vdbcage::view
