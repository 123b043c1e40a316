#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include <vdbcage/voxelize/detail/bit_grid.h>
#include <vdbcage/voxelize/detail/frame.h>
#include <voxelize/models.h>

/// The definition of a model's voxels, voxel by voxel and triangle by triangle, as plainly as it can be written.
namespace vdbcage::test {

__extension__ using Int128 = __int128;
using Vector = std::array<Int128, 3>;

inline Vector operator-(const Vector& a, const Vector& b)
{
    return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
inline Int128 dot(const Vector& a, const Vector& b)
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
inline Vector cross(const Vector& a, const Vector& b)
{
    return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

using Triangle = std::array<Vector, 3>;

/// Whether the triangle meets the cube around `centre`: none of the 13 axes separates them.
inline bool touches(const Triangle& triangle, const Vector& centre, Int128 halfWidth)
{
    std::array<Vector, 13> axes = {Vector{1, 0, 0}, Vector{0, 1, 0}, Vector{0, 0, 1}};
    axes[3] = cross(triangle[1] - triangle[0], triangle[2] - triangle[0]);
    for (std::size_t i = 0; i < 9; ++i) axes[4 + i] = cross(triangle[(i + 1) % 3] - triangle[i % 3], axes[i / 3]);
    return std::all_of(axes.begin(), axes.end(), [&](const Vector& axis) {
        const Int128 reach = halfWidth * ((axis[0] < 0 ? -axis[0] : axis[0]) + (axis[1] < 0 ? -axis[1] : axis[1]) +
                                          (axis[2] < 0 ? -axis[2] : axis[2]));
        Int128 low = dot(axis, triangle[0] - centre), high = low;
        for (const Vector& corner : triangle) {
            low = std::min(low, dot(axis, corner - centre));
            high = std::max(high, dot(axis, corner - centre));
        }
        return low <= reach && high >= -reach;
    });
}

/// Whether the ray that comes along `axis` from minus infinity to `centre` crosses the triangle. The ray is moved by
/// (2^-28, 2^-56) of a lattice unit, which the integers are scaled up for: no tie is left.
inline bool crosses(const Triangle& triangle, const Vector& centre, std::size_t axis)
{
    const std::size_t u = axis == 0 ? 1 : 0, v = axis == 2 ? 1 : 2;
    const Int128 unit = Int128(1) << 56, moveU = Int128(1) << 28, moveV = 1;
    int left = 0, right = 0;
    for (std::size_t i = 0; i < 3; ++i) {
        const Vector &p = triangle[i], &q = triangle[(i + 1) % 3];
        const Int128 side =
            (q[u] - p[u]) * ((centre[v] - p[v]) * unit + moveV) - (q[v] - p[v]) * ((centre[u] - p[u]) * unit + moveU);
        if (side == 0) return false; // an edge along the ray: no area
        ++(side > 0 ? left : right);
    }
    if (left != 3 && right != 3) return false;
    const Vector normal = cross(triangle[1] - triangle[0], triangle[2] - triangle[0]);
    const Int128 above = dot(normal, centre - triangle[0]);
    return normal[axis] > 0 ? above > 0 : above < 0;
}

struct Reference {
    openvdb::CoordBBox box;
    std::vector<char> surface, solid;

    std::size_t index(const openvdb::Coord& ijk) const
    {
        const openvdb::Coord size = box.dim(), at = ijk - box.min();
        return static_cast<std::size_t>((at.x() * size.y() + at.y()) * size.z() + at.z());
    }

    Reference(const Mesh& mesh, const detail::Frame& frame) : box(frame.voxels)
    {
        const std::vector<openvdb::Vec3i> lattice = detail::latticePoints(mesh, frame);
        const auto corner = [&](openvdb::Index32 i) { return Vector{lattice[i][0], lattice[i][1], lattice[i][2]}; };
        std::vector<Triangle> counted, others;
        for (const auto& t : mesh.triangles) counted.push_back({corner(t[0]), corner(t[1]), corner(t[2])});
        for (const auto& q : mesh.quads) {
            counted.push_back({corner(q[0]), corner(q[1]), corner(q[2])});
            counted.push_back({corner(q[0]), corner(q[2]), corner(q[3])});
            others.push_back({corner(q[0]), corner(q[1]), corner(q[3])});
            others.push_back({corner(q[1]), corner(q[2]), corner(q[3])});
        }
        const auto voxels = static_cast<std::size_t>(box.volume());
        surface.assign(voxels, 0);
        solid.assign(voxels, 0);
        for (const openvdb::Coord& ijk : box) {
            const std::size_t i = index(ijk);
            const Vector centre = {Int128(ijk.x()) * detail::latticeStep, Int128(ijk.y()) * detail::latticeStep,
                                   Int128(ijk.z()) * detail::latticeStep};
            const auto touched = [&](const Triangle& t) {
                return near(t, centre) && touches(t, centre, detail::latticeBound);
            };
            surface[i] = std::any_of(counted.begin(), counted.end(), touched) ||
                         std::any_of(others.begin(), others.end(), touched);
            int votes = 0;
            for (std::size_t axis = 0; axis < 3; ++axis) {
                const auto isOddUpTo = [&](const Vector& end) {
                    return std::count_if(counted.begin(), counted.end(),
                                         [&](const Triangle& t) { return crosses(t, end, axis); }) %
                               2 ==
                           1;
                };
                Vector otherEnd = centre;
                otherEnd[axis] = Int128(box.max()[axis] + 2) * detail::latticeStep;
                if (isOddUpTo(centre) && !isOddUpTo(otherEnd)) ++votes;
            }
            solid[i] = surface[i] || votes >= 2;
        }
        fill();
    }

private:
    static bool near(const Triangle& t, const Vector& centre)
    {
        for (std::size_t k = 0; k < 3; ++k) {
            if (std::min({t[0][k], t[1][k], t[2][k]}) > centre[k] + detail::latticeStep) return false;
            if (std::max({t[0][k], t[1][k], t[2][k]}) < centre[k] - detail::latticeStep) return false;
        }
        return true;
    }

    /// Everything that a walk through zero voxels from beyond the box does not reach.
    void fill()
    {
        std::vector<char> reached(solid.size(), 0);
        std::vector<openvdb::Coord> walk;
        const auto enter = [&](const openvdb::Coord& ijk) {
            if (!box.isInside(ijk) || solid[index(ijk)] || reached[index(ijk)]) return;
            reached[index(ijk)] = 1;
            walk.push_back(ijk);
        };
        for (const openvdb::Coord& ijk : box) {
            for (std::size_t axis = 0; axis < 3; ++axis) {
                if (ijk[axis] == box.min()[axis] || ijk[axis] == box.max()[axis]) enter(ijk);
            }
        }
        while (!walk.empty()) {
            const openvdb::Coord ijk = walk.back();
            walk.pop_back();
            for (std::size_t axis = 0; axis < 3; ++axis) {
                for (const int step : {-1, 1}) {
                    openvdb::Coord next = ijk;
                    next[axis] += step;
                    enter(next);
                }
            }
        }
        for (std::size_t i = 0; i < solid.size(); ++i) solid[i] = !reached[i];
    }
};

/// The reference of a model at a resolution, worked out once for all tests.
inline const Reference& referenceOf(const HardModel& model)
{
    static std::map<std::string, Reference> known;
    const auto found = known.find(model.name);
    if (found != known.end()) return found->second;
    return known.try_emplace(model.name, model.mesh, detail::makeFrame(model.mesh, model.resolution)).first->second;
}

/// The bit of a voxel of the grid's box.
inline bool isOn(const detail::BitGrid& bits, const openvdb::Coord& ijk)
{
    const openvdb::Coord at = ijk - bits.box().min();
    return bits.row(at.x(), at.y())[at.z() / 64] >> (at.z() % 64) & 1;
}

} // namespace vdbcage::test
