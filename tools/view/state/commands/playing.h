#pragma once

#include <tools/view/state/commands/coordinates.h>
#include <tools/view/state/commands/view_field.h>

/// Commands that choose the shown pose and the compared coordinates.
namespace vdbcage::view {

/// The family of a second picture of the model beside the first, in mode pose.
struct Compare {
    std::optional<Coordinates> family;

    static LineInfo info()
    {
        return {"compare", "off|" + familyWords(), 1, 1,
                "shows the model by another family of coordinates too, side by side"};
    }
    static Compare read(const Arguments& arguments)
    {
        return arguments[0] == "off" ? Compare{} : Compare{coordinatesNamed(arguments[0])};
    }
    static Compare of(const ViewState& view) { return {view.compared}; }
    std::string text() const { return written(family ? coordinatesName(*family) : "off"); }
    void apply(ViewState& view) const { view.compared = family; }
};

struct SetFrame {
    int frame = 0; ///< 0 to lastFrame

    static LineInfo info() { return {"time", "FRAME", 1, 1, "shows, and changes from now on, the pose at a frame"}; }
    static SetFrame read(const Arguments& arguments) { return {arguments.whole(0, 0, lastFrame)}; }
    static SetFrame of(const ViewState& view) { return {view.frame}; }
    std::string text() const { return written(frame); }
    void apply(ViewState& view) const { view.frame = frame; }
};

struct Play : ViewSwitch<&ViewState::isPlaying> {
    using ViewSwitch::ViewSwitch;
    static LineInfo info()
    {
        return {"play", "on|off", 1, 1, "shows the frames of the time line one after the other, again and again"};
    }
};

struct SetRate {
    double framesPerSecond = 24; ///< 1 to 240

    static LineInfo info() { return {"rate", "FRAMES", 1, 1, "so many frames a second, 1 to 240"}; }
    static SetRate read(const Arguments& arguments) { return {arguments.number(0, {1, 240})}; }
    static SetRate of(const ViewState& view) { return {view.framesPerSecond}; }
    std::string text() const { return written(framesPerSecond); }
    void apply(ViewState& view) const { view.framesPerSecond = framesPerSecond; }
};

} // namespace vdbcage::view
