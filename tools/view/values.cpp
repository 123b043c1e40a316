#include <tools/view/values.h>

#include <tools/view/state/cage_changes.h>
#include <vdbcage/core/detail/number_text.h>

namespace vdbcage::view {

namespace {

std::string yesNo(bool yes)
{
    return yes ? "yes" : "no";
}

} // namespace

std::map<std::string, std::function<std::string()>> valuesOf(const AppParts& parts)
{
    std::map<std::string, std::function<std::string()>> list;
    const Planner& planner = parts.making.planner();
    const Session& session = parts.session;
    const State& state = session.state();
    const Posing& posing = parts.making.posing();
    const auto number = [](double value) { return detail::numberText(value); };
    const auto check = [&](auto&& get) -> std::function<std::string()> {
        return [&planner, get] { return planner.made() ? get(planner.made()->report.check) : std::string("none"); };
    };
    list["standing"] = [&] {
        switch (planner.standing()) {
        case Planner::Standing::current:
            return "current";
        case Planner::Standing::preview:
            return "preview";
        case Planner::Standing::stale:
            return "stale";
        case Planner::Standing::none:
            break;
        }
        return "none";
    };
    list["faces"] = check([](const CageCheck& c) { return std::to_string(c.triangles + c.quads); });
    list["triangles"] = check([](const CageCheck& c) { return std::to_string(c.triangles); });
    list["quads"] = check([](const CageCheck& c) { return std::to_string(c.quads); });
    list["points"] = check([](const CageCheck& c) { return std::to_string(c.points); });
    list["bounding"] = check([](const CageCheck& c) { return yesNo(c.bounding()); });
    list["valid"] = check([](const CageCheck& c) { return yesNo(c.valid()); });
    list["volume-ratio"] = check([=](const CageCheck& c) { return number(c.volumeRatio); });
    list["mean-distance"] = check([=](const CageCheck& c) { return number(c.meanDistance); });
    list["model"] = [&] { return state.document.model ? state.document.model->path.filename().string() : "none"; };
    list["model-points"] = [&] {
        return std::to_string(state.document.model ? state.document.model->mesh.points.size() : 0);
    };
    list["model-faces"] = [&] {
        return std::to_string(state.document.model ? faceCount(state.document.model->mesh) : 0);
    };
    list["opened-cage"] = [&] {
        const OpenedMeshPtr& cage = state.document.cage;
        return !cage ? "none" : cage->path.empty() ? "edited" : cage->path.filename().string();
    };
    list["fit"] = [&, number] { return state.document.isFitted ? number(state.document.tightness) : "off"; };
    list["fit-problem"] = [&] {
        const CageResultPtr& made = planner.made();
        return made && !made->fitProblem.empty() ? made->fitProblem : "none";
    };
    list["locked"] = [&] { return std::to_string(state.document.locked.size()); };
    list["undo"] = [&] { return session.documents().canUndo() ? session.documents().undone() : "none"; };
    list["redo"] = [&] { return session.documents().canRedo() ? session.documents().redone() : "none"; };
    list["undo-view"] = [&] { return session.views().canUndo() ? session.views().undone() : "none"; };
    list["messages"] = [&] { return std::to_string(parts.messages.size()); };
    list["message"] = [&] { return parts.messages.empty() ? "none" : parts.messages.front(); };
    list["note"] = [&] { return parts.note.empty() ? "none" : parts.note; };
    list["error"] = [&] { return planner.error().empty() ? "none" : planner.error(); };
    list["making"] = [&] { return yesNo(!planner.isSettled()); };
    list["halted"] = [&] { return yesNo(planner.isHalted()); };
    list["selected"] = [&] { return std::to_string(state.view.selection.ids.size()); };
    for (int k = 0; k < 3; ++k) {
        list[std::string("selected.") + "xyz"[k]] = [&, number, k] {
            const auto selected = selectionFrame(state, session.cage(), {});
            return selected ? number(selected->mean[k]) : std::string("none");
        };
    }
    list["projection"] = [&] {
        return state.view.camera.projection == draw::Projection::perspective ? "perspective" : "orthographic";
    };
    list["azimuth"] = [&, number] { return number(state.view.camera.view.azimuthDegrees); };
    list["elevation"] = [&, number] { return number(state.view.camera.view.elevationDegrees); };
    list["mode"] = [&] { return modeNames[static_cast<std::size_t>(state.view.mode)]; };
    list["tool"] = [&] { return toolNames[static_cast<std::size_t>(state.view.tool)]; };
    list["select-kind"] = [&] { return edit::elementNames[static_cast<std::size_t>(state.view.selection.kind)]; };
    list["pivot"] = [&] {
        const std::string text = toText(SetPivot{state.view.pivot});
        return text.substr(text.find(' ') + 1);
    };
    list["key-map"] = [&] { return keyMapNames[static_cast<std::size_t>(parts.keys)]; };
    list["see-through"] = [&] { return state.view.seeThrough ? "on" : "off"; };
    list["mirror"] = [&] { return state.view.mirror ? std::string(1, "xyz"[state.view.mirror->axis]) : "off"; };
    list["coordinates"] = [&] { return coordinatesName(state.document.coordinates); };
    list["material"] = [&] {
        const std::string text = toText(SetMaterial{state.document.elasticity});
        return text.substr(text.find(' ') + 1);
    };
    list["weights"] = [&] {
        return state.document.weights ? state.document.weights->path.filename().string() : "none";
    };
    list["posed"] = [&] { return yesNo(!state.document.poses.isEmpty()); };
    list["time"] = [&] { return std::to_string(state.view.frame); };
    list["keys"] = [&] { return std::to_string(state.document.poses.keys().size()); };
    list["key"] = [&] {
        const PoseKey* const key = state.document.poses.keyAt(state.view.frame);
        return !key ? "none" : key->name.empty() ? "unnamed" : key->name;
    };
    list["last-frame"] = [&] { return std::to_string(state.document.poses.finalFrame()); };
    list["play"] = [&] { return state.view.isPlaying ? "on" : "off"; };
    list["pose-valid"] = [&] { return posing.follower().check() ? yesNo(posing.follower().check()->isValid) : "none"; };
    list["inverted"] = [&] {
        const PoseCheckPtr& verdict = posing.follower().check();
        return verdict && verdict->inverted ? std::to_string(verdict->inverted->size()) : "none";
    };
    list["bound"] = [&] {
        const BoundModelPtr& bound = posing.follower().binder().bound();
        return !bound ? "no" : bound->whole ? "yes" : "coarsely";
    };
    list["ground"] = [&] { return state.view.ground ? "on" : "off"; };
    list["axes"] = [&] { return state.view.axes ? "on" : "off"; };
    list["turntable"] = [&] { return state.view.turntable ? "on" : "off"; };
    list["section"] = [&] { return state.view.section ? "on" : "off"; };
    list["frames"] = [&] { return std::to_string(parts.screen.frames()); };
    list["ended"] = [&] { return yesNo(parts.isEnded); };
    for (const auto& option : optionValues(state.document.options)) {
        list["option." + option.first] = [value = option.second] { return value; };
    }
    for (std::size_t i = 0; i < layerCount; ++i) {
        list[std::string("layer.") + nameOf(static_cast<LayerId>(i))] = [&, i] {
            return state.view.layers[i].shown ? "on" : "off";
        };
    }
    return list;
}

} // namespace vdbcage::view
