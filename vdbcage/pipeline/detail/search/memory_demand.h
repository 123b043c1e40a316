#pragma once

#include <cstddef>
#include <functional>

#include <vdbcage/mesh/mesh.h>
#include <vdbcage/pipeline/detail/search_policy.h>

namespace vdbcage::detail {

/// A prediction of the memory of a process that makes a cage, at any resolution.
class MemoryDemand {
public:
    /// `share` is shareOfSide(). `quadsOf` is called once for the number of quads of the surface of a closing, with at
    /// most 64 voxels along the share: finer ones add less than a third to the surface, mostly nothing.
    /// \throw the exceptions of `quadsOf`
    MemoryDemand(const Mesh& model, const CageOptions& options, double share,
                 const std::function<std::size_t(const Voxels&)>& quadsOf);

    /// Returns the bytes at a resolution; 0 stands for that of the options.
    double bytes(int resolution = 0) const;
    /// \throw MemoryError more than `limit` bytes; it names the finest resolution that fits
    void requireWithin(std::size_t limit) const;

private:
    int finestWithin(double limit) const;

    CageOptions options_;
    double modelTriangles_;
    double share_;
    double quads_ = 0; ///< of the closing's surface, over the square of the resolution
    double box_ = 1;   ///< the volume of the bounding box, over the cube of its longest side
};

} // namespace vdbcage::detail
