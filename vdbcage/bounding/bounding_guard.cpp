// Based on: shared ideas of Sander et al., "Silhouette Clipping", 2000 (hulls kept outside while decimating), and Sacht
// et al., "Nested Cages", 2015.
// Differs: moves are vetoed one star at a time by exact or error-bounded tests; nothing is projected or re-inflated.

#include <vdbcage/bounding/bounding_guard.h>

#include <array>
#include <utility>
#include <vector>

#include <tbb/blocked_range.h>
#include <vdbcage/bounding/detail/guard/guard_model.h>
#include <vdbcage/core/detail/parallel.h>

namespace vdbcage {

BoundingGuard::BoundingGuard(const Mesh& model, const GuardOptions& options, Interrupter* interrupter)
    : model_(std::make_unique<const detail::GuardModel>(model, options, interrupter))
{
}
BoundingGuard::~BoundingGuard() = default;
BoundingGuard::BoundingGuard(BoundingGuard&&) noexcept = default;
BoundingGuard& BoundingGuard::operator=(BoundingGuard&&) noexcept = default;

const detail::GuardModel& detail::modelOf(const BoundingGuard& guard)
{
    return *guard.model_;
}

double BoundingGuard::clearance() const
{
    return model_->unscaled(openvdb::Vec3d(model_->clearance()))[0];
}

std::vector<std::size_t> BoundingGuard::facesTooNear(const Mesh& surface) const
{
    const auto isClear = [&](const detail::Corners& t) {
        if (!model_->clear(t, detail::TriangleBvh::none, nullptr)) return false;
        // Parts behind the plane of symmetry come as near as their mirror images.
        return !model_->symmetry() ||
               model_->clear({model_->mirrored(t[0]), model_->mirrored(t[1]), model_->mirrored(t[2])},
                             detail::TriangleBvh::none, nullptr);
    };
    const auto place = [&](openvdb::Index32 i) { return model_->rounded(model_->scaled(surface.points[i])); };
    const std::size_t triangles = surface.triangles.size();
    const auto isFaceClear = [&](std::size_t face) {
        if (face < triangles) {
            const openvdb::Vec3I& t = surface.triangles[face];
            return isClear({place(t[0]), place(t[1]), place(t[2])});
        }
        const openvdb::Vec4I& q = surface.quads[face - triangles];
        const detail::Vec3d a = place(q[0]), b = place(q[1]), c = place(q[2]), d = place(q[3]);
        return isClear({a, b, c}) && isClear({a, c, d}) && isClear({a, b, d}) && isClear({b, c, d});
    };
    using Faces = std::vector<std::size_t>;
    return detail::parallelReduce(
        tbb::blocked_range<std::size_t>(0, faceCount(surface), 256), Faces{},
        [&](const tbb::blocked_range<std::size_t>& range, Faces faces) {
            for (std::size_t face = range.begin(); face < range.end(); ++face) {
                if (!isFaceClear(face)) faces.push_back(face);
            }
            return faces;
        },
        [](Faces before, const Faces& after) {
            before.insert(before.end(), after.begin(), after.end());
            return before;
        });
}

std::optional<SymmetryPlane> BoundingGuard::symmetry() const
{
    auto plane = model_->symmetry();
    if (plane) plane->offset = model_->unscaled(openvdb::Vec3d(plane->offset))[0];
    return plane;
}

Mesh BoundingGuard::symmetrized(const Mesh& surface, double snap) const
{
    using openvdb::Index32;
    const int axis = model_->symmetry()->axis;
    const double offset = model_->symmetry()->offset;
    const double least = offset + model_->scaled(openvdb::Vec3d(snap))[0];
    std::vector<openvdb::Vec3d> places;
    places.reserve(surface.points.size());
    for (const openvdb::Vec3d& point : surface.points) {
        openvdb::Vec3d p = model_->scaled(point);
        if (p[axis] <= least) p[axis] = offset;
        places.push_back(model_->rounded(p));
    }
    const auto isBeyond = [&](Index32 i) { return places[i][axis] > offset; };
    // The number of each point and of its mirror image, set when a face needs them.
    constexpr Index32 unused = ~Index32(0);
    std::vector<std::array<Index32, 2>> numbers(places.size(), {unused, unused});
    Mesh result;
    const auto number = [&](Index32 i, std::size_t side) {
        auto& known = numbers[i];
        if (known[side] == unused) {
            known[side] = static_cast<Index32>(result.points.size());
            result.points.push_back(model_->unscaled(side == 0 ? places[i] : model_->mirrored(places[i])));
            if (!isBeyond(i)) known[1 - side] = known[side];
        }
        return known[side];
    };
    for (const openvdb::Vec3I& t : surface.triangles) {
        if (!isBeyond(t[0]) && !isBeyond(t[1]) && !isBeyond(t[2])) continue;
        result.triangles.emplace_back(number(t[0], 0), number(t[1], 0), number(t[2], 0));
        result.triangles.emplace_back(number(t[0], 1), number(t[2], 1), number(t[1], 1));
    }
    for (const openvdb::Vec4I& q : surface.quads) {
        if (!isBeyond(q[0]) && !isBeyond(q[1]) && !isBeyond(q[2]) && !isBeyond(q[3])) continue;
        result.quads.emplace_back(number(q[0], 0), number(q[1], 0), number(q[2], 0), number(q[3], 0));
        result.quads.emplace_back(number(q[0], 1), number(q[3], 1), number(q[2], 1), number(q[1], 1));
    }
    return result;
}

} // namespace vdbcage
