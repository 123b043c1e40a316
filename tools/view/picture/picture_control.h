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

/// What the pointer does in the picture, and the keys while it moves something: it turns the view (see CameraDrag),
/// selects parts of the cage (see Band), and moves what is selected (see Grip), by handles or freely. What it does is
/// commands; it changes nothing else.
class PictureControl {
public:
    /// All of it must outlive the control.
    struct Host {
        Session& session;
        Viewport& viewport;
        std::function<void(const Command&)> attempt; ///< does it as a user would
        std::function<void()> endDrag;               ///< ends the session's drag and records what it amounts to
        std::function<Rectangle()> place;            ///< of the picture in the window
        double pixel = 1;                            ///< pixels that a length of 1 has on an ordinary screen
    };
    explicit PictureControl(Host host) : host_(std::move(host)) {}

    /// What its buttons do from now on; what is under way goes on as it began.
    void setMouse(const MouseMap& map) { mouse_ = map; }

    /// A pointer event that no panel took, or any while isHeld().
    void handle(const InputEvent& event);
    /// A key that it wants for what it is doing. Returns whether it took it.
    bool press(const KeyDown& down, const Modifiers& modifiers);

    /// Moves, turns or scales what is selected with the pointer until a click, Enter or Escape. \pre tool is not select
    /// \throw InputError nothing is selected, or there is no cage
    void grab(Tool tool);
    /// The next drag selects what is in a box.
    void startBox();

    /// Where the pointer is, pixels of the window.
    Pixel pointer() const { return at_; }
    /// The same where what is under way began.
    Pixel home() const { return home_; }
    /// It has the pointer, wherever that goes.
    bool isHeld() const { return held_.has_value() || (grip_ && grip_->isFree()); }
    /// The view is turned, moved or zoomed.
    bool isCameraDragged() const { return isCameraDragged_; }
    /// Something is being moved.
    bool isMoving() const { return grip_.has_value(); }
    /// Something is under way that Escape ends.
    bool isBusy() const { return grip_ || isBoxArmed_ || band_.isThere(); }
    /// Ends what is under way as if it had not been.
    void cancel();

    /// What is to be seen over the picture.
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
    /// The pointer has not moved since the button went down, but for a hand that shakes.
    bool isStill() const;

    Host host_;
    MouseMap mouse_ = mouseMap(KeyMap::blender);
    Pixel at_{}, home_{}, pressed_{}; ///< of the window
    std::optional<ButtonDown> held_;
    Modifiers heldWith_;
    std::optional<CameraDrag> cameraDrag_; ///< what a drag of the held button does; none: nothing to the camera
    bool isCameraDragged_ = false, isBoxArmed_ = false;
    Band band_;
    std::optional<Grip> grip_;
    std::optional<Handle> hot_;
};

} // namespace vdbcage::view
