#include <tools/view/picture/picture_control.h>

#include <algorithm>
#include <cmath>

#include <tools/edit/selection.h>
#include <tools/view/state/move.h>
#include <tools/view/state/words.h>
#include <vdbcage/core/detail/length_text.h>
#include <vdbcage/core/error.h>

namespace vdbcage::view {

namespace {

using openvdb::Vec3d;

constexpr double degreesPerPixel = 0.4, factorPerNotch = 1.15, zoomPerPixel = 1.01;
/// A press that moves less is a click; what is nearer to one is hit. Pixels on an ordinary screen.
constexpr double clickRadius = 3, pickRadius = 9;
/// Of a lasso, two corners are farther apart.
constexpr double lassoStep = 3;
constexpr double snappedDegrees = 15, snappedFactor = 0.1;

/// Numbers separated by spaces; what cannot be read is 0.
std::vector<double> numbersIn(const std::string& text)
{
    std::vector<double> numbers;
    for (const std::string& word : wordsOf(text)) {
        try {
            numbers.push_back(numberOf(word, "number"));
        } catch (const InputError&) { // it is not complete yet, such as "-"
            numbers.push_back(0);
        }
    }
    return numbers;
}

/// Of the box between two corners.
std::vector<Pixel> corners(const std::vector<Pixel>& box)
{
    return {box[0], {box[1][0], box[0][1]}, box[1], {box[0][0], box[1][1]}};
}

} // namespace

Pixel PictureControl::inPicture() const
{
    const Rectangle place = host_.place();
    return {x_ - place.left, y_ - place.top};
}

std::array<double, 2> PictureControl::inPanel(const Pixel& at) const
{
    const Rectangle place = host_.place();
    return {2 * at[0] / place.width - 1, 1 - 2 * at[1] / place.height};
}

double PictureControl::aspect() const
{
    const Rectangle place = host_.place();
    return 1.0 * place.width / place.height;
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
        if (grip_) return;
        const auto [x, y] = inPanel(inPicture());
        const draw::Camera& camera = host_.session.state().view.camera;
        setCamera(draw::zoomed(camera, aspect(), std::pow(factorPerNotch, wheel->y), x, y));
    }
}

void PictureControl::begin(const ButtonDown& down, const Modifiers& modifiers)
{
    if (grip_) {
        if (!grip_->isFree) return;
        if (down.button == Button::left) return finish();
        return cancel();
    }
    if (held_) return;
    held_ = down;
    heldWith_ = modifiers;
    drag_.reset();
    pressedX_ = x_;
    pressedY_ = y_;
    const State& state = host_.session.state();
    if (!state.document.model) return;
    const DragBinding* const binding = dragOf(mouse_, {down.button, modifiers});
    const bool isGrip = !isBoxArmed_ && !(binding && binding->winsOverHandles) && down.button == Button::left && hot_;
    if (isGrip) {
        grip_ = gripOf(state.view.tool, *hot_, false);
        if (grip_) return host_.session.beginDrag();
    }
    if (binding) drag_ = binding->action;
    if (isBoxArmed_) drag_ = DragAction::box;
    if (drag_ == DragAction::box || drag_ == DragAction::lasso) {
        band_ = {inPicture()};
        return;
    }
    if (!drag_) return;
    const auto [x, y] = inPanel(inPicture());
    pivot_ = host_.viewport.pointAt(x, y).value_or(
        host_.viewport.selectionCentre(state.view).value_or(state.view.camera.target));
}

void PictureControl::move(const PointerMoved& moved, const Modifiers& modifiers)
{
    const double dx = moved.x - x_, dy = moved.y - y_;
    x_ = moved.x;
    y_ = moved.y;
    if (!held_ && !grip_) {
        homeX_ = x_;
        homeY_ = y_;
    }
    if (grip_) {
        grip_->isSnapping = modifiers.control;
        return follow();
    }
    if (!held_) {
        const auto frame = gizmoFrame();
        hot_.reset();
        if (frame) hot_ = handleAt(gizmoParts(*frame, host_.session.state().view.tool), host_.pixel, inPicture());
        return;
    }
    if (!host_.session.state().document.model || !drag_) return;
    const bool isStill = std::hypot(x_ - pressedX_, y_ - pressedY_) < clickRadius * host_.pixel;
    if (!band_.empty()) {
        if (isStill && band_.size() == 1) return;
        const Pixel at = inPicture();
        if (*drag_ == DragAction::box) {
            band_.resize(1);
            band_.push_back(at);
        } else if (std::hypot(at[0] - band_.back()[0], at[1] - band_.back()[1]) >= lassoStep * host_.pixel) {
            band_.push_back(at);
        }
        return;
    }
    if (!isCameraDragged_) {
        if (isStill) return;
        isCameraDragged_ = true;
        host_.session.beginDrag();
    }
    dragCamera(dx, dy);
}

void PictureControl::dragCamera(double dx, double dy)
{
    const draw::Camera& camera = host_.session.state().view.camera;
    if (*drag_ == DragAction::pan) {
        const Rectangle place = host_.place();
        setCamera(draw::panned(camera, aspect(), 2 * dx / place.width, -2 * dy / place.height));
    } else if (*drag_ == DragAction::turn) {
        const double degrees = degreesPerPixel / host_.pixel;
        setCamera(draw::orbited(camera, -degrees * dx, degrees * dy, pivot_));
    } else {
        const Rectangle place = host_.place();
        const auto [x, y] = inPanel({pressedX_ - place.left, pressedY_ - place.top});
        setCamera(draw::zoomed(camera, aspect(), std::pow(zoomPerPixel, -dy / host_.pixel), x, y));
    }
}

void PictureControl::release(const Modifiers& modifiers)
{
    if (grip_ && grip_->isFree) return;
    if (!held_) return;
    const ButtonDown button = *std::exchange(held_, std::nullopt);
    if (grip_) return finish();
    if (isCameraDragged_) {
        isCameraDragged_ = false;
        return host_.endDrag();
    }
    const State& state = host_.session.state();
    const std::vector<Pixel> band = std::exchange(band_, {});
    isBoxArmed_ = false;
    if (band.size() > 1) {
        std::vector<Pixel> border = band;
        if (*drag_ == DragAction::box) border = corners(band);
        return select(host_.viewport.elementsWithin(state.view, border), pickOf(mouse_.bands, modifiers));
    }
    if (button.button != Button::left || !state.document.model) return;
    const auto hit = host_.viewport.elementAt(state.view, inPicture(), pickRadius * host_.pixel);
    std::vector<openvdb::Index32> ids;
    if (hit) ids.push_back(*hit);
    select(ids, pickOf(mouse_.clicks, heldWith_));
}

void PictureControl::select(const std::vector<openvdb::Index32>& ids, PickAction action)
{
    edit::Selection selection = host_.session.state().view.selection;
    const edit::Selection these{selection.kind, ids};
    switch (action) {
    case PickAction::none:
        break;
    case PickAction::replace:
        selection = these;
        break;
    case PickAction::toggle:
        selection = edit::added(edit::removed(selection, these), edit::removed(these, selection));
        break;
    case PickAction::add:
        selection = edit::added(selection, these);
        break;
    case PickAction::remove:
        selection = edit::removed(selection, these);
        break;
    }
    if (selection != host_.session.state().view.selection) host_.attempt(Select{selection});
}

std::optional<GizmoFrame> PictureControl::gizmoFrame() const
{
    const State& state = host_.session.state();
    GizmoFrame frame;
    frame.eye = host_.viewport.eye();
    const auto selected = selectionFrame(state, host_.session.cage(), {frame.eye.right, frame.eye.up, frame.eye.back});
    if (!selected) return std::nullopt;
    const Rectangle place = host_.place();
    frame.width = place.width;
    frame.height = place.height;
    frame.pixel = host_.pixel;
    frame.origin = host_.viewport.frame().toDrawing(selected->origin);
    frame.axes = selected->axes;
    return frame;
}

std::optional<PictureControl::Grip> PictureControl::gripOf(Tool tool, const Handle& handle, bool isFree) const
{
    const auto frame = gizmoFrame();
    if (!frame) return std::nullopt;
    const SelectionFrame selected = *selectionFrame(host_.session.state(), host_.session.cage(), frame->axes);
    Grip grip;
    grip.tool = tool;
    grip.handle = handle;
    grip.from = inPicture();
    grip.frame = *frame;
    // What is moved freely stays under the pointer, wherever the pivot is.
    if (isFree && tool == Tool::move) grip.frame.origin = host_.viewport.frame().toDrawing(selected.mean);
    grip.isFree = isFree;
    grip.pivot = selected.origin;
    grip.unit = host_.viewport.frame().unit();
    return grip;
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
    band_.clear();
    held_.reset();
    if (!grip_) return;
    grip_.reset();
    host_.session.cancelDrag();
}

void PictureControl::finish()
{
    grip_.reset();
    host_.endDrag();
}

bool PictureControl::press(const KeyDown& down, const Modifiers& modifiers)
{
    if (!isBusy()) return false;
    if (down.key == Key::escape) {
        cancel();
        return true;
    }
    if (!grip_) return true;
    const std::string name = nameOf(down.key);
    if (down.key == Key::enter || down.key == Key::keypadEnter || down.key == Key::space) {
        finish();
        return true;
    }
    if (down.key >= Key::x && down.key <= Key::z) {
        const int axis = static_cast<int>(down.key) - static_cast<int>(Key::x);
        const Handle wanted{modifiers.shift ? Handle::Kind::plane : Handle::Kind::axis, axis};
        // The same key again makes it free again.
        grip_->handle = grip_->handle == wanted ? Handle{} : wanted;
    } else if (down.key == Key::backspace) {
        if (!grip_->typed.empty()) grip_->typed.pop_back();
    } else if (down.key == Key::period || down.key == Key::keypadDecimal) {
        grip_->typed += '.';
    } else if (down.key == Key::minus || down.key == Key::keypadSubtract) {
        grip_->typed += '-';
    } else if (down.key == Key::tab) {
        grip_->typed += ' ';
    } else if (!name.empty() && name.back() >= '0' && name.back() <= '9' &&
               (name.size() == 1 || name.rfind("keypad-", 0) == 0)) {
        grip_->typed += name.back();
    }
    follow();
    return true;
}

double PictureControl::snappingStep() const
{
    return grip_->tool == Tool::rotate  ? snappedDegrees
           : grip_->tool == Tool::scale ? snappedFactor
                                        : host_.viewport.gridStep() / 10;
}

/// What is moved by, in world units.
Amount PictureControl::amount() const
{
    const Grip& grip = *grip_;
    Amount amount = draggedAmount(grip.frame, grip.tool, grip.handle, grip.from, inPicture());
    if (grip.tool == Tool::move) amount.values *= grip.unit;
    if (grip.isSnapping) {
        const double step = snappingStep();
        for (int k = 0; k < 3; ++k) amount.values[k] = std::round(amount.values[k] / step) * step;
    }
    const std::vector<double> typed = numbersIn(grip.typed);
    if (typed.empty()) return amount;
    if (grip.tool == Tool::rotate) {
        amount.values[0] = typed[0];
        return amount;
    }
    // Numbers are for the axes that can be set, in order. One alone scales all of them.
    amount.values = Vec3d(grip.tool == Tool::scale ? 1 : 0);
    std::size_t next = 0;
    for (int k = 0; k < 3; ++k) {
        const bool isSet = grip.handle.kind == Handle::Kind::screen ||
                           (grip.handle.kind == Handle::Kind::axis) == (k == grip.handle.axis);
        if (!isSet) continue;
        if (next < typed.size()) {
            amount.values[k] = typed[next++];
        } else if (grip.tool == Tool::scale && typed.size() == 1) {
            amount.values[k] = typed[0];
        }
    }
    return amount;
}

void PictureControl::follow()
{
    const Grip& grip = *grip_;
    const Vec3d by = amount().values;
    const std::array<Vec3d, 3>& axes = grip.frame.axes;
    try {
        if (grip.tool == Tool::move) {
            host_.session.replaceDragged(MoveSelected{axes[0] * by[0] + axes[1] * by[1] + axes[2] * by[2]});
        } else if (grip.tool == Tool::rotate) {
            host_.session.replaceDragged(RotateSelected{rotationAxis(grip.frame, grip.handle), by[0], grip.pivot});
        } else {
            host_.session.replaceDragged(ScaleSelected{by, grip.pivot, {axes[0], axes[1]}});
        }
    } catch (const InputError&) { // too far away: it stays where it was
    }
}

PictureOverlay PictureControl::overlay() const
{
    PictureOverlay overlay;
    const State& state = host_.session.state();
    if (!host_.session.cage() || !state.view.layer(LayerId::cage).shown) return overlay;
    if (!band_.empty()) {
        const bool isBox = drag_ == DragAction::box && band_.size() > 1;
        overlay.band = isBox ? corners(band_) : band_;
    }
    const auto frame = gizmoFrame();
    if (frame && !grip_) overlay.gizmo = gizmoParts(*frame, state.view.tool);
    overlay.hot = hot_;
    host_.viewport.addElements(state.view, grip_.has_value(), overlay);
    if (isBoxArmed_) overlay.hint = "Drag a box; " + describeBands(mouse_) + ", Escape ends";
    if (!grip_) return overlay;
    const Amount by = amount();
    static constexpr std::array<const char*, 4> verbs{"", "Move", "Rotate", "Scale"};
    overlay.hint = verbs[static_cast<std::size_t>(grip_->tool)];
    if (grip_->handle.kind != Handle::Kind::screen) {
        const auto axis = static_cast<char>('X' + grip_->handle.axis);
        overlay.hint +=
            grip_->handle.kind == Handle::Kind::axis ? std::string(" along ") + axis : std::string(" across ") + axis;
        overlay.hint += std::string(", ") + orientationNames[static_cast<std::size_t>(state.view.orientation)];
    }
    const auto number = [&](int k) { return detail::lengthText(by.values[k], snappingStep() / 1000); };
    overlay.hint += ": " + number(0);
    overlay.hint += grip_->tool == Tool::rotate ? " degrees" : "  " + number(1) + "  " + number(2);
    if (!grip_->typed.empty()) overlay.hint += "   [" + grip_->typed + "]";
    return overlay;
}

} // namespace vdbcage::view
