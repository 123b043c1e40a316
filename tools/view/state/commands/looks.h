#pragma once

#include <vector>

#include <tools/view/state/commands/view_field.h>
#include <vdbcage/core/error.h>

/// Commands for the look of the picture and its camera.
namespace vdbcage::view {

struct SetCamera {
    draw::Camera camera;

    static LineInfo info()
    {
        return {"camera", "perspective|orthographic y|z AZIMUTH ELEVATION X Y Z DISTANCE", 8, 8,
                "looks at X Y Z from DISTANCE; the model fills a ball of radius 1 around 0 0 0"};
    }
    static SetCamera read(const Arguments& arguments)
    {
        draw::Camera camera;
        camera.projection = arguments.choice<draw::Projection>(0, projectionNames);
        if (arguments[1] == "z") {
            camera.view.up = draw::UpAxis::z;
        } else if (arguments[1] != "y") {
            arguments.fail("'" + arguments[1] + "' is not allowed; up must be y or z");
        }
        camera.view.azimuthDegrees = numberOf(arguments[2], "azimuth");
        camera.view.elevationDegrees = numberOf(arguments[3], "elevation");
        draw::requireView(camera.view);
        for (int i = 0; i < 3; ++i) camera.target[i] = numberOf(arguments[4 + static_cast<std::size_t>(i)], "target");
        camera.distance = numberOf(arguments[7], "distance");
        requireWithin({draw::leastDistance, draw::mostDistance}, camera.distance, "distance");
        return {camera};
    }
    static SetCamera of(const ViewState& view) { return {view.camera}; }
    std::string text() const
    {
        return written(nameIn(projectionNames, camera.projection), camera.view.up == draw::UpAxis::y ? "y" : "z",
                       camera.view.azimuthDegrees, camera.view.elevationDegrees, camera.target, camera.distance);
    }
    void apply(ViewState& view) const { view.camera = camera; }
};

/// Returns a command for each layer.
template <class Line>
std::vector<Line> ofLayers(const ViewState& view)
{
    std::vector<Line> lines;
    for (std::size_t i = 0; i < layerCount; ++i) {
        lines.push_back(Line::ofLook(static_cast<LayerId>(i), view.layers[i]));
    }
    return lines;
}

struct ShowLayer {
    LayerId layer{};
    bool shown = true;

    static LineInfo info() { return {"layer", "NAME on|off", 2, 2, "shows or hides a layer"}; }
    static ShowLayer read(const Arguments& arguments) { return {layerNamed(arguments[0]), arguments.isOn(1)}; }
    static ShowLayer ofLook(LayerId layer, const LayerLook& look) { return {layer, look.shown}; }
    static std::vector<ShowLayer> of(const ViewState& view) { return ofLayers<ShowLayer>(view); }
    std::string text() const { return written(nameOf(layer), shown); }
    void apply(ViewState& view) const { view.layer(layer).shown = shown; }
};

struct FadeLayer {
    LayerId layer{};
    double opacity = 1; ///< 0 to 1

    static LineInfo info() { return {"opacity", "NAME VALUE", 2, 2, "fades a layer's faces: 0 is clear, 1 is solid"}; }
    static FadeLayer read(const Arguments& arguments)
    {
        return {layerNamed(arguments[0]), arguments.number(1, {0, 1})};
    }
    static FadeLayer ofLook(LayerId layer, const LayerLook& look) { return {layer, look.opacity}; }
    static std::vector<FadeLayer> of(const ViewState& view) { return ofLayers<FadeLayer>(view); }
    std::string text() const { return written(nameOf(layer), opacity); }
    void apply(ViewState& view) const { view.layer(layer).opacity = opacity; }
};

struct ColourLayer {
    LayerId layer{};
    draw::Colour colour{}; ///< each 0 to 1

    static LineInfo info()
    {
        return {"colour", "NAME RED GREEN BLUE", 4, 4, "colours a layer, each of the three 0 to 1"};
    }
    static ColourLayer read(const Arguments& arguments)
    {
        const auto channel = [&](std::size_t i) { return static_cast<float>(arguments.number(i, {0, 1})); };
        return {layerNamed(arguments[0]), {channel(1), channel(2), channel(3)}};
    }
    static ColourLayer ofLook(LayerId layer, const LayerLook& look) { return {layer, look.colour}; }
    static std::vector<ColourLayer> of(const ViewState& view) { return ofLayers<ColourLayer>(view); }
    std::string text() const
    {
        // Doubles are exact, and are read as the same floats.
        return written(nameOf(layer), double{colour[0]}, double{colour[1]}, double{colour[2]});
    }
    void apply(ViewState& view) const { view.layer(layer).colour = colour; }
};

struct SetCageColours : ViewChoice<CageColours, &ViewState::cageColours, cageColourNames> {
    using ViewChoice::ViewChoice;
    static LineInfo info()
    {
        return {"cage-colours", "plain|kinds|distance", 1, 1,
                "colours the cage's faces: quads apart, or distance to the model"};
    }
};

struct SetModelColours : ViewChoice<ModelColours, &ViewState::modelColours, modelColourNames> {
    using ViewChoice::ViewChoice;
    static LineInfo info()
    {
        return {
            "model-colours", "plain|influence|stretch|inverted", 1, 1,
            "colours the posed model: how far it follows what is selected, how lengths changed, or what is inside out"};
    }
};

struct SetSection {
    std::optional<SectionPlane> section;

    static LineInfo info()
    {
        return {"section", "off|X Y Z OFFSET", 1, 4, "cuts off what has (X Y Z) . point > OFFSET"};
    }
    static SetSection read(const Arguments& arguments)
    {
        if (arguments.count() == 1 && arguments[0] == "off") return {};
        if (arguments.count() != 4) arguments.fail("it must be off, or a normal X Y Z and an OFFSET");
        const SectionPlane plane{arguments.vector(0), arguments.number(3)};
        if (plane.normal == openvdb::Vec3d(0)) arguments.fail("the normal 0 0 0 is not allowed");
        return {plane};
    }
    static SetSection of(const ViewState& view) { return {view.section}; }
    std::string text() const { return section ? written(section->normal, section->offset) : written(false); }
    void apply(ViewState& view) const { view.section = section; }
};

struct ShowGround : ViewSwitch<&ViewState::ground> {
    using ViewSwitch::ViewSwitch;
    static LineInfo info() { return {"ground", "on|off", 1, 1, "shows a grid below the model"}; }
};

struct ShowAxes : ViewSwitch<&ViewState::axes> {
    using ViewSwitch::ViewSwitch;
    static LineInfo info() { return {"axes", "on|off", 1, 1, "shows axes in a corner"}; }
};

struct SetTurntable : ViewSwitch<&ViewState::turntable> {
    using ViewSwitch::ViewSwitch;
    static LineInfo info() { return {"turntable", "on|off", 1, 1, "turns the view by itself"}; }
};

struct ShowTimes : ViewSwitch<&ViewState::times> {
    using ViewSwitch::ViewSwitch;
    static LineInfo info() { return {"times", "on|off", 1, 1, "shows how long making a cage took"}; }
};

} // namespace vdbcage::view
