#include <tools/view/picture/viewport.h>

#include <algorithm>
#include <cmath>

#include <tools/draw/diverging_colours.h>
#include <tools/draw/stand_in.h>
#include <tools/view/picture/distance_colours.h>
#include <tools/view/state/move.h>

namespace vdbcage::view {

namespace {

using openvdb::Vec3d;

constexpr draw::Colour background{0.945F, 0.95F, 0.955F};
constexpr draw::Colour gridColour{0.62F, 0.64F, 0.67F};
constexpr draw::Colour quadColour{0.80F, 0.42F, 0.08F};
constexpr double creaseDegrees = 40;
constexpr std::size_t standInTriangles = 12000;
constexpr double lineWidth = 1.2; // pixels

/// Where the i-th of `shifts` frames looks within a pixel, in [-1/2, 1/2]: each row and each column of a grid of 16 by
/// 16 once (Shirley, Discrepancy as a quality measure for sample distributions, 1991: n rooks).
std::array<double, 2> shiftOf(int i)
{
    return {(i + 0.5) / 16 - 0.5, (i * 7 % 16 + 0.5) / 16 - 0.5};
}

/// 1, 2 or 5 times a power of ten, at least `least`.
double roundStep(double least)
{
    const double power = std::pow(10.0, std::floor(std::log10(least)));
    for (const double step : {1.0, 2.0, 5.0}) {
        if (step * power >= least) return step * power;
    }
    return 10 * power;
}

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

const Mesh* meshOf(LayerId id, const OpenedMeshPtr& model, const CageResultPtr& cage)
{
    if (id == LayerId::model) return model ? &model->mesh : nullptr;
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

Viewport::Viewport(const gl::Api& api, bool isSoftware)
    : api_(&api), isSoftware_(isSoftware), renderer_(api), box_(boxOf(nullptr)), frame_(box_)
{
    resize(1, 1);
}

void Viewport::resize(int width, int height)
{
    if (width == width_ && height == height_) return;
    canvas_.reset(); // its memory first
    canvas_.emplace(*api_, width, height, 1);
    averageFramebuffer_ = gl::Framebuffer();
    average_ = gl::makeTexture2D(*api_, GL_RGBA8, width, height);
    averageFramebuffer_ = gl::makeFramebuffer(*api_, average_, gl::Texture());
    width_ = width;
    height_ = height;
    restart();
}

bool Viewport::show(const Shown& shown, const ViewState& view)
{
    const OpenedMeshPtr& model = shown.model;
    const CageResultPtr& cage = shown.cage;
    Slot& modelSlot = slots_[static_cast<std::size_t>(LayerId::model)];
    Slot& cageSlot = slots_[static_cast<std::size_t>(LayerId::cage)];
    const bool isOtherModel = modelSlot.source != model;
    bool changed = isOtherModel || cageSlot.source != cage || shown.isStale != isStale_ || view != view_;
    if (isOtherModel) setFrame(model);
    const bool areOtherMarks = cageSlot.source != cage || view.selection != view_.selection;
    for (std::size_t i = 0; i < layerCount; ++i) {
        const auto id = static_cast<LayerId>(i);
        const bool isOfModel = id == LayerId::model;
        const Mesh* mesh = meshOf(id, model, cage);
        std::shared_ptr<const void> source = isOfModel ? std::shared_ptr<const void>(model) : cage;
        // What was never seen is not made.
        if (!isOfModel && id != LayerId::cage && !view.layers[i].shown) mesh = nullptr;
        if (!mesh || mesh->points.empty()) source.reset();
        if (slots_[i].source == source) continue;
        changed = true;
        fill(slots_[i], source, source ? mesh : nullptr, isOfModel ? creaseDegrees : 0);
        if (id == LayerId::cage) cagePoints_ = mesh ? mesh->points : std::vector<Vec3d>();
    }
    if (isSoftware_ && standIn_.source != model) {
        const bool isLarge = model && triangulate(model->mesh).size() > 2 * standInTriangles;
        movingModel_ = isLarge ? draw::standIn(model->mesh, standInTriangles) : draw::StandIn();
        fill(standIn_, model, &movingModel_.mesh, creaseDegrees);
    }
    changed |= poseCage(cage, shown.cagePoints);
    changed |= poseModel(model, shown.posed);
    changed |= colourModel(model, shown.modelValues);
    if (cage && areOtherMarks) markFaces(*cage, view);
    fillDistances(cage, view.cageColours == CageColours::distance && view.layer(LayerId::cage).shown);
    if (isOtherModel || !ground_.shape || view.camera.view.up != view_.camera.view.up) {
        fillGround(view.camera.view.up);
    }
    view_ = view;
    isStale_ = shown.isStale;
    if (cage_ != cage) elements_.reset();
    cage_ = cage;
    if (changed) restart();
    return changed;
}

bool Viewport::poseCage(const CageResultPtr& cage, const std::vector<Vec3d>& points)
{
    std::optional<draw::Shape>& shape = slots_[static_cast<std::size_t>(LayerId::cage)].shape;
    if (!shape || points.size() != cagePoints_.size() || points == cagePoints_) return false;
    shape->setPoints(points);
    cagePoints_ = points;
    // Distances are those of the cage at rest.
    if (distances_.shape && cage) distances_ = Slot();
    return true;
}

bool Viewport::poseModel(const OpenedMeshPtr& model, const PosedModel* posed)
{
    const std::uint64_t version = posed ? posed->version() : 0;
    if (version == posedVersion_) return false;
    posedVersion_ = version;
    occluder_.reset();
    std::optional<draw::Shape>& shape = slots_[static_cast<std::size_t>(LayerId::model)].shape;
    const BoundModelPtr bound = posed && shape ? posed->bound() : nullptr;
    const bool isAtRest = !bound || bound->order.model != model;
    hasOnlyStandIn_ = !isAtRest && !posed->isWhole();
    if (hasOnlyStandIn_) {
        if (boundStandIn_.source != bound->standIn) {
            fill(boundStandIn_, bound->standIn, &bound->standIn->mesh, creaseDegrees);
        }
        if (boundStandIn_.shape) boundStandIn_.shape->setPoints(posed->points());
        return true;
    }
    boundStandIn_ = Slot();
    if (!shape || (isAtRest && !isPosed_)) return true;
    isPosed_ = !isAtRest;
    const std::vector<Vec3d>& points = isAtRest ? model->mesh.points : posed->points();
    shape->setPoints(points);
    if (standIn_.shape) {
        std::vector<Vec3d> some;
        some.reserve(movingModel_.points.size());
        for (const openvdb::Index32 i : movingModel_.points) some.push_back(points[i]);
        standIn_.shape->setPoints(posedStandIn(movingModel_, model->mesh, some));
    }
    return true;
}

bool Viewport::colourModel(const OpenedMeshPtr& model, const std::shared_ptr<const std::vector<double>>& values)
{
    std::optional<draw::Shape>& shape = slots_[static_cast<std::size_t>(LayerId::model)].shape;
    const bool fits = shape && values && values->size() == model->mesh.points.size();
    const std::shared_ptr<const std::vector<double>> shown = fits ? values : nullptr;
    if (shown == modelValues_) return false;
    modelValues_ = shown;
    const std::vector<draw::Colour> colours = shown ? draw::divergingColours(*shown) : std::vector<draw::Colour>();
    if (shape) shape->setPointColours(colours);
    if (standIn_.shape) {
        std::vector<draw::Colour> some;
        for (const openvdb::Index32 i : movingModel_.points) {
            if (shown) some.push_back(colours[i]);
        }
        standIn_.shape->setPointColours(some);
    }
    return true;
}

void Viewport::restart()
{
    frames_ = 0;
    isDrawn_ = false;
    visiblePoints_.reset();
    draw::PointSets points = seen(view_);
    if (view_.ground && ground_.shape) points.push_back(&ground_.shape->geometry().positions());
    eye_ = draw::eyeOf(view_.camera, 1.0 * width_ / height_, points);
}

void Viewport::setFrame(const OpenedMeshPtr& model)
{
    box_ = boxOf(model);
    frame_ = draw::Frame(box_);
    for (Slot& slot : slots_) slot = Slot();
    for (Slot* const slot : {&standIn_, &boundStandIn_, &distances_, &ground_}) *slot = Slot();
    cagePoints_.clear();
    modelValues_.reset();
    occluder_.reset();
    isPosed_ = hasOnlyStandIn_ = false;
    posedVersion_ = 0;
}

void Viewport::fill(Slot& slot, const std::shared_ptr<const void>& source, const Mesh* mesh, double crease)
{
    slot.shape.reset();
    if (mesh && faceCount(*mesh) > 0) slot.shape.emplace(*api_, draw::Geometry(*mesh, frame_, crease));
    slot.source = source;
}

void Viewport::fillDistances(const CageResultPtr& cage, bool isWanted)
{
    const bool isThere = isWanted && cage && cage->intermediates;
    const std::shared_ptr<const void> source = isThere ? std::shared_ptr<const void>(cage) : nullptr;
    if (distances_.source == source) return;
    restart();
    largestDistance_ = 0;
    fill(distances_, source, isThere ? &cage->intermediates->distance.mesh : nullptr, 0);
    if (!distances_.shape) return;
    const std::vector<float>& distances = cage->intermediates->distance.distances;
    largestDistance_ = double{*std::max_element(distances.begin(), distances.end())};
    std::vector<draw::Colour> colours;
    for (const float distance : distances) {
        colours.push_back(distanceColour(largestDistance_ > 0 ? double{distance} / largestDistance_ : 0));
    }
    distances_.shape->setPointColours(colours);
}

void Viewport::fillGround(draw::UpAxis up)
{
    const openvdb::BBoxd& box = box_;
    const int height = up == draw::UpAxis::y ? 1 : 2;
    const int first = up == draw::UpAxis::y ? 2 : 0, second = up == draw::UpAxis::y ? 0 : 1;
    double radius = 0.5 * box.extents().length();
    if (!(radius > 0 && std::isfinite(radius))) radius = 1;
    gridStep_ = roundStep(radius / 6);
    // Lines at multiples of the step, so that coordinates can be read.
    const int reach = static_cast<int>(std::ceil(1.5 * radius / gridStep_));
    std::vector<std::pair<Vec3d, Vec3d>> lines;
    const Vec3d middle = 0.5 * (box.min() + box.max());
    for (const auto& [along, across] : {std::pair(first, second), std::pair(second, first)}) {
        const double start = std::round(middle[along] / gridStep_) * gridStep_;
        const double side = std::round(middle[across] / gridStep_) * gridStep_;
        for (int i = -reach; i <= reach; ++i) {
            Vec3d from, to;
            from[height] = to[height] = box.min()[height];
            from[along] = start - reach * gridStep_;
            to[along] = start + reach * gridStep_;
            from[across] = to[across] = side + i * gridStep_;
            lines.emplace_back(from, to);
        }
    }
    ground_.shape.reset();
    ground_.shape.emplace(*api_, draw::Geometry(lines, frame_));
    restart();
}

void Viewport::markFaces(const CageResult& cage, const ViewState& view)
{
    std::optional<draw::Shape>& shape = slots_[static_cast<std::size_t>(LayerId::cage)].shape;
    if (!shape) return;
    std::vector<draw::FaceLook> looks;
    const bool areSelected = view.selection.kind == edit::Element::face && !view.selection.ids.empty();
    if (!cage.report.check.badFaces.empty() || areSelected) looks.resize(faceCount(cage.cage));
    for (const std::uint32_t face : cage.report.check.badFaces) looks[face].flags |= draw::FaceLook::marked;
    for (const openvdb::Index32 face : view.selection.ids) {
        if (areSelected && face < looks.size()) looks[face].flags |= draw::FaceLook::selected;
    }
    shape->setFaceLooks(looks);
    restart();
}

std::vector<draw::Layer> Viewport::layers(const ViewState& view, bool standIn) const
{
    std::vector<draw::Layer> list;
    if (view.ground && ground_.shape && slots_[0].source) {
        draw::Layer layer;
        layer.shape = &*ground_.shape;
        layer.shaded = false;
        layer.opacity = 0;
        layer.edges = draw::Edges{gridColour, 0.55F, 0, 0.6, 0};
        list.push_back(layer);
    }
    for (std::size_t i = 0; i < layerCount; ++i) {
        const auto id = static_cast<LayerId>(i);
        const LayerLook& look = view.layers[i];
        if (!look.shown || !slots_[i].shape) continue;
        draw::Layer layer;
        layer.shape = &*slots_[i].shape;
        layer.colour = look.colour;
        if (id == LayerId::model) {
            if (modelValues_ && !hasOnlyStandIn_) layer.colour = {1, 1, 1};
            if (standIn && standIn_.shape) layer.shape = &*standIn_.shape;
            if (hasOnlyStandIn_ && boundStandIn_.shape) layer.shape = &*boundStandIn_.shape;
        }
        layer.opacity = static_cast<float>(look.opacity);
        if (id != LayerId::model) layer.edges = edgesOf(id, look);
        if (id == LayerId::cage) {
            if (distances_.shape) {
                draw::Layer coloured;
                coloured.shape = &*distances_.shape;
                coloured.colour = {1, 1, 1};
                coloured.opacity = static_cast<float>(std::max(0.8, look.opacity));
                list.push_back(coloured);
                layer.opacity = 0;
            } else if (view.cageColours == CageColours::kinds) {
                layer.quadColour = quadColour;
            }
            layer.shaded = layer.opacity >= 1;
            if (isStale_) {
                layer.colour = mixed(layer.colour, {0.6F, 0.6F, 0.6F}, 0.75F);
                if (layer.quadColour) layer.quadColour = mixed(*layer.quadColour, {0.6F, 0.6F, 0.6F}, 0.75F);
                layer.edges->colour = mixed(layer.edges->colour, {0.6F, 0.6F, 0.6F}, 0.6F);
            }
        }
        list.push_back(layer);
    }
    return list;
}

draw::PointSets Viewport::seen(const ViewState& view) const
{
    draw::PointSets points;
    for (std::size_t i = 0; i < layerCount; ++i) {
        if (view.layers[i].shown && slots_[i].shape) points.push_back(&slots_[i].shape->geometry().positions());
    }
    return points;
}

std::optional<draw::Section> Viewport::section() const
{
    if (!view_.section) return std::nullopt;
    const SectionPlane& plane = *view_.section;
    const Vec3d normal = plane.normal.unit();
    const Vec3d point = frame_.toDrawing(normal * (plane.offset / plane.normal.length()));
    // The renderer cuts off the other side.
    return draw::Section{-normal, -normal.dot(point)};
}

void Viewport::draw(bool isMoving)
{
    if (isMoving) frames_ = 0;
    if (frames_ == shifts) return;
    draw::Look look{eye_};
    look.background = background;
    look.section = section();
    draw::Target target = canvas_->target();
    target.lineWidth = lineWidth;
    if (!isMoving) {
        const auto [x, y] = shiftOf(frames_);
        look.crop.x = 2 * x / width_;
        look.crop.y = 2 * y / height_;
    }
    renderer_.draw(target, look, layers(view_, isMoving && isSoftware_));
    isDrawn_ = true;
    if (isMoving) return;
    const std::vector<std::uint8_t> pixels = canvas_->pixels();
    sums_.resize(pixels.size());
    if (frames_ == 0) std::fill(sums_.begin(), sums_.end(), std::uint16_t(0));
    for (std::size_t i = 0; i < pixels.size(); ++i) sums_[i] = static_cast<std::uint16_t>(sums_[i] + pixels[i]);
    ++frames_;
    means_.resize(pixels.size());
    for (std::size_t i = 0; i < means_.size(); ++i) {
        means_[i] = static_cast<std::uint8_t>((sums_[i] + frames_ / 2) / frames_);
    }
    api_->PixelStorei(GL_UNPACK_ALIGNMENT, 1);
    api_->TextureSubImage2D(average_.name(), 0, 0, 0, width_, height_, GL_RGBA, GL_UNSIGNED_BYTE, means_.data());
}

draw::Picture Viewport::picture()
{
    while (!isRefined()) draw(false);
    return draw::fromPixels(means_, width_, height_, false);
}

std::size_t Viewport::edgeCount(LayerId layer) const
{
    const Slot& slot = slots_[static_cast<std::size_t>(layer)];
    return slot.shape ? slot.shape->geometry().edges().size() : 0;
}

void Viewport::copyTo(GLuint framebuffer, int left, int bottom) const
{
    const GLuint from = frames_ > 0 ? averageFramebuffer_.name() : canvas_->target().framebuffer;
    api_->Disable(GL_SCISSOR_TEST);
    api_->BlitNamedFramebuffer(from, framebuffer, 0, 0, width_, height_, left, bottom, left + width_, bottom + height_,
                               GL_COLOR_BUFFER_BIT, GL_NEAREST);
}

draw::Camera Viewport::fitted(const ViewState& view, bool selection) const
{
    const double aspect = 1.0 * width_ / height_;
    const draw::Camera& camera = view.camera;
    std::vector<draw::Vec3f> selected;
    if (selection) {
        for (const openvdb::Index32 i : selectedPoints(view)) {
            const Vec3d p = frame_.toDrawing(cagePoints_[i]);
            selected.push_back({static_cast<float>(p.x()), static_cast<float>(p.y()), static_cast<float>(p.z())});
        }
    }
    if (!selected.empty()) return draw::fit(camera.view, camera.projection, {&selected}, aspect, 0.05);
    return draw::fit(camera.view, camera.projection, seen(view), aspect);
}

draw::Ray Viewport::rayAt(double x, double y) const
{
    return draw::rayThrough(eye_, x, y);
}

std::optional<Vec3d> Viewport::pointAt(double x, double y) const
{
    std::optional<draw::Hit> nearest;
    for (std::size_t i = 0; i < layerCount; ++i) {
        if (!view_.layers[i].shown || !slots_[i].shape) continue;
        const auto hit = draw::nearestHit(rayAt(x, y), slots_[i].shape->geometry(), section());
        if (hit && (!nearest || hit->distance < nearest->distance)) nearest = hit;
    }
    if (!nearest) return std::nullopt;
    return nearest->point;
}

std::vector<openvdb::Index32> Viewport::selectedPoints(const ViewState& view) const
{
    return cage_ ? view::selectedPoints(cage_->cage, view.selection) : std::vector<openvdb::Index32>();
}

std::optional<Vec3d> Viewport::selectionCentre(const ViewState& view) const
{
    const std::vector<openvdb::Index32> selected = selectedPoints(view);
    if (selected.empty()) return std::nullopt;
    Vec3d sum(0);
    for (const openvdb::Index32 i : selected) sum += frame_.toDrawing(cagePoints_[i]);
    return sum / static_cast<double>(selected.size());
}

std::optional<edit::Picking> Viewport::picking(const ViewState& view)
{
    if (!cage_ || !view.layer(LayerId::cage).shown) return std::nullopt;
    if (!elements_) elements_.emplace(cage_->cage);
    edit::PickView seen{eye_, 1.0 * width_, 1.0 * height_, section(), view.seeThrough};
    const std::optional<draw::Shape>& model = hasOnlyStandIn_ && boundStandIn_.shape
                                                  ? boundStandIn_.shape
                                                  : slots_[static_cast<std::size_t>(LayerId::model)].shape;
    const LayerLook& look = view.layer(LayerId::model);
    const bool hides = model && look.shown && look.opacity >= 1;
    if (hides && !occluder_) occluder_.emplace(model->geometry());
    std::vector<Vec3d> points;
    points.reserve(cagePoints_.size());
    for (const Vec3d& p : cagePoints_) points.push_back(frame_.toDrawing(p));
    return std::make_optional<edit::Picking>(*elements_, std::move(points), seen, hides ? &*occluder_ : nullptr);
}

std::optional<openvdb::Index32> Viewport::elementAt(const ViewState& view, const Pixel& at, double pixels)
{
    const auto made = picking(view);
    return made ? made->at(view.selection.kind, at[0], at[1], pixels) : std::nullopt;
}

std::vector<openvdb::Index32> Viewport::elementsWithin(const ViewState& view, const std::vector<Pixel>& border)
{
    const auto made = picking(view);
    if (!made) return {};
    std::vector<openvdb::Vec2d> polygon;
    for (const Pixel& corner : border) polygon.emplace_back(corner[0], corner[1]);
    return made->within(view.selection.kind, polygon);
}

void Viewport::addElements(const ViewState& view, bool isMoved, PictureOverlay& overlay)
{
    if (!cage_ || !view.layer(LayerId::cage).shown) return;
    const edit::Selection& selection = view.selection;
    const auto pixelAt = [&](openvdb::Index32 point) {
        const Vec3d seen = draw::project(eye_, frame_.toDrawing(cagePoints_[point]));
        return Pixel{(seen.x() + 1) / 2 * width_, (1 - seen.y()) / 2 * height_};
    };
    if (selection.kind == edit::Element::point) {
        if (!isMoved || !lastPoints_) {
            if (!visiblePoints_) {
                const double w = width_, h = height_;
                visiblePoints_ = picking(view)->within(edit::Element::point, {{0, 0}, {w, 0}, {w, h}, {0, h}});
            }
            lastPoints_ = visiblePoints_;
        }
        for (const openvdb::Index32 i : *lastPoints_) {
            if (i >= cagePoints_.size()) break;
            const bool isSelected = std::binary_search(selection.ids.begin(), selection.ids.end(), i);
            overlay.points.push_back({pixelAt(i), isSelected});
        }
    } else if (selection.kind == edit::Element::edge && !selection.ids.empty()) {
        if (!elements_) elements_.emplace(cage_->cage);
        for (const openvdb::Index32 edge : selection.ids) {
            if (edge >= elements_->edges().size()) break;
            const auto [a, b] = elements_->edges()[edge];
            overlay.edges.push_back({pixelAt(a), pixelAt(b)});
        }
    }
}

} // namespace vdbcage::view
