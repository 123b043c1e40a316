#pragma once

#include <cstddef>
#include <cstdint>

// Plain data only: sources compiled for one instruction set each read this. Inline functions here would be compiled for
// each set, and the linker would keep any one of them.

namespace vdbcage::detail {

class UnitCage;

/// Weights a triangle of Somigliana coordinates: see cageHandles().
constexpr std::size_t somiglianaWeights = 6;

struct KernelEdge {
    std::uint32_t from, to;
    double length;
};

struct KernelTriangle {
    std::uint32_t corner[3];
    std::uint32_t edge[3]; ///< opposite each corner
    double sign[3];        ///< of that edge: -1 if it runs against the triangle
    double normal[3];      ///< of length 1
    double area;           ///< twice the triangle's
    double outward[3][3];  ///< in the plane, square to the edge, of length 1
    double flat[3][2];     ///< the same by the last two vectors of faceFrame()
    double along[3][3];    ///< of two edges, as the triangle runs: the one's direction dot the other, over `area`
    bool sliver;           ///< too narrow: normal and lengths have no valid digits
};

/// The extent of a part of a bilinear patch.
struct PatchExtent {
    double middle[3]; ///< mean of the corners
    double radius;    ///< of the corners, around it
    double halfU, halfV;
};

struct KernelQuad {
    std::uint32_t corner[4];
    PatchExtent extent;
};

/// Gauss rules on [0, 1], and the least distance from a line of half length 1 at which each suffices.
struct KernelRules {
    static constexpr int fewest = 3, most = 12;
    double at[most + 1][most], weight[most + 1][most];
    double leastDistance[most + 1];
};

/// A UnitCage as the row kernels read it.
struct KernelCage {
    std::size_t pointCount, edgeCount, triangleCount, quadCount; ///< edges of triangles only
    const double (*points)[3];
    const KernelEdge* edges;
    const KernelTriangle* triangles;
    const KernelQuad* quads;
    const double (*restoring)[3]; ///< see UnitCage::restore
    const double (*normals)[3];   ///< of Green coordinates: one a triangle, then four a quad; not of length 1
    const KernelRules* rules;
    const UnitCage* cage;
};

} // namespace vdbcage::detail
