#include <tools/view/picture/model_shape.h>

#include <tools/draw/diverging_colours.h>

namespace vdbcage::view {

namespace {

constexpr double creaseDegrees = 40;

} // namespace

bool ModelShape::show(const OpenedMeshPtr& model, const draw::Frame& frame)
{
    const OpenedMeshPtr shown = model && !model->mesh.points.empty() ? model : nullptr;
    const bool isOther = model_.source != shown;
    if (isOther) model_.fill(*api_, frame, shown, shown ? &shown->mesh : nullptr, creaseDegrees);
    if (isSoftware_ && movingShape_.source != model) {
        const bool isLarge = model && triangulate(model->mesh).size() > 2 * mostStandInTriangles;
        movingModel_ = isLarge ? draw::standIn(model->mesh, mostStandInTriangles) : draw::StandIn();
        movingShape_.fill(*api_, frame, model, &movingModel_.mesh, creaseDegrees);
    }
    return isOther;
}

bool ModelShape::pose(const OpenedMeshPtr& model, const PosedModel* posed, const draw::Frame& frame)
{
    const std::uint64_t version = posed ? posed->version() : 0;
    if (version == posedVersion_) return false;
    posedVersion_ = version;
    std::optional<draw::Shape>& shape = model_.shape;
    const BoundModelPtr bound = posed && shape ? posed->bound() : nullptr;
    const bool isAtRest = !bound || bound->order.model != model;
    hasOnlyStandIn_ = !isAtRest && !posed->isWhole();
    if (hasOnlyStandIn_) {
        if (boundStandInShape_.source != bound->standIn) {
            boundStandInShape_.fill(*api_, frame, bound->standIn, &bound->standIn->mesh, creaseDegrees);
        }
        if (boundStandInShape_.shape) boundStandInShape_.shape->setPoints(posed->points());
        return true;
    }
    boundStandInShape_ = ShapeSlot();
    if (!shape || (isAtRest && !isPosed_)) return true;
    isPosed_ = !isAtRest;
    const std::vector<openvdb::Vec3d>& points = isAtRest ? model->mesh.points : posed->points();
    shape->setPoints(points);
    if (movingShape_.shape) {
        std::vector<openvdb::Vec3d> some;
        some.reserve(movingModel_.points.size());
        for (const openvdb::Index32 i : movingModel_.points) some.push_back(points[i]);
        movingShape_.shape->setPoints(posedStandIn(movingModel_, model->mesh, some));
    }
    return true;
}

bool ModelShape::colour(const OpenedMeshPtr& model, const ModelValues& values)
{
    const bool fits = model_.shape && values && values->size() == model->mesh.points.size();
    const ModelValues shown = fits ? values : nullptr;
    if (shown == values_) return false;
    values_ = shown;
    const std::vector<draw::Colour> colours = shown ? draw::divergingColours(*shown) : std::vector<draw::Colour>();
    if (model_.shape) model_.shape->setPointColours(colours);
    if (movingShape_.shape) {
        std::vector<draw::Colour> some;
        for (const openvdb::Index32 i : movingModel_.points) {
            if (shown) some.push_back(colours[i]);
        }
        movingShape_.shape->setPointColours(some);
    }
    return true;
}

const std::optional<draw::Shape>& ModelShape::drawn(bool isMoving) const
{
    if (hasOnlyStandIn_ && boundStandInShape_.shape) return boundStandInShape_.shape;
    return isMoving && movingShape_.shape ? movingShape_.shape : model_.shape;
}

} // namespace vdbcage::view
