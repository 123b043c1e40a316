#include <vdbcage/check/check.h>

#include <algorithm>
#include <limits>

#include <vdbcage/check/detail/cage_faces.h>
#include <vdbcage/check/detail/checked_model.h>
#include <vdbcage/check/detail/enclosure.h>
#include <vdbcage/check/detail/measures.h>
#include <vdbcage/check/detail/predicates.h>
#include <vdbcage/core/error.h>
#include <vdbcage/mesh/topology.h>

namespace vdbcage {

using openvdb::Vec3d;
using openvdb::Vec3I;

namespace {

std::size_t countDegenerateFaces(detail::CageFaces& cage)
{
    std::size_t result = 0;
    for (std::size_t face = 0; face < cage.faces.faces(); ++face) {
        const auto triangles = cage.degenerate.begin();
        if (std::count(triangles + static_cast<std::ptrdiff_t>(cage.faces.first(face)),
                       triangles + static_cast<std::ptrdiff_t>(cage.faces.first(face + 1)), 1) == 0) {
            continue;
        }
        ++result;
        detail::set(cage.bad[face]);
    }
    return result;
}

std::size_t countInwardComponents(const Mesh& mesh, const MeshTopology& topology, Interrupter* interrupter)
{
    std::vector<std::vector<Vec3I>> components(topology.components());
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
        components[topology.faceComponent[i]].push_back(mesh.triangles[i]);
    }
    for (std::size_t i = 0; i < mesh.quads.size(); ++i) {
        const openvdb::Vec4I& q = mesh.quads[i];
        std::vector<Vec3I>& component = components[topology.faceComponent[mesh.triangles.size() + i]];
        // The diagonal with which the component has the smaller volume.
        const std::vector<Vec3d>& p = mesh.points;
        if (detail::sideOfPlane(p[q[0]], p[q[1]], p[q[2]], p[q[3]]) >= 0) {
            component.emplace_back(q[0], q[1], q[2]);
            component.emplace_back(q[0], q[2], q[3]);
        } else {
            component.emplace_back(q[0], q[1], q[3]);
            component.emplace_back(q[1], q[2], q[3]);
        }
    }
    std::size_t result = 0;
    for (std::size_t i = 0; i < components.size(); ++i) {
        if (topology.componentIsCycle[i] && detail::volumeSign(mesh.points, components[i], interrupter) <= 0) ++result;
    }
    return result;
}

void measure(CageCheck& result, const detail::CageFaces& cage, const detail::CheckedModel& model, bool hasInside,
             std::size_t samples, Interrupter* interrupter)
{
    if (hasInside) result.cageVolume = detail::volume(cage.mesh.points, cage.faces);
    if (model.volume > 0) result.volumeRatio = result.cageVolume / model.volume;
    const detail::Angles angles = detail::angles(cage.mesh.points, cage.faces, interrupter);
    result.minAngleDegrees = angles.least;
    result.angle1stPercentileDegrees = angles.firstPercentile;
    result.medianAngleDegrees = angles.median;
    if (!(model.longestSide > 0)) return;
    result.longestSide = model.longestSide;
    result.diagonal = model.diagonal / model.longestSide;
    const detail::Distances distances =
        detail::distances(cage.mesh.points, cage.faces, model.tree, samples, interrupter);
    result.meanDistance = distances.mean / model.longestSide;
    result.maxDistance = distances.most / model.longestSide;
    result.minDistance = distances.least / model.longestSide;
}

} // namespace

class CageChecker::Model : public detail::CheckedModel {
public:
    using CheckedModel::CheckedModel;
};

CageChecker::CageChecker(const Mesh& model, Interrupter* interrupter)
    : model_(std::make_shared<const Model>(model, interrupter))
{
}

CageCheck CageChecker::check(const Mesh& given, const CheckOptions& options, Interrupter* interrupter) const
{
    detail::requireSound(given, "cage");
    throwIfInterrupted(interrupter);
    Mesh rounded;
    if (options.asFloats) {
        rounded = given;
        for (Vec3d& p : rounded.points) p = detail::nearestFloat(p);
        detail::requireSound(rounded, "cage as floats");
        if (detail::farthest({model_->tree.box().lo, model_->tree.box().hi}) > std::numeric_limits<float>::max()) {
            throw InputError("model", "its coordinates are not within the range of float");
        }
    }
    const Mesh& cage = options.asFloats ? rounded : given;
    const detail::CheckedModel::View model{*model_, options.asFloats};

    CageCheck result;
    result.points = cage.points.size();
    result.triangles = cage.triangles.size();
    result.quads = cage.quads.size();

    const MeshTopology topology = analyzeTopology(cage, interrupter);
    result.components = topology.components();
    result.genus = topology.genus();
    result.boundaryEdges = topology.boundaryEdges;
    result.nonManifoldEdges = topology.nonManifoldEdges;
    result.nonManifoldVertices = topology.nonManifoldVertices;
    result.misorientedEdges = topology.misorientedEdges;
    result.inwardComponents = countInwardComponents(cage, topology, interrupter);

    detail::CageFaces faces(cage, interrupter);
    result.degenerateFaces = countDegenerateFaces(faces);
    result.selfIntersections = detail::countSelfIntersections(faces, interrupter);

    detail::Flags touched(model_->parts());
    result.contactFaces = detail::countContacts(faces, model, touched, interrupter);
    result.modelVerticesOutside =
        topology.isCycle() ? detail::countOutside(faces, model, touched, interrupter) : model_->usedVertices;
    result.loosePoints = model_->loosePoints.size();
    result.loosePointsOutside =
        topology.isCycle() ? detail::countLooseOutside(faces, model, interrupter) : model_->loosePoints.size();

    for (std::uint32_t face = 0; face < faces.bad.size(); ++face) {
        if (detail::isSet(faces.bad[face])) result.badFaces.push_back(face);
    }
    if (options.measure) measure(result, faces, *model_, topology.isCycle(), options.samples, interrupter);
    return result;
}

std::size_t CageChecker::hollows() const
{
    return model_->hollows;
}

CageCheck checkCage(const Mesh& cage, const Mesh& model, const CheckOptions& options, Interrupter* interrupter)
{
    return CageChecker(model, interrupter).check(cage, options, interrupter);
}

} // namespace vdbcage
