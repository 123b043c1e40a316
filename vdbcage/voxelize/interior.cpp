// Based on: Nooruddin and Turk, "Simplification and Repair of Polygonal Models Using Volumetric Techniques", 2003
// (parity counts along rays).

#include <vdbcage/voxelize/interior.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

#include <vdbcage/voxelize/detail/bit_grid.h>
#include <vdbcage/voxelize/detail/face_scan.h>
#include <vdbcage/voxelize/detail/frame.h>

namespace vdbcage {

namespace {

using Word = detail::BitGrid::Word;
using openvdb::Vec3i;

constexpr int resolution = 64;
constexpr int rows = resolution + 1, wordsPerRow = (rows + detail::BitGrid::wordBits - 1) / detail::BitGrid::wordBits;

/// The rays along one axis, a bit for each.
struct Rays {
    using Plane = std::array<Word, std::size_t(rows* wordsPerRow)>;
    Plane crossed{}, odd{};

    /// Sets the rays that cross `triangle` in `crossed`, and flips them in `odd`. The axis of the rays is the first of
    /// `triangle`. `scratch` is all zero, before and after.
    void cross(const detail::LatticeTriangle& triangle, Plane& scratch)
    {
        const auto [low, high] =
            std::minmax({triangle.corners[0].y(), triangle.corners[1].y(), triangle.corners[2].y()});
        detail::scanCrossingsAlongX(triangle, {0, resolution}, scratch.data(), wordsPerRow);
        const auto first = static_cast<std::size_t>(low >> detail::latticeBits) * wordsPerRow;
        const auto end = static_cast<std::size_t>((high >> detail::latticeBits) + 1) * wordsPerRow;
        for (std::size_t i = first; i < end; ++i) {
            crossed[i] |= scratch[i];
            odd[i] ^= scratch[i];
            scratch[i] = 0;
        }
    }
};

std::size_t count(const Rays::Plane& plane)
{
    std::size_t bits = 0;
    for (const Word word : plane) bits += static_cast<std::size_t>(__builtin_popcountll(word));
    return bits;
}

} // namespace

double rayAgreement(const Mesh& model, Interrupter* interrupter)
{
    constexpr std::size_t asksEvery = 16384; // triangles
    requireUsable(model, "model");
    const std::vector<Vec3i> points = detail::latticePoints(model, detail::makeFrame(model, resolution));
    std::array<Rays, 3> rays;
    Rays::Plane scratch{};
    std::size_t done = 0;
    for (const openvdb::Vec3I& face : triangulate(model)) {
        if (done++ % asksEvery == 0) throwIfInterrupted(interrupter);
        for (int axis = 0; axis < 3; ++axis) {
            const int u = axis == 0 ? 1 : 0, v = axis == 2 ? 1 : 2;
            detail::LatticeTriangle triangle;
            for (int i = 0; i < 3; ++i) {
                const Vec3i& p = points[face[i]];
                triangle.corners[i] = Vec3i(p[axis], p[u], p[v]);
            }
            rays[static_cast<std::size_t>(axis)].cross(triangle, scratch);
        }
    }
    std::size_t crossed = 0, odd = 0;
    for (const Rays& along : rays) {
        crossed += count(along.crossed);
        odd += count(along.odd);
    }
    return crossed == 0 ? 1 : 1 - static_cast<double>(odd) / static_cast<double>(crossed);
}

} // namespace vdbcage
