#pragma once

#include <cmath>

#include <tools/view/state/cage_changes.h>
#include <tools/view/state/commands/line.h>
#include <tools/view/state/commands/situation.h>

/// Commands that move the selection or change its faces.
namespace vdbcage::view {

struct MoveSelected {
    openvdb::Vec3d by{0};

    static LineInfo info() { return {"move", "X Y Z", 3, 3, "moves what is selected, in world units"}; }
    static MoveSelected read(const Arguments& arguments) { return {arguments.vector(0)}; }
    std::string text() const { return written(by); }
    void apply(Document& document, const Situation& now) const
    {
        document = withMotion(now.state, now.cage, edit::Move{by});
    }
};

struct RotateSelected {
    openvdb::Vec3d axis{0, 0, 1}; ///< not zero
    double degrees = 0;
    openvdb::Vec3d pivot{0};

    static LineInfo info()
    {
        return {"rotate", "X Y Z DEGREES PX PY PZ", 7, 7, "turns what is selected around X Y Z through PX PY PZ"};
    }
    static RotateSelected read(const Arguments& arguments)
    {
        const RotateSelected line{arguments.vector(0), arguments.number(3), arguments.vector(4)};
        if (line.axis == openvdb::Vec3d(0)) arguments.fail("the axis 0 0 0 is not allowed");
        return line;
    }
    std::string text() const { return written(axis, degrees, pivot); }
    void apply(Document& document, const Situation& now) const
    {
        document = withMotion(now.state, now.cage, edit::Rotate{axis.unit(), degrees, pivot});
    }
};

/// A scaling from a point, along the axes of the world, or along two others and their normal.
struct ScaleSelected {
    openvdb::Vec3d factors{1};
    openvdb::Vec3d pivot{0};
    std::array<openvdb::Vec3d, 2> axes{openvdb::Vec3d(1, 0, 0), openvdb::Vec3d(0, 1, 0)}; ///< orthogonal, not zero

    static LineInfo info()
    {
        return {"scale", "FX FY FZ PX PY PZ [X Y Z X Y Z]", 6, 12,
                "scales what is selected from PX PY PZ, along the world's axes or along two others and their normal"};
    }
    static ScaleSelected read(const Arguments& arguments)
    {
        if (arguments.count() != 6 && arguments.count() != 12) {
            arguments.fail("it takes three factors, a point, and no axes or two");
        }
        ScaleSelected line{arguments.vector(0), arguments.vector(3)};
        if (arguments.count() == 6) return line;
        line.axes = {arguments.vector(6), arguments.vector(9)};
        const double first = line.axes[0].length(), second = line.axes[1].length();
        if (!(first > 0 && second > 0 && std::abs(line.axes[0].dot(line.axes[1])) <= 1e-6 * first * second)) {
            arguments.fail("the two axes must be at right angles, and not 0 0 0");
        }
        return line;
    }
    std::string text() const
    {
        const std::string text = written(factors, pivot);
        return axes == ScaleSelected().axes ? text : text + written(axes[0], axes[1]);
    }
    void apply(Document& document, const Situation& now) const
    {
        const openvdb::Vec3d x = axes[0].unit(), y = (axes[1] - x * x.dot(axes[1])).unit();
        document = withMotion(now.state, now.cage, edit::Scale{factors, {x, y, x.cross(y)}, pivot});
    }
};

/// A change of faces of the cage at rest.
struct EditCage {
    CageEdit edit{};

    static LineInfo info()
    {
        return {"edit-cage", "split|collapse|flip|merge|cut", 1, 1,
                "changes selected edges (merge: of two triangles) or cuts selected quads, in mode shape"};
    }
    static EditCage read(const Arguments& arguments) { return {arguments.choice<CageEdit>(0, cageEditNames)}; }
    std::string text() const { return written(nameIn(cageEditNames, edit)); }
    void apply(Document& document, const Situation& now) const { document = withEdit(now.state, now.cage, edit); }
};

/// A command that undoes the pose of the view's frame.
struct ResetPose {
    bool onlySelected = false;

    static LineInfo info()
    {
        return {"reset-pose", "all|selected", 1, 1, "moves all or what is selected back to where it is at rest"};
    }
    static ResetPose read(const Arguments& arguments) { return {arguments.choice<int>(0, allOrSelected) == 1}; }
    std::string text() const { return written(nameIn(allOrSelected, onlySelected)); }
    void apply(Document& document, const Situation& now) const
    {
        document = withResetPose(now.state, now.cage, onlySelected);
    }

private:
    static constexpr std::array<const char*, 2> allOrSelected{"all", "selected"};
};

} // namespace vdbcage::view
