#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include <tools/view/input/input.h>
#include <tools/view/input/key_map.h>
#include <tools/view/picture/gizmo.h>
#include <tools/view/picture/rectangle.h>
#include <tools/view/picture/viewport.h>

namespace vdbcage::view {

/// What the pointer does in the picture, and the keys while it moves something: it turns the view, selects parts of the
/// cage, and moves what is selected, by handles or freely. What it does is lines and commands; it changes nothing else.
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
    std::array<double, 2> pointer() const { return {x_, y_}; }
    /// The same where what is under way began.
    std::array<double, 2> home() const { return {homeX_, homeY_}; }
    /// It has the pointer, wherever that goes.
    bool isHeld() const { return held_.has_value() || (grip_ && grip_->isFree); }
    /// The view is turned, moved or zoomed.
    bool isCameraDragged() const { return isCameraDragged_; }
    /// Something is being moved.
    bool isMoving() const { return grip_.has_value(); }
    /// Something is under way that Escape ends.
    bool isBusy() const { return grip_ || isBoxArmed_ || !band_.empty(); }
    /// Ends what is under way as if it had not been.
    void cancel();

    /// What is to be seen over the picture.
    PictureOverlay overlay() const;

private:
    /// Something that is moved.
    struct Grip {
        Tool tool = Tool::move;
        Handle handle;
        bool isFree = false; ///< begun by a key: no button is held
        Pixel from{};
        GizmoFrame frame;
        openvdb::Vec3d pivot{0}; ///< world space
        double unit = 1;         ///< world units of a drawing unit
        std::string typed;       ///< numbers, by which the amount is set instead of by the pointer
        bool isSnapping = false;
    };

    void move(const PointerMoved& moved, const Modifiers& modifiers);
    void begin(const ButtonDown& down, const Modifiers& modifiers);
    void release(const Modifiers& modifiers);
    void dragCamera(double dx, double dy);
    void select(const std::vector<openvdb::Index32>& ids, PickAction action);
    std::optional<Grip> gripOf(Tool tool, const Handle& handle, bool isFree) const;
    std::optional<GizmoFrame> gizmoFrame() const;
    double snappingStep() const;
    Amount amount() const;
    void follow();
    void finish();

    Pixel inPicture() const;
    /// [-1, 1] both ways, y up.
    std::array<double, 2> inPanel(const Pixel& at) const;
    double aspect() const;
    void setCamera(const draw::Camera& camera) { host_.attempt(SetCamera{camera}); }

    Host host_;
    MouseMap mouse_ = mouseMap(KeyMap::blender);
    double x_ = 0, y_ = 0, homeX_ = 0, homeY_ = 0, pressedX_ = 0, pressedY_ = 0; ///< of the window
    std::optional<ButtonDown> held_;
    Modifiers heldWith_;
    std::optional<DragAction> drag_; ///< what a drag of the held button does; none: nothing
    bool isCameraDragged_ = false, isBoxArmed_ = false;
    std::vector<Pixel> band_; ///< a box's two corners, or a lasso; empty: none
    openvdb::Vec3d pivot_{0}; ///< of the camera
    std::optional<Grip> grip_;
    std::optional<Handle> hot_;
};

} // namespace vdbcage::view
