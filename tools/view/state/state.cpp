#include <tools/view/state/state.h>

#include <vdbcage/core/error.h>

namespace vdbcage::view {

const char* nameOf(LayerId layer)
{
    constexpr std::array<const char*, layerCount> names{"model",   "solid",    "solid-nodes", "closed", "closed-nodes",
                                                        "surface", "smoothed", "decimated",   "cage"};
    return names[static_cast<std::size_t>(layer)];
}

LayerId layerNamed(const std::string& name)
{
    std::string known;
    for (std::size_t i = 0; i < layerCount; ++i) {
        const auto layer = static_cast<LayerId>(i);
        if (name == nameOf(layer)) return layer;
        known += (i > 0 ? ", " : "") + std::string(nameOf(layer));
    }
    throw InputError("layer", "'" + name + "' is not allowed; it must be one of " + known);
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
    // Grids that were read again from a changed file have the same text.
    return a.scale.grid == b.scale.grid && a.density.grid == b.density.grid && a.joints == b.joints &&
           optionValues(a) == optionValues(b);
}

bool operator==(const Document& a, const Document& b)
{
    return a.model == b.model && a.cage == b.cage && a.locked == b.locked && a.isFitted == b.isFitted &&
           a.tightness == b.tightness && areEqual(a.options, b.options) && a.poses == b.poses &&
           a.coordinates == b.coordinates && a.weights == b.weights && a.elasticity == b.elasticity;
}

} // namespace vdbcage::view
