#pragma once

#include <vector>

#include <vdbcage/deform/detail/bound_cage.h>
#include <vdbcage/deform/detail/kernels/packed_cage.h>

namespace vdbcage::detail {

/// Holds what a PackedCage points to.
class CagePack {
public:
    /// `cage` must outlive this.
    explicit CagePack(const BoundCage& cage);
    CagePack(const CagePack&) = delete;
    CagePack& operator=(const CagePack&) = delete;

    const PackedCage& packed() const { return packed_; }

private:
    struct Place {
        double at[3];
    };
    std::vector<Place> points_, restoring_, normals_;
    std::vector<PackedEdge> edges_;
    std::vector<PackedTriangle> triangles_;
    std::vector<PackedQuad> quads_;
    PackedRules rules_;
    PackedCage packed_;
};

} // namespace vdbcage::detail
