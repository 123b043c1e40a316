#pragma once

#include <string>

#include <tools/view/input/input.h>
#include <tools/view/picture/gizmo.h>
#include <tools/view/state/command.h>

namespace vdbcage::view {

/// A motion of the selection under way: moving, turning or scaling by the pointer, or by typed numbers.
class Grip {
public:
    /// The values at its beginning.
    struct Start {
        Tool tool = Tool::move; ///< not select
        Handle handle;
        bool isFree = false; ///< begun by a key: no button is held
        Pixel at{};
        GizmoFrame frame;
        openvdb::Vec3d pivot{0}; ///< world space
        double unit = 1;         ///< world units per drawing unit
        double gridStep = 1;     ///< world units; moves snap to a tenth
    };
    explicit Grip(Start start) : start_(std::move(start)), at_(start_.at) {}

    bool isFree() const { return start_.isFree; }

    void moveTo(const Pixel& at, bool isSnapping);
    /// Takes a key that chooses an axis, or a part of a number.
    void press(const KeyDown& down, const Modifiers& modifiers);

    /// Returns the command for its present amount.
    Command command() const;
    /// Returns the same in words, such as "Move along X, world: 0.5  0  0".
    std::string describe(Orientation orientation) const;

private:
    double snappingStep() const;
    /// Returns the amount, of a move in world units, else in degrees or factors, as typed or by the pointer.
    Amount amount() const;

    Start start_;
    Pixel at_;
    bool isSnapping_ = false;
    std::string typed_; ///< numbers that replace the pointer's amount
};

} // namespace vdbcage::view
