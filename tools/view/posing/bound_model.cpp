#include <tools/view/posing/bound_model.h>

#include <algorithm>
#include <utility>

#include <tools/files/naming_files.h>
#include <vdbcage/deform/weights_io.h>

namespace vdbcage::view {

namespace {

constexpr std::size_t leastTriangles = 100, modelTrianglesPerTriangle = 10;

std::shared_ptr<const Binding> bound(const BindOrder& order, std::vector<openvdb::Vec3d> points,
                                     const CoordinateOptions& options, Interrupter* interrupter)
{
    return files::namingFiles({{"points", order.model->path.string()}}, [&] {
        return std::make_shared<const Binding>(*order.cage, std::move(points), options, interrupter);
    });
}

} // namespace

bool operator==(const BindOrder& a, const BindOrder& b)
{
    if (a.model != b.model || a.family != b.family || a.weights != b.weights) return false;
    return a.cage == b.cage || (a.cage->points == b.cage->points && a.cage->triangles == b.cage->triangles &&
                                a.cage->quads == b.cage->quads);
}

BindOrder bindOrder(const Document& document, const MeshPtr& cage)
{
    return {document.model, cage, document.coordinates, document.weights};
}

CoordinateOptions coordinateOptions(const BindOrder& order)
{
    CoordinateOptions options(order.family);
    options.loose.indices = loosePoints(order.model->mesh);
    return options;
}

std::size_t coarseTriangles(const Mesh& model)
{
    const std::size_t triangles = model.triangles.size() + 2 * model.quads.size();
    return std::clamp(triangles / modelTrianglesPerTriangle, leastTriangles, mostStandInTriangles);
}

std::shared_ptr<const Binding> makeBinding(const BindOrder& order, Interrupter* interrupter)
{
    const std::vector<openvdb::Vec3d>& points = order.model->mesh.points;
    if (order.weights) return std::make_shared<const Binding>(readWeights(order.weights->path, *order.cage, points));
    return bound(order, points, coordinateOptions(order), interrupter);
}

BoundModelPtr boundCoarsely(const BindOrder& order, Interrupter* interrupter)
{
    const Stage stage(interrupter, StageName::bindCoarsely);
    const Mesh& model = order.model->mesh;
    BoundModel bound;
    bound.order = order;
    bound.standIn = std::make_shared<const draw::StandIn>(draw::standIn(model, coarseTriangles(model)));
    if (order.weights) return std::make_shared<const BoundModel>(std::move(bound));
    std::vector<openvdb::Vec3d> points;
    points.reserve(bound.standIn->points.size());
    for (const openvdb::Index32 i : bound.standIn->points) points.push_back(model.points[i]);
    bound.coarse = view::bound(order, std::move(points), order.family, interrupter);
    return std::make_shared<const BoundModel>(std::move(bound));
}

BoundModelPtr boundWhole(const BoundModel& coarse, Interrupter* interrupter)
{
    const Stage stage(interrupter, StageName::bind);
    BoundModel bound = coarse;
    bound.whole = makeBinding(bound.order, interrupter);
    return std::make_shared<const BoundModel>(std::move(bound));
}

std::shared_ptr<const Binding> withMaterial(const std::shared_ptr<const Binding>& binding, const Elasticity& elasticity)
{
    if (!binding || !familyInfo(binding->family()).hasElasticity || binding->options().elasticity == elasticity) {
        return binding;
    }
    return std::make_shared<const Binding>(binding->with(elasticity));
}

BoundModelPtr withMaterial(const BoundModelPtr& bound, const Elasticity& elasticity)
{
    if (!bound) return bound;
    BoundModel changed = *bound;
    changed.coarse = withMaterial(bound->coarse, elasticity);
    changed.whole = withMaterial(bound->whole, elasticity);
    if (changed.coarse == bound->coarse && changed.whole == bound->whole) return bound;
    return std::make_shared<const BoundModel>(std::move(changed));
}

std::vector<openvdb::Vec3d> posedStandIn(const draw::StandIn& standIn, const Mesh& model,
                                         const std::vector<openvdb::Vec3d>& posed)
{
    std::vector<openvdb::Vec3d> points(standIn.mesh.points.size());
    for (std::size_t i = 0; i < points.size(); ++i) {
        points[i] = posed[i] + (standIn.mesh.points[i] - model.points[standIn.points[i]]);
    }
    return points;
}

} // namespace vdbcage::view
