#pragma once

#include <set>

#include <tools/view/state/commands/view_field.h>

/// Commands for the selection and for moving it by hand.
namespace vdbcage::view {

/// A selection of parts of the cage, or of none. Edges are numbered in the order of their two points.
struct Select {
    edit::Selection selection;

    static LineInfo info()
    {
        return {"select", "points|edges|faces [NUMBER...]", 1, anyNumber,
                "selects parts of the cage by number, or none; faces count triangles first"};
    }
    static Select read(const Arguments& arguments)
    {
        std::set<openvdb::Index32> ids;
        for (std::size_t i = 1; i < arguments.count(); ++i) {
            ids.insert(static_cast<openvdb::Index32>(arguments.whole(i, 0, 2147483647)));
        }
        return {{arguments.choice<edit::Element>(0, edit::elementNames), {ids.begin(), ids.end()}}};
    }
    static Select of(const ViewState& view) { return {view.selection}; }
    std::string text() const
    {
        std::string text = written(nameIn(edit::elementNames, selection.kind));
        for (const openvdb::Index32 id : selection.ids) text += ' ' + std::to_string(id);
        return text;
    }
    void apply(ViewState& view) const { view.selection = selection; }
};

struct SetMode : ViewChoice<Mode, &ViewState::mode, modeNames> {
    using ViewChoice::ViewChoice;
    static LineInfo info()
    {
        return {"mode", "shape|pose", 1, 1, "moves the cage at rest, or the cage and with it the model"};
    }
};

struct SetTool : ViewChoice<Tool, &ViewState::tool, toolNames> {
    using ViewChoice::ViewChoice;
    static LineInfo info() { return {"tool", "select|move|rotate|scale", 1, 1, "what the picture has handles for"}; }
};

struct SetOrientation : ViewChoice<Orientation, &ViewState::orientation, orientationNames> {
    using ViewChoice::ViewChoice;
    static LineInfo info()
    {
        return {"orientation", "world|local|normal|view", 1, 1, "along which axes things are moved"};
    }
};

struct SetPivot {
    Pivot pivot;

    static LineInfo info()
    {
        return {"pivot", "mean|box|origin|X Y Z", 1, 3, "what is turned and scaled by hand turns about it"};
    }
    static SetPivot read(const Arguments& arguments)
    {
        if (arguments.count() == 3) return {{Pivot::Kind::point, arguments.vector(0)}};
        if (arguments.count() != 1) arguments.fail("it must be mean, box or origin, or a point X Y Z");
        return {{arguments.choice<Pivot::Kind>(0, pivotNames), openvdb::Vec3d(0)}};
    }
    static SetPivot of(const ViewState& view) { return {view.pivot}; }
    std::string text() const
    {
        return pivot.kind == Pivot::Kind::point ? written(pivot.point) : written(nameIn(pivotNames, pivot.kind));
    }
    void apply(ViewState& view) const { view.pivot = pivot; }
};

struct SetSeeThrough : ViewSwitch<&ViewState::seeThrough> {
    using ViewSwitch::ViewSwitch;
    static LineInfo info() { return {"see-through", "on|off", 1, 1, "selects hidden elements too"}; }
};

/// The radius of soft selection: points near the selection, along the cage's surface, move too.
struct SetSoft {
    double radius = 0; ///< as a fraction of the model's longest side, 0 to 10

    static LineInfo info()
    {
        return {"soft", "RADIUS", 1, 1,
                "moves what is near, less and less; a part of the model's longest side, 0: off"};
    }
    static SetSoft read(const Arguments& arguments) { return {arguments.number(0, {0, 10})}; }
    static SetSoft of(const ViewState& view) { return {view.softRadius}; }
    std::string text() const { return written(radius); }
    void apply(ViewState& view) const { view.softRadius = radius; }
};

/// The plane of symmetric editing. Points with a partner across it move as the partner's mirror image.
struct SetMirror {
    std::optional<SymmetryPlane> plane;

    static LineInfo info()
    {
        return {"mirror", "off|x|y|z OFFSET", 1, 2, "does the same on the other side of a plane across an axis"};
    }
    static SetMirror read(const Arguments& arguments)
    {
        if (arguments.count() == 1 && arguments[0] == "off") return {};
        if (arguments.count() != 2) arguments.fail("it must be off, or an axis x, y or z and an OFFSET");
        return {SymmetryPlane{arguments.choice<int>(0, axisNames), arguments.number(1)}};
    }
    static SetMirror of(const ViewState& view) { return {view.mirror}; }
    std::string text() const { return plane ? written(nameIn(axisNames, plane->axis), plane->offset) : written(false); }
    void apply(ViewState& view) const { view.mirror = plane; }

private:
    static constexpr std::array<const char*, 3> axisNames{"x", "y", "z"};
};

} // namespace vdbcage::view
