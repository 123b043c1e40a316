#include <tools/view/state/bound_model.h>

#include <algorithm>
#include <utility>

#include <vdbcage/core/error.h>

namespace vdbcage::view {

namespace {

constexpr std::size_t mostTriangles = 12000, leastTriangles = 100, modelTrianglesPerTriangle = 10;

std::shared_ptr<const Binding> bound(const BindOrder& order, std::vector<openvdb::Vec3d> points,
                                     Interrupter* interrupter)
{
    try {
        return std::make_shared<const Binding>(*order.cage, std::move(points), order.family, interrupter);
    } catch (const InputError& error) { // of the library, which does not know the file
        const std::string text = error.what(), prefix = "points: ";
        if (text.compare(0, prefix.size(), prefix) != 0) throw;
        throw InputError(order.model->path.string() + ": " + text.substr(prefix.size()));
    }
}

} // namespace

bool operator==(const BindOrder& a, const BindOrder& b)
{
    if (a.model != b.model || a.family != b.family) return false;
    return a.cage == b.cage || (a.cage->points == b.cage->points && a.cage->triangles == b.cage->triangles &&
                                a.cage->quads == b.cage->quads);
}

std::size_t coarseTriangles(const Mesh& model)
{
    const std::size_t triangles = model.triangles.size() + 2 * model.quads.size();
    return std::clamp(triangles / modelTrianglesPerTriangle, leastTriangles, mostTriangles);
}

std::shared_ptr<const Binding> bindingOf(const BindOrder& order, Interrupter* interrupter)
{
    return bound(order, order.model->mesh.points, interrupter);
}

BoundModelPtr boundCoarsely(const BindOrder& order, Interrupter* interrupter)
{
    const Stage stage(interrupter, "bind coarsely");
    const Mesh& model = order.model->mesh;
    BoundModel bound;
    bound.order = order;
    bound.standIn = std::make_shared<const draw::StandIn>(draw::standIn(model, coarseTriangles(model)));
    std::vector<openvdb::Vec3d> points;
    points.reserve(bound.standIn->points.size());
    for (const openvdb::Index32 i : bound.standIn->points) points.push_back(model.points[i]);
    bound.coarse = view::bound(order, std::move(points), interrupter);
    return std::make_shared<const BoundModel>(std::move(bound));
}

BoundModelPtr boundWhole(const BoundModel& coarse, Interrupter* interrupter)
{
    const Stage stage(interrupter, "bind");
    BoundModel bound = coarse;
    bound.whole = bindingOf(bound.order, interrupter);
    return std::make_shared<const BoundModel>(std::move(bound));
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
