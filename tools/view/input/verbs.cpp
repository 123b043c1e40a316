#include <tools/view/input/verbs.h>

#include <algorithm>

#include <tools/edit/selection.h>
#include <tools/view/state/animation.h>
#include <tools/view/state/cage_changes.h>
#include <vdbcage/core/error.h>

namespace vdbcage::view {

namespace {

using Table = LineTable<Verb>;

Command withFaces(const Situation& now, int steps)
{
    const CageOptions& options = now.state.document.options;
    return SetOption{"faces", std::to_string(steppedFaces(options.faces, steps, options.mesh))};
}

/// Returns the mirror in the plane of the cage's symmetry, or else through the cage's middle.
SetMirror toggledMirror(const Situation& now, int axis)
{
    const State& state = now.state;
    if (state.view.mirror && state.view.mirror->axis == axis) return {};
    if (!now.cage) throw InputError("toggle", "there is no cage yet to be mirrored");
    if (now.symmetry && now.symmetry->axis == axis) return {*now.symmetry};
    const openvdb::BBoxd box = boundingBox(*now.cage->rest());
    return {SymmetryPlane{axis, 0.5 * (box.min()[axis] + box.max()[axis])}};
}

/// Returns the selection after `change`, which gets the cage and its selection.
template <class T, class Change>
Command selected(const Situation& now, const Change& change)
{
    if (!now.cage) throw InputError(T::info().name, "there is no cage yet");
    const edit::Elements elements(*now.cage->rest());
    return Select{change(elements, withinCage(now.state.view.selection, elements))};
}

/// Returns the frame of the next key in a direction, or the present one if there is none.
SetFrame nextKey(const Situation& now, int direction)
{
    const int frame = now.state.view.frame;
    int next = frame;
    for (const PoseKey& key : now.state.document.poses.keys()) {
        if (direction < 0 && key.frame < frame) next = key.frame;
        if (direction > 0 && key.frame > frame) return {key.frame};
    }
    return {next};
}

} // namespace

Command MoreFaces::command(const Situation& now)
{
    return withFaces(now, 1);
}

Command FewerFaces::command(const Situation& now)
{
    return withFaces(now, -1);
}

Command Toggle::command(const Situation& now) const
{
    const ViewState& view = now.state.view;
    if (what == "ground") return ShowGround{!view.ground};
    if (what == "axes") return ShowAxes{!view.axes};
    if (what == "turntable") return SetTurntable{!view.turntable};
    if (what == "see-through") return SetSeeThrough{!view.seeThrough};
    // Playing without keys must not begin, or it would start by itself later.
    State playing = now.state;
    playing.view.isPlaying = true;
    if (what == "play") return Play{!view.isPlaying && Animation::isPlaying(playing)};
    if (what == "mode") return SetMode{view.mode == Mode::pose ? Mode::shape : Mode::pose};
    for (int axis = 0; axis < 3; ++axis) {
        if (what == std::string("mirror-") + "xyz"[axis]) return toggledMirror(now, axis);
    }
    for (std::size_t i = 0; i < layerCount; ++i) {
        if (what == nameOf(static_cast<LayerId>(i))) return ShowLayer{static_cast<LayerId>(i), !view.layers[i].shown};
    }
    refuse("toggle", what, "a layer, ground, axes, turntable, mode, play, see-through, mirror-x, mirror-y or mirror-z");
}

Command Look::command(const Situation& now) const
{
    constexpr std::array<std::array<double, 2>, names.size()> directions{
        {{0, 0}, {180, 0}, {-90, 0}, {90, 0}, {0, 90}, {0, -90}}}; // azimuth, elevation
    draw::Camera camera = now.state.view.camera;
    const auto& [azimuth, elevation] = directions[static_cast<std::size_t>(from)];
    camera.view.azimuthDegrees = azimuth;
    camera.view.elevationDegrees = elevation;
    return SetCamera{camera};
}

SetProjection SetProjection::read(const Arguments& arguments)
{
    constexpr std::array<const char*, 3> names{"perspective", "orthographic", "toggle"};
    const auto i = arguments.choice<std::size_t>(0, names);
    return i == 2 ? SetProjection{} : SetProjection{static_cast<draw::Projection>(i)};
}

Command SetProjection::command(const Situation& now) const
{
    draw::Camera camera = now.state.view.camera;
    const bool isParallel = camera.projection == draw::Projection::orthographic;
    camera.projection =
        projection.value_or(isParallel ? draw::Projection::perspective : draw::Projection::orthographic);
    return SetCamera{camera};
}

SetUp SetUp::read(const Arguments& arguments)
{
    constexpr std::array<const char*, 3> names{"y", "z", "toggle"};
    const auto i = arguments.choice<std::size_t>(0, names);
    return i == 2 ? SetUp{} : SetUp{static_cast<draw::UpAxis>(i)};
}

Command SetUp::command(const Situation& now) const
{
    draw::Camera camera = now.state.view.camera;
    camera.view.up = up.value_or(camera.view.up == draw::UpAxis::y ? draw::UpAxis::z : draw::UpAxis::y);
    return SetCamera{camera};
}

Command SelectKind::command(const Situation& now) const
{
    return selected<SelectKind>(now, [&](const auto& cage, const auto& some) { return converted(cage, some, kind); });
}

Command SelectAll::command(const Situation& now)
{
    return selected<SelectAll>(now, [](const auto& cage, const auto& some) { return edit::all(cage, some.kind); });
}

Command SelectNone::command(const Situation& now)
{
    return selected<SelectNone>(now, [](const auto&, const auto& some) { return edit::Selection{some.kind, {}}; });
}

Command SelectInvert::command(const Situation& now)
{
    return selected<SelectInvert>(now, edit::inverted);
}

Command SelectLinked::command(const Situation& now)
{
    return selected<SelectLinked>(now, edit::linked);
}

Command SelectGrow::command(const Situation& now)
{
    return selected<SelectGrow>(now, edit::grown);
}

Command SelectShrink::command(const Situation& now)
{
    return selected<SelectShrink>(now, edit::shrunk);
}

Command SelectLoop::command(const Situation& now)
{
    return selected<SelectLoop>(now, edit::loop);
}

Grab Grab::read(const Arguments& arguments)
{
    constexpr std::array<const char*, 3> names{"move", "rotate", "scale"};
    return {static_cast<Tool>(1 + arguments.choice<int>(0, names))};
}

Command NextFrame::command(const Situation& now)
{
    return SetFrame{std::min(now.state.view.frame + 1, lastFrame)};
}

Command PreviousFrame::command(const Situation& now)
{
    return SetFrame{std::max(now.state.view.frame - 1, 0)};
}

Command NextKey::command(const Situation& now)
{
    return nextKey(now, 1);
}

Command PreviousKey::command(const Situation& now)
{
    return nextKey(now, -1);
}

Command InsertKey::command(const Situation& now)
{
    return SetKey{now.state.view.frame};
}

Command RemoveKey::command(const Situation& now)
{
    return DeleteKey{now.state.view.frame};
}

LineHelp describeVerbs()
{
    return Table::help();
}

std::string textOf(const Action& action)
{
    if (const auto* const command = std::get_if<Command>(&action)) return toText(*command);
    return Table::text(std::get<Verb>(action));
}

Action actionOf(const Words& words)
{
    if (auto command = tryCommandOf(words)) return *std::move(command);
    if (auto verb = Table::read(words)) return *std::move(verb);
    throw InputError("'" + (words.empty() ? std::string() : words[0]) + "' is no command");
}

namespace {

template <class T, class = void>
constexpr bool saysRecorded = false;
template <class T>
constexpr bool saysRecorded<T, std::void_t<decltype(T::isRecorded)>> = T::isRecorded;

} // namespace

bool isRecorded(const Action& action)
{
    const auto* const verb = std::get_if<Verb>(&action);
    return !verb || std::visit([](const auto& each) { return saysRecorded<std::decay_t<decltype(each)>>; }, *verb);
}

} // namespace vdbcage::view
