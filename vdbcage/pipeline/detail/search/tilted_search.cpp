#include <vdbcage/core/detail/grids.h>
#include <vdbcage/pipeline/detail/search/tilted_search.h>

#include <memory>
#include <utility>

#include <vdbcage/core/detail/parallel.h>
#include <vdbcage/pipeline/detail/stages/mesh_tools.h>

namespace vdbcage::detail {

namespace {

using openvdb::Mat3d;
using openvdb::Vec3d;

/// Returns the rotation that turns `normal`, of length 1, to x.
Mat3d rotationToX(const Vec3d& normal)
{
    Vec3d least(0.0);
    least[static_cast<int>(openvdb::math::MinIndex(openvdb::math::Abs(normal)))] = 1;
    Vec3d up = normal.cross(least);
    up.normalize();
    return {normal, up, normal.cross(up), /*rows=*/true};
}

} // namespace

TiltedSearch::TiltedSearch(const Mesh& model, const TiltedSymmetry& plane, Certifier& certifier)
    : plane_(plane), certifier_(certifier), rotation_(rotationToX(plane.normal)), turned_(turned(model, rotation_)),
      search_(turned_, volumes_, turnedCertifier_, Symmetry{{0, plane.offset}, plane.deviation})
{
}

std::optional<Candidate> TiltedSearch::run(const CageOptions& options, std::size_t memoryLimit,
                                           Interrupter* interrupter)
{
    CageOptions acrossX = options;
    acrossX.symmetry = CageSymmetry::x;
    const FieldVersion none;
    Candidate candidate = search_.run({acrossX, none, none, memoryLimit, interrupter});
    if (!candidate.symmetry) return std::nullopt;
    candidate.cage = certifier_.rounded(turnedBack(std::move(candidate.cage)), options.precision);
    candidate.check = certifier_.check(candidate.cage, interrupter);
    candidate.boundsAsFloats = certifier_.boundsAsFloats(candidate.cage, options.precision, interrupter);
    if (!candidate.check.bounding() || !candidate.boundsAsFloats) return std::nullopt;

    candidate.symmetry.reset();
    candidate.tiltedSymmetry = plane_;
    candidate.decimated = turnedBack(std::move(candidate.decimated));
    candidate.surface = std::make_shared<const Mesh>(turnedBack(*candidate.surface));
    candidate.smoothed = turnedBack(std::move(candidate.smoothed));
    auto closing = std::make_shared<Closing>(*candidate.closing);
    auto solid = std::make_shared<Solid>(*closing->solid);
    isolated([&] {
        solid->mask = turnedBack(*solid->mask);
        closing->mask = turnedBack(*closing->mask);
    });
    closing->solid = std::move(solid);
    candidate.closing = std::move(closing);
    return candidate;
}

Mesh TiltedSearch::turnedBack(Mesh mesh) const
{
    return turned(std::move(mesh), rotation_.transpose());
}

/// Returns the same voxels with another transform.
openvdb::MaskGrid::ConstPtr TiltedSearch::turnedBack(const openvdb::MaskGrid& mask) const
{
    const openvdb::math::Transform& now = mask.transform();
    const Vec3d origin = now.indexToWorld(Vec3d(0.0));
    openvdb::Mat4d matrix = openvdb::Mat4d::identity(); // its rows are the images of the axes
    for (int axis = 0; axis < 3; ++axis) {
        Vec3d unit(0.0);
        unit[axis] = 1;
        const Vec3d step = rotation_.transpose() * (now.indexToWorld(unit) - origin);
        for (int i = 0; i < 3; ++i) matrix(axis, i) = step[i];
    }
    const Vec3d place = rotation_.transpose() * origin;
    for (int i = 0; i < 3; ++i) matrix(3, i) = place[i];
    return mask.copyReplacingTransform(openvdb::math::Transform::createLinearTransform(matrix));
}

} // namespace vdbcage::detail
