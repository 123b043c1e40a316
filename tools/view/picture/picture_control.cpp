#include <tools/view/picture/picture_control.h>

#include <cmath>

#include <tools/edit/selection.h>
#include <tools/view/state/cage_changes.h>
#include <vdbcage/core/error.h>

namespace vdbcage::view {

namespace {

constexpr double factorPerNotch = 1.15;
/// The longest motion of a click, and the farthest distance of a hit. Pixels on an ordinary screen.
constexpr double clickRadius = 3, pickRadius = 9;
/// The least distance between two corners of a lasso.
constexpr double lassoStep = 3;

/// Returns the selection after `these` are picked.
edit::Selection picked(const edit::Selection& selected, const edit::Selection& these, PickAction action)
{
    switch (action) {
    case PickAction::none:
        break;
    case PickAction::replace:
        return these;
    case PickAction::toggle:
        return edit::added(edit::removed(selected, these), edit::removed(these, selected));
    case PickAction::add:
        return edit::added(selected, these);
    case PickAction::remove:
        return edit::removed(selected, these);
    }
    return selected;
}

} // namespace

Pixel PictureControl::inPicture() const
{
    const Rectangle place = host_.place();
    return {at_[0] - place.left, at_[1] - place.top};
}

bool PictureControl::isStill() const
{
    return std::hypot(at_[0] - pressed_[0], at_[1] - pressed_[1]) < clickRadius * host_.pixel;
}

void PictureControl::handle(const InputEvent& event)
{
    if (const auto* const moved = std::get_if<PointerMoved>(&event.what)) {
        move(*moved, event.modifiers);
    } else if (const auto* const down = std::get_if<ButtonDown>(&event.what)) {
        begin(*down, event.modifiers);
    } else if (std::holds_alternative<ButtonUp>(event.what)) {
        release(event.modifiers);
    } else if (const auto* const wheel = std::get_if<WheelTurned>(&event.what)) {
        zoom(*wheel);
    }
}

void PictureControl::zoom(const WheelTurned& wheel)
{
    if (grip_) return;
    const Rectangle place = host_.place();
    const auto [x, y] = inPanel(place, inPicture());
    const draw::Camera& camera = host_.session.state().view.camera;
    host_.attempt(SetCamera{draw::zoomed(camera, aspectOf(place), std::pow(factorPerNotch, wheel.y), x, y)});
}

void PictureControl::begin(const ButtonDown& down, const Modifiers& modifiers)
{
    if (grip_) {
        if (!grip_->isFree()) return;
        return down.button == Button::left ? finish() : cancel();
    }
    if (held_) return;
    held_ = down;
    heldWith_ = modifiers;
    cameraDrag_.reset();
    pressed_ = at_;
    const State& state = host_.session.state();
    if (!state.document.model) return;
    const DragBinding* const binding = dragOf(mouse_, {down.button, modifiers});
    const bool isGrip = !isBoxArmed_ && !(binding && binding->winsOverHandles) && down.button == Button::left && hot_;
    if (isGrip) {
        grip_ = gripOf(state.view.tool, *hot_, false);
        if (grip_) return host_.session.beginDrag();
    }
    if (!binding && !isBoxArmed_) return;
    const DragAction action = isBoxArmed_ ? DragAction::box : binding->action;
    if (action == DragAction::box || action == DragAction::lasso) {
        band_ = Band(action == DragAction::box, inPicture());
        return;
    }
    const auto [x, y] = inPanel(host_.place(), inPicture());
    const auto pivot = host_.viewport.pointAt(x, y);
    cameraDrag_ = CameraDrag{
        action, inPicture(),
        pivot ? *pivot : host_.viewport.selectionCentre(state.view).value_or(state.view.camera.target), host_.pixel};
}

void PictureControl::move(const PointerMoved& moved, const Modifiers& modifiers)
{
    const double dx = moved.x - at_[0], dy = moved.y - at_[1];
    at_ = {moved.x, moved.y};
    if (!held_ && !grip_) home_ = at_;
    if (grip_) {
        grip_->moveTo(inPicture(), modifiers.control);
        return follow();
    }
    if (!held_) {
        const auto frame = gizmoFrame();
        hot_.reset();
        if (frame) hot_ = handleAt(gizmoParts(*frame, host_.session.state().view.tool), host_.pixel, inPicture());
        return;
    }
    if (band_.isThere()) {
        if (band_.hasInside() || !isStill()) band_.moveTo(inPicture(), lassoStep * host_.pixel);
        return;
    }
    if (!cameraDrag_) return;
    if (!isCameraDragged_) {
        if (isStill()) return;
        isCameraDragged_ = true;
        host_.session.beginDrag();
    }
    host_.attempt(SetCamera{cameraDrag_->moved(host_.session.state().view.camera, host_.place(), dx, dy)});
}

void PictureControl::release(const Modifiers& modifiers)
{
    if (grip_ && grip_->isFree()) return;
    if (!held_) return;
    const ButtonDown button = *std::exchange(held_, std::nullopt);
    if (grip_) return finish();
    if (isCameraDragged_) {
        isCameraDragged_ = false;
        return host_.endDrag();
    }
    const State& state = host_.session.state();
    const Band band = std::exchange(band_, Band());
    isBoxArmed_ = false;
    if (band.hasInside()) {
        return select(host_.viewport.elementsWithin(state.view, band.border()), pickOf(mouse_.bands, modifiers));
    }
    if (button.button != Button::left || !state.document.model) return;
    const auto hit = host_.viewport.elementAt(state.view, inPicture(), pickRadius * host_.pixel);
    std::vector<openvdb::Index32> ids;
    if (hit) ids.push_back(*hit);
    select(ids, pickOf(mouse_.clicks, heldWith_));
}

void PictureControl::select(const std::vector<openvdb::Index32>& ids, PickAction action)
{
    const edit::Selection& before = host_.session.state().view.selection;
    const edit::Selection after = picked(before, {before.kind, ids}, action);
    if (after != before) host_.attempt(Select{after});
}

std::optional<GizmoFrame> PictureControl::gizmoFrame() const
{
    GizmoFrame frame;
    frame.eye = host_.viewport.eye();
    const auto selected =
        selectionFrame(host_.session.state(), host_.session.cage(), {frame.eye.right, frame.eye.up, frame.eye.back});
    if (!selected) return std::nullopt;
    const Rectangle place = host_.place();
    frame.width = place.width;
    frame.height = place.height;
    frame.pixel = host_.pixel;
    frame.origin = host_.viewport.shapes().frame().toDrawing(selected->origin);
    frame.axes = selected->axes;
    return frame;
}

std::optional<Grip> PictureControl::gripOf(Tool tool, const Handle& handle, bool isFree) const
{
    auto frame = gizmoFrame();
    if (!frame) return std::nullopt;
    const LayerShapes& shapes = host_.viewport.shapes();
    const SelectionFrame selected = *selectionFrame(host_.session.state(), host_.session.cage(), frame->axes);
    // A selection that is moved freely stays under the pointer, wherever the pivot is.
    if (isFree && tool == Tool::move) frame->origin = shapes.frame().toDrawing(selected.mean);
    return Grip(
        {tool, handle, isFree, inPicture(), *frame, selected.origin, shapes.frame().unit(), shapes.ground().step()});
}

void PictureControl::grab(Tool tool)
{
    if (isBusy() || held_) return;
    auto grip = gripOf(tool, {}, true);
    if (!grip) throw InputError("nothing of the cage is selected");
    grip_ = std::move(grip);
    host_.session.beginDrag();
}

void PictureControl::startBox()
{
    if (!isBusy() && !held_) isBoxArmed_ = true;
}

void PictureControl::cancel()
{
    isBoxArmed_ = false;
    band_ = Band();
    held_.reset();
    if (!grip_) return;
    grip_.reset();
    refusal_.clear();
    host_.session.cancelDrag();
}

void PictureControl::finish()
{
    grip_.reset();
    refusal_.clear();
    host_.endDrag();
}

bool PictureControl::press(const KeyDown& down, const Modifiers& modifiers)
{
    if (!isBusy()) return false;
    if (down.key == Key::escape) {
        cancel();
    } else if (grip_ && (down.key == Key::enter || down.key == Key::keypadEnter || down.key == Key::space)) {
        finish();
    } else if (grip_) {
        grip_->press(down, modifiers);
        follow();
    }
    return true;
}

void PictureControl::follow()
{
    try {
        host_.session.replaceDragged(grip_->command());
        refusal_.clear();
    } catch (const InputError& error) { // too far away, or locked: it stays where it was
        refusal_ = error.what();
    }
}

PictureOverlay PictureControl::overlay() const
{
    PictureOverlay overlay;
    const State& state = host_.session.state();
    const ViewState& view = state.view;
    if (!host_.session.cage() || !view.layer(LayerId::cage).shown) return overlay;
    overlay.band = band_.border();
    const auto frame = gizmoFrame();
    if (frame && !grip_) overlay.gizmo = gizmoParts(*frame, view.tool);
    overlay.hot = hot_;
    // Poses move locked points too.
    const bool hasLocks = view.mode == Mode::shape;
    host_.viewport.addElements(view, hasLocks ? state.document.locked : std::vector<openvdb::Index32>(),
                               grip_.has_value(), overlay);
    if (isBoxArmed_) overlay.hint = "Drag a box; " + describeBands(mouse_) + ", Escape ends";
    if (grip_) overlay.hint = refusal_.empty() ? grip_->describe(view.orientation) : refusal_;
    return overlay;
}

} // namespace vdbcage::view
