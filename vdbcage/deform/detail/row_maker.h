#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include <vdbcage/core/interrupter.h>
#include <vdbcage/deform/detail/coordinate_family.h>

namespace vdbcage::detail {

/// The computation of rows of coordinates of any family, loose points included.
class RowMaker {
public:
    /// `points` must outlive this.
    /// \throw InputError as computeCoordinates, except for points where the family is not defined
    /// \throw Cancelled
    RowMaker(const Mesh& cage, const std::vector<openvdb::Vec3d>& points, const CoordinateOptions& options,
             Interrupter* interrupter);
    RowMaker(const RowMaker&) = delete;
    RowMaker& operator=(const RowMaker&) = delete;

    /// Returns the number of weights a point.
    std::size_t columns() const { return columns_; }

    /// Writes `count` rows, one after the other in `rows`, in parallel: those of the points `indices`, or of the first
    /// points if it is null. `Number` is float or double.
    /// \throw Cancelled
    template <typename Number>
    void make(const std::uint32_t* indices, std::size_t count, Number* rows);

    /// \throw InputError make() was called for a point where the family is not defined
    void requireDefined() const;

private:
    struct alignas(64) Chunk {
        std::byte bytes[64];
    };
    struct Buffers {
        std::unique_ptr<Packet[]> rows;
        std::unique_ptr<Chunk[]> scratch; ///< large, and not set to zero
    };

    unsigned makePacket(const openvdb::Vec3d* points, std::size_t count, const Buffers& buffers) const;
    template <typename Number>
    bool makeLooseRow(const openvdb::Vec3d& place, bool isDefined, Number* row) const;

    const std::vector<openvdb::Vec3d>& points_;
    const CoordinateFamily& family_;
    Interrupter* interrupter_;
    std::size_t columns_;
    UnitCage cage_;
    std::shared_ptr<const KernelCage> kernelCage_;
    CageRows rows_, meanValueRows_;
    LoosePoints::Motion looseMotion_;
    std::vector<bool> isLoose_;
    std::vector<char> undefined_; ///< by point; several threads write
};

} // namespace vdbcage::detail
