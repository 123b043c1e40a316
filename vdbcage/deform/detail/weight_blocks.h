#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include <vdbcage/core/interrupter.h>
#include <vdbcage/mesh/mesh.h>

namespace vdbcage::detail {

/// \throw InputError the number of weights is not points times handles
void requireWeights(std::size_t weights, std::size_t points, std::size_t handles);

/// The move of a handle.
struct HandleMove {
    std::size_t handle;
    openvdb::Vec3f motion;
};

/// The weights by which points move, in blocks of points that are close together.
///
/// A block holds the weights of as few of its points as possible. Those of the others are combinations of these.
class WeightBlocks {
public:
    /// Writes the weights of `points`, given as indices, to `rows`, which has their size. Each `packetSize` points in
    /// order, the number that kernels take at a time, are close together. Several threads call it.
    using MakeRows = std::function<void(const std::vector<std::uint32_t>& points, std::vector<float>& rows)>;

    /// The error that combinations may have: four times that of rounding to float.
    static constexpr float tolerance = 1.0F / (1 << 22);

    /// `reach` has about how far each handle may move. The size of a row is the sum of its weights' absolute values,
    /// each times its handle's reach. A row is off by at most `tolerance` of its size, and by four times that with
    /// rounding, for any weights.
    /// \pre `points` are finite
    /// \throw Cancelled
    WeightBlocks(const std::vector<openvdb::Vec3d>& points, const std::vector<float>& reach, const MakeRows& makeRows,
                 Interrupter* interrupter = nullptr);

    /// Moves `points` by `handleMoves`, times `size`. The result is the same for any number of threads.
    /// Cost: reading the weights of these handles and the combinations once, in parallel.
    void move(const std::vector<HandleMove>& handleMoves, double size, std::vector<openvdb::Vec3d>& points) const;

    std::size_t bytes() const;

private:
    struct Block {
        std::vector<std::uint32_t> points; ///< first those whose weights are held
        std::size_t heldCount = 0;
        std::vector<float> weights; ///< group of points by group, in each by handle; then combinations in the same way
    };

    std::size_t handles_;
    std::vector<Block> blocks_;
};

} // namespace vdbcage::detail
