#pragma once

#include <string>

#include <tools/view/input/input.h>
#include <tools/view/picture/gizmo.h>
#include <tools/view/state/command.h>

namespace vdbcage::view {

/// What is selected, while it is moved, turned or scaled: by the pointer, or by numbers that are typed.
class Grip {
public:
    /// How it begins.
    struct Start {
        Tool tool = Tool::move; ///< not select
        Handle handle;
        bool isFree = false; ///< begun by a key: no button is held
        Pixel at{};
        GizmoFrame frame;
        openvdb::Vec3d pivot{0}; ///< world space
        double unit = 1;         ///< world units of a drawing unit
        double gridStep = 1;     ///< world units; moves snap to a tenth
    };
    explicit Grip(Start start) : start_(std::move(start)), at_(start_.at) {}

    bool isFree() const { return start_.isFree; }

    void moveTo(const Pixel& at, bool isSnapping);
    /// A key that says along which axis, or a part of a number.
    void press(const KeyDown& down, const Modifiers& modifiers);

    /// What it amounts to now.
    Command command() const;
    /// The same in words, such as "Move along X, world: 0.5  0  0".
    std::string describe(Orientation orientation) const;

private:
    double snappingStep() const;
    /// In world units.
    Amount amount() const;

    Start start_;
    Pixel at_;
    bool isSnapping_ = false;
    std::string typed_; ///< numbers, by which the amount is set instead of by the pointer
};

} // namespace vdbcage::view
