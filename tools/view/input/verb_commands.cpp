#include <tools/view/input/verb_commands.h>

#include <algorithm>
#include <array>
#include <cmath>

#include <tools/edit/selection.h>
#include <tools/view/jobs/planner.h>
#include <tools/view/state/animation.h>
#include <tools/view/state/move.h>
#include <tools/view/state/words.h>
#include <vdbcage/core/error.h>

namespace vdbcage::view {

namespace {

edit::Element kindNamed(const std::string& name)
{
    const auto* const found = std::find(edit::elementNames.begin(), edit::elementNames.end(), name);
    if (found == edit::elementNames.end()) refuse("select-kind", name, "points, edges or faces");
    return static_cast<edit::Element>(found - edit::elementNames.begin());
}

edit::Selection selectionAfter(const State& state, const std::string& verb, const std::string& kind)
{
    if (!state.cage) throw InputError(verb + ": there is no cage yet");
    const edit::Elements elements(*state.cage);
    const edit::Selection selected = withinCage(state.view.selection, elements);
    if (verb == "select-kind") return edit::converted(elements, selected, kindNamed(kind));
    if (verb == "select-all") return edit::all(elements, selected.kind);
    if (verb == "select-none") return {selected.kind, {}};
    if (verb == "select-invert") return edit::inverted(elements, selected);
    if (verb == "select-linked") return edit::linked(elements, selected);
    if (verb == "select-grow") return edit::grown(elements, selected);
    if (verb == "select-shrink") return edit::shrunk(elements, selected);
    return edit::loop(elements, selected);
}

/// The plane is that in which the cage was made symmetric, or else the middle of the cage.
SetMirror toggledMirror(const State& state, const std::optional<SymmetryPlane>& made, int axis)
{
    if (state.view.mirror && state.view.mirror->axis == axis) return {};
    if (!state.cage) throw InputError("toggle: there is no cage yet to be mirrored");
    if (made && made->axis == axis) return {*made};
    const openvdb::BBoxd box = boundingBox(*state.cage);
    return {SymmetryPlane{axis, 0.5 * (box.min()[axis] + box.max()[axis])}};
}

Command toggled(const State& state, const std::optional<SymmetryPlane>& made, const std::string& what)
{
    const ViewState& view = state.view;
    if (what == "ground") return ShowGround{!view.ground};
    if (what == "axes") return ShowAxes{!view.axes};
    if (what == "turntable") return SetTurntable{!view.turntable};
    if (what == "see-through") return SetSeeThrough{!view.seeThrough};
    // What cannot play now would begin by itself later.
    State playing = state;
    playing.view.isPlaying = true;
    if (what == "play") return Play{!view.isPlaying && Animation::isPlaying(playing)};
    if (what == "mode") return SetMode{view.mode == Mode::pose ? Mode::shape : Mode::pose};
    for (int axis = 0; axis < 3; ++axis) {
        if (what == std::string("mirror-") + "xyz"[axis]) return toggledMirror(state, made, axis);
    }
    for (std::size_t i = 0; i < layerCount; ++i) {
        if (what == nameOf(static_cast<LayerId>(i))) return ShowLayer{static_cast<LayerId>(i), !view.layers[i].shown};
    }
    refuse("toggle", what, "a layer, ground, axes, turntable, mode, play, see-through, mirror-x, mirror-y or mirror-z");
}

SetCamera lookingFrom(draw::Camera camera, const std::string& side)
{
    struct Side {
        const char* name;
        double azimuth, elevation;
    };
    constexpr std::array<Side, 6> sides{
        {{"front", 0, 0}, {"back", 180, 0}, {"right", 90, 0}, {"left", -90, 0}, {"top", 0, 90}, {"bottom", 0, -90}}};
    const auto* const found = std::find_if(sides.begin(), sides.end(), [&](const Side& s) { return side == s.name; });
    if (found == sides.end()) refuse("look", side, "front, back, left, right, top or bottom");
    camera.view.azimuthDegrees = found->azimuth;
    camera.view.elevationDegrees = found->elevation;
    return {camera};
}

SetCamera withUp(draw::Camera camera, const std::string& axis)
{
    if (axis != "y" && axis != "z" && axis != "toggle") refuse("up", axis, "y, z or toggle");
    const bool isY = camera.view.up == draw::UpAxis::y;
    camera.view.up = axis == "z" || (axis == "toggle" && isY) ? draw::UpAxis::z : draw::UpAxis::y;
    return {camera};
}

SetCamera withProjection(draw::Camera camera, const std::string& kind)
{
    if (kind != "perspective" && kind != "orthographic" && kind != "toggle") {
        refuse("projection", kind, "perspective, orthographic or toggle");
    }
    const bool isParallel = camera.projection == draw::Projection::orthographic;
    camera.projection = kind == "orthographic" || (kind == "toggle" && !isParallel) ? draw::Projection::orthographic
                                                                                    : draw::Projection::perspective;
    return {camera};
}

/// The frame of the next key in a direction, or where it is now if there is none.
int nextKey(const TimeLine& poses, int frame, int direction)
{
    int next = frame;
    for (const PoseKey& key : poses.keys()) {
        if (direction < 0 && key.frame < frame) next = key.frame;
        if (direction > 0 && key.frame > frame) return key.frame;
    }
    return next;
}

} // namespace

std::optional<Command> commandOfVerb(const State& state, const std::optional<SymmetryPlane>& made,
                                     const std::string& verb, const std::string& argument)
{
    const ViewState& view = state.view;
    if (verb == "more" || verb == "fewer") {
        const int faces =
            steppedFaces(state.document.options.faces, verb == "more" ? 1 : -1, state.document.options.mesh);
        return SetOption{"faces", std::to_string(faces)};
    }
    if (verb == "toggle") return toggled(state, made, argument);
    if (verb == "look") return lookingFrom(view.camera, argument);
    if (verb == "up") return withUp(view.camera, argument);
    if (verb == "projection") return withProjection(view.camera, argument);
    if (verb.rfind("select-", 0) == 0) return Select{selectionAfter(state, verb, argument)};
    if (verb == "next-frame") return SetFrame{std::min(view.frame + 1, lastFrame)};
    if (verb == "previous-frame") return SetFrame{std::max(view.frame - 1, 0)};
    if (verb == "next-key") return SetFrame{nextKey(state.document.poses, view.frame, 1)};
    if (verb == "previous-key") return SetFrame{nextKey(state.document.poses, view.frame, -1)};
    if (verb == "insert-key") return SetKey{view.frame};
    if (verb == "remove-key") return DeleteKey{view.frame};
    return std::nullopt;
}

} // namespace vdbcage::view
