#pragma once

#include <functional>
#include <optional>
#include <vector>

#include <tools/view/input/input.h>
#include <tools/view/input/key_map.h>
#include <tools/view/picture/drags.h>
#include <tools/view/picture/grip.h>
#include <tools/view/picture/viewport.h>
#include <tools/view/state/session.h>

namespace vdbcage::view {

/// The control of the picture by the pointer, and by keys during a motion: it turns the view (see CameraDrag), selects
/// parts of the cage (see Band), and moves the selection (see Grip), by handles or freely. It acts by commands, which
/// the host performs; but it begins drags in the session itself, and there replaces the command of a motion at each
/// event, or cancels it. The host ends and records drags.
class PictureControl {
public:
    /// The things that it acts on. All must outlive it.
    struct Host {
        Session& session;
        Viewport& viewport;
        std::function<void(const Command&)> attempt; ///< performs it for the user
        std::function<void()> endDrag;               ///< ends the session's drag and records its effect
        std::function<Rectangle()> place;            ///< of the picture in the window
        double pixel = 1;                            ///< pixels per pixel of an ordinary screen
    };
    explicit PictureControl(Host host) : host_(std::move(host)) {}

    /// Sets the actions of its buttons; a drag under way goes on as it began.
    void setMouse(const MouseMap& map) { mouse_ = map; }

    /// Takes a pointer event that no panel took, or any while isHeld().
    void handle(const InputEvent& event);
    /// Takes a key for the motion under way. Returns whether it took it.
    bool press(const KeyDown& down, const Modifiers& modifiers);

    /// Moves, turns or scales the selection with the pointer until a click, Enter or Escape. \pre tool is not select
    /// \throw InputError nothing is selected, or there is no cage
    void grab(Tool tool);
    /// Makes the next drag select the elements in a box.
    void startBox();

    /// Returns the pointer's position, in pixels of the window.
    Pixel pointer() const { return at_; }
    /// Returns its position at the beginning of the drag or motion under way.
    Pixel home() const { return home_; }
    /// Returns whether it gets all events of the pointer, wherever that is.
    bool isHeld() const { return held_.has_value() || (grip_ && grip_->isFree()); }
    /// Returns whether the view is turned, moved or zoomed.
    bool isCameraDragged() const { return isCameraDragged_; }
    /// Returns whether it moves, turns or scales the selection.
    bool hasGrip() const { return grip_.has_value(); }
    /// Returns whether something is under way that Escape ends.
    bool isBusy() const { return grip_ || isBoxArmed_ || band_.isThere(); }
    /// Ends the motion or box under way without effect.
    void cancel();

    /// Returns the overlay of the picture.
    PictureOverlay overlay() const;

private:
    void move(const PointerMoved& moved, const Modifiers& modifiers);
    void begin(const ButtonDown& down, const Modifiers& modifiers);
    void release(const Modifiers& modifiers);
    void zoom(const WheelTurned& wheel);
    void select(const std::vector<openvdb::Index32>& ids, PickAction action);
    std::optional<GizmoFrame> gizmoFrame() const;
    std::optional<Grip> gripOf(Tool tool, const Handle& handle, bool isFree) const;
    void follow();
    void finish();
    Pixel inPicture() const;
    /// Returns whether the pointer has not moved since the button went down, except for a shaking hand.
    bool isStill() const;

    Host host_;
    MouseMap mouse_ = mouseMap(KeyMap::blender);
    Pixel at_{}, home_{}, pressed_{}; ///< in the window
    std::optional<ButtonDown> held_;
    Modifiers heldWith_;
    std::optional<CameraDrag> cameraDrag_; ///< of the held button; none: it does not move the camera
    bool isCameraDragged_ = false, isBoxArmed_ = false;
    Band band_;
    std::string refusal_; ///< the reason why the grip holds nothing; empty: none
    std::optional<Grip> grip_;
    std::optional<Handle> hot_;
};

} // namespace vdbcage::view
