#include <tools/view/picture/layer_shapes.h>

#include <algorithm>

#include <tools/view/picture/distance_colours.h>

namespace vdbcage::view {

namespace {

using openvdb::Vec3d;

constexpr draw::Colour gridColour{0.62F, 0.64F, 0.67F};
constexpr draw::Colour quadColour{0.80F, 0.42F, 0.08F};

draw::Colour mixed(const draw::Colour& a, const draw::Colour& b, float share)
{
    draw::Colour colour{};
    for (std::size_t k = 0; k < 3; ++k) colour[k] = a[k] + share * (b[k] - a[k]);
    return colour;
}

openvdb::BBoxd boxOf(const OpenedMeshPtr& model)
{
    return model ? boundingBox(model->mesh) : openvdb::BBoxd(Vec3d(-1), Vec3d(1));
}

draw::Edges edgesOf(LayerId id, const LayerLook& look)
{
    draw::Edges edges;
    edges.colour = look.colour;
    switch (id) {
    case LayerId::solid:
    case LayerId::closed:
        edges.colour = mixed(look.colour, {0, 0, 0}, 0.72F);
        edges.opacity = 0.35F;
        edges.hiddenOpacity = 0;
        edges.relativeWidth = 0.7;
        edges.relativeFadeLength = 6;
        break;
    case LayerId::surface:
    case LayerId::smoothed:
    case LayerId::decimated:
        edges.colour = mixed(look.colour, {0, 0, 0}, 0.45F);
        edges.opacity = 0.6F;
        edges.hiddenOpacity = 0;
        edges.relativeWidth = 0.7;
        edges.relativeFadeLength = 6;
        break;
    case LayerId::solidNodes:
    case LayerId::closedNodes:
        edges.hiddenOpacity = 0.3F;
        edges.relativeWidth = 0.8;
        break;
    case LayerId::model:
    case LayerId::cage:
        break;
    }
    return edges;
}

/// Returns the mesh that a layer shows of a cage; null: none.
const Mesh* meshOf(LayerId id, const CageResultPtr& cage)
{
    if (!cage) return nullptr;
    if (id == LayerId::cage) return &cage->cage;
    const Intermediates* const inner = cage->intermediates.get();
    if (!inner) return nullptr;
    switch (id) {
    case LayerId::solid:
        return &inner->solidFaces;
    case LayerId::solidNodes:
        return &inner->solidNodes;
    case LayerId::closed:
        return &inner->closedFaces;
    case LayerId::closedNodes:
        return &inner->closedNodes;
    case LayerId::surface:
        return &inner->surface;
    case LayerId::smoothed:
        return &inner->smoothed;
    case LayerId::decimated:
        return &inner->decimated;
    case LayerId::model:
    case LayerId::cage:
        break;
    }
    return nullptr;
}

} // namespace

LayerShapes::LayerShapes(const gl::Api& api, bool isSoftware)
    : api_(&api), box_(boxOf(nullptr)), frame_(box_), model_(api, isSoftware)
{
}

LayerShapes::Change LayerShapes::show(const PictureContent& content, const ViewState& view)
{
    const CageResultPtr& cage = content.cage;
    const bool isOtherModel = model_.source() != content.model;
    Change change;
    change.model = isOtherModel;
    change.any = isOtherModel || slot(LayerId::cage).source != cage || content.isStale != isStale_ || view != view_;
    if (isOtherModel) setModel(content.model);
    const bool areOtherMarks = slot(LayerId::cage).source != cage || view.selection != view_.selection;
    change.any |= model_.show(content.model, frame_);
    for (std::size_t i = 0; i < layerCount; ++i) change.any |= fillLayer(static_cast<LayerId>(i), cage, view);
    change.any |= poseCage(content.cagePoints);
    change.model |= model_.pose(content.model, content.posed, frame_);
    change.any |= change.model;
    change.any |= model_.colour(content.model, content.modelValues);
    if (cage && areOtherMarks) markFaces(*cage, view.selection);
    change.any |= fillDistances(cage, view.cageColours == CageColours::distance && view.layer(LayerId::cage).shown);
    if (isOtherModel || !ground_.shape() || view.camera.view.up != view_.camera.view.up) {
        ground_.fill(*api_, frame_, box_, view.camera.view.up);
        change.any = true;
    }
    view_ = view;
    isStale_ = content.isStale;
    cage_ = cage;
    return change;
}

void LayerShapes::setModel(const OpenedMeshPtr& model)
{
    box_ = boxOf(model);
    frame_ = draw::Frame(box_);
    model_.clear();
    for (ShapeSlot& slot : slots_) slot = ShapeSlot();
    distances_ = ShapeSlot();
    cagePoints_.clear();
}

bool LayerShapes::fillLayer(LayerId id, const CageResultPtr& cage, const ViewState& view)
{
    if (id == LayerId::model) return false;
    // Layers that are hidden are not made.
    const Mesh* mesh = id == LayerId::cage || view.layer(id).shown ? meshOf(id, cage) : nullptr;
    if (mesh && mesh->points.empty()) mesh = nullptr;
    const std::shared_ptr<const void> source = mesh ? std::shared_ptr<const void>(cage) : nullptr;
    if (slot(id).source == source) return false;
    slot(id).fill(*api_, frame_, source, mesh, 0);
    if (id == LayerId::cage) cagePoints_ = mesh ? mesh->points : std::vector<Vec3d>();
    return true;
}

bool LayerShapes::poseCage(const std::vector<Vec3d>& points)
{
    std::optional<draw::Shape>& shape = slot(LayerId::cage).shape;
    if (!shape || points.size() != cagePoints_.size() || points == cagePoints_) return false;
    shape->setPoints(points);
    cagePoints_ = points;
    // Distances are those of the cage at rest.
    distances_ = ShapeSlot();
    return true;
}

bool LayerShapes::fillDistances(const CageResultPtr& cage, bool isWanted)
{
    const bool isThere = isWanted && cage && cage->intermediates;
    const std::shared_ptr<const void> source = isThere ? std::shared_ptr<const void>(cage) : nullptr;
    if (distances_.source == source) return false;
    largestDistance_ = 0;
    distances_.fill(*api_, frame_, source, isThere ? &cage->intermediates->distance.mesh : nullptr, 0);
    if (!distances_.shape) return true;
    const std::vector<float>& distances = cage->intermediates->distance.distances;
    largestDistance_ = double{*std::max_element(distances.begin(), distances.end())};
    std::vector<draw::Colour> colours;
    for (const float distance : distances) {
        colours.push_back(distanceColour(largestDistance_ > 0 ? double{distance} / largestDistance_ : 0));
    }
    distances_.shape->setPointColours(colours);
    return true;
}

void LayerShapes::markFaces(const CageResult& cage, const edit::Selection& selection)
{
    std::optional<draw::Shape>& shape = slot(LayerId::cage).shape;
    if (!shape) return;
    std::vector<draw::FaceLook> looks;
    const bool areSelected = selection.kind == edit::Element::face && !selection.ids.empty();
    if (!cage.report.check.badFaces.empty() || areSelected) looks.resize(faceCount(cage.cage));
    for (const std::uint32_t face : cage.report.check.badFaces) looks[face].flags |= draw::FaceLook::marked;
    for (const openvdb::Index32 face : selection.ids) {
        if (areSelected && face < looks.size()) looks[face].flags |= draw::FaceLook::selected;
    }
    shape->setFaceLooks(looks);
}

std::vector<draw::Layer> LayerShapes::layers(bool isMoving) const
{
    std::vector<draw::Layer> list;
    if (view_.ground && ground_.shape() && model_.source()) {
        draw::Layer layer;
        layer.shape = &*ground_.shape();
        layer.shaded = false;
        layer.opacity = 0;
        layer.edges = draw::Edges{gridColour, 0.55F, 0, 0.6, 0};
        list.push_back(layer);
    }
    for (std::size_t i = 0; i < layerCount; ++i) {
        const auto id = static_cast<LayerId>(i);
        const LayerLook& look = view_.layers[i];
        if (!look.shown || !shape(id)) continue;
        draw::Layer layer;
        layer.shape = &*shape(id);
        layer.colour = look.colour;
        layer.opacity = static_cast<float>(look.opacity);
        if (id == LayerId::model) {
            layer.shape = &*model_.drawn(isMoving);
            if (model_.isDrawnInValues()) layer.colour = {1, 1, 1};
        } else {
            layer.edges = edgesOf(id, look);
        }
        if (id == LayerId::cage) addCage(layer, list);
        if (id != LayerId::cage) list.push_back(layer);
    }
    return list;
}

void LayerShapes::addCage(draw::Layer layer, std::vector<draw::Layer>& list) const
{
    if (distances_.shape) {
        draw::Layer coloured;
        coloured.shape = &*distances_.shape;
        coloured.colour = {1, 1, 1};
        coloured.opacity = std::max(0.8F, layer.opacity);
        list.push_back(coloured);
        layer.opacity = 0;
    } else if (view_.cageColours == CageColours::kinds) {
        layer.quadColour = quadColour;
    }
    layer.shaded = layer.opacity >= 1;
    if (isStale_) {
        layer.colour = mixed(layer.colour, {0.6F, 0.6F, 0.6F}, 0.75F);
        if (layer.quadColour) layer.quadColour = mixed(*layer.quadColour, {0.6F, 0.6F, 0.6F}, 0.75F);
        layer.edges->colour = mixed(layer.edges->colour, {0.6F, 0.6F, 0.6F}, 0.6F);
    }
    list.push_back(layer);
}

draw::PointSets LayerShapes::points(const ViewState& view, bool withGround) const
{
    draw::PointSets points;
    for (std::size_t i = 0; i < layerCount; ++i) {
        const auto& seen = shape(static_cast<LayerId>(i));
        if (view.layers[i].shown && seen) points.push_back(&seen->geometry().positions());
    }
    if (withGround && view.ground && ground_.shape()) points.push_back(&ground_.shape()->geometry().positions());
    return points;
}

std::optional<draw::Hit> LayerShapes::nearestHit(const draw::Ray& ray) const
{
    std::optional<draw::Hit> nearest;
    for (std::size_t i = 0; i < layerCount; ++i) {
        const auto& seen = shape(static_cast<LayerId>(i));
        if (!view_.layers[i].shown || !seen) continue;
        const auto hit = draw::nearestHit(ray, seen->geometry(), section());
        if (hit && (!nearest || hit->distance < nearest->distance)) nearest = hit;
    }
    return nearest;
}

std::optional<draw::Section> LayerShapes::section() const
{
    if (!view_.section) return std::nullopt;
    const SectionPlane& plane = *view_.section;
    const Vec3d normal = plane.normal.unit();
    const Vec3d point = frame_.toDrawing(normal * (plane.offset / plane.normal.length()));
    // The renderer cuts off the other side.
    return draw::Section{-normal, -normal.dot(point)};
}

std::size_t LayerShapes::edgeCount(LayerId layer) const
{
    const auto& seen = shape(layer);
    return seen ? seen->geometry().edges().size() : 0;
}

const std::optional<draw::Shape>& LayerShapes::shape(LayerId id) const
{
    return id == LayerId::model ? model_.shape() : slots_[static_cast<std::size_t>(id)].shape;
}

} // namespace vdbcage::view
