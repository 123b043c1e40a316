#include <tools/view/state/state.h>

#include <algorithm>

namespace vdbcage::view {

namespace {

bool areEqual(const draw::Camera& a, const draw::Camera& b)
{
    return a.view.azimuthDegrees == b.view.azimuthDegrees && a.view.elevationDegrees == b.view.elevationDegrees &&
           a.view.up == b.view.up && a.projection == b.projection && a.target == b.target && a.distance == b.distance;
}

bool areEqual(const LayerLook& a, const LayerLook& b)
{
    return a.shown == b.shown && a.opacity == b.opacity && a.colour == b.colour;
}

bool areEqual(const std::optional<SectionPlane>& a, const std::optional<SectionPlane>& b)
{
    if (!a || !b) return !a && !b;
    return a->normal == b->normal && a->offset == b->offset;
}

} // namespace

const char* nameOf(LayerId layer)
{
    constexpr std::array<const char*, layerCount> names{"model",   "solid",    "solid-nodes", "closed", "closed-nodes",
                                                        "surface", "smoothed", "decimated",   "cage"};
    return names[static_cast<std::size_t>(layer)];
}

std::array<LayerLook, layerCount> ViewState::defaultLayers()
{
    std::array<LayerLook, layerCount> looks;
    const auto set = [&](LayerId layer, bool shown, double opacity, const draw::Colour& colour) {
        looks[static_cast<std::size_t>(layer)] = {shown, opacity, colour};
    };
    set(LayerId::model, true, 1, {0.88F, 0.855F, 0.815F});
    set(LayerId::solid, false, 1, {0.96F, 0.80F, 0.56F});
    set(LayerId::solidNodes, false, 0, {0.80F, 0.52F, 0.18F});
    set(LayerId::closed, false, 1, {0.66F, 0.80F, 0.70F});
    set(LayerId::closedNodes, false, 0, {0.22F, 0.55F, 0.36F});
    set(LayerId::surface, false, 0.35, {0.45F, 0.62F, 0.80F});
    set(LayerId::smoothed, false, 0.35, {0.58F, 0.52F, 0.80F});
    set(LayerId::decimated, false, 0.2, {0.30F, 0.62F, 0.62F});
    set(LayerId::cage, true, 0.12, {0.10F, 0.22F, 0.48F});
    return looks;
}

bool areEqual(const CageOptions& a, const CageOptions& b)
{
    // What was read anew from a changed file has the same text.
    return a.scale.grid == b.scale.grid && a.density.grid == b.density.grid && a.joints == b.joints &&
           optionValues(a) == optionValues(b);
}

bool operator==(const Document& a, const Document& b)
{
    return a.model == b.model && a.cage == b.cage && areEqual(a.options, b.options) && a.poses == b.poses &&
           a.coordinates == b.coordinates && a.weights == b.weights && a.elasticity == b.elasticity;
}

bool operator==(const ViewState& a, const ViewState& b)
{
    return areEqual(a.camera, b.camera) &&
           std::equal(a.layers.begin(), a.layers.end(), b.layers.begin(),
                      [](const LayerLook& x, const LayerLook& y) { return areEqual(x, y); }) &&
           a.cageColours == b.cageColours && a.modelColours == b.modelColours && areEqual(a.section, b.section) &&
           a.ground == b.ground && a.axes == b.axes && a.turntable == b.turntable && a.times == b.times &&
           a.mode == b.mode && a.tool == b.tool && a.orientation == b.orientation && a.pivot == b.pivot &&
           a.seeThrough == b.seeThrough && a.softRadius == b.softRadius && a.mirror == b.mirror &&
           a.selection == b.selection && a.compared == b.compared && a.frame == b.frame && a.isPlaying == b.isPlaying &&
           a.framesPerSecond == b.framesPerSecond;
}

} // namespace vdbcage::view
