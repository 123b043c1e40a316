#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <openvdb/Types.h>
#include <vdbcage/core/interrupter.h>
#include <vdbcage/mesh/mesh.h>
#include <vdbcage/voxelize/detail/face_scan.h>
#include <vdbcage/voxelize/detail/frame.h>

namespace vdbcage::detail {

/// The triangles of a model on the lattice, and for each slab of planes along x a list of those that enter it. Lists
/// are in the order of the faces. Quads are split along both diagonals.
class SlabbedTriangles {
public:
    /// Makes slabs of `slabThickness` planes; the last may have fewer.
    /// \throw Cancelled
    /// Cost: O(faces + slabs entered by faces), in parallel.
    SlabbedTriangles(const Mesh& model, const Frame& frame, int slabThickness, Interrupter* interrupter);

    int slabCount() const { return slabCount_; }
    int slabThickness() const { return slabThickness_; }
    Span planes(int slab) const;

    /// Returns the number of triangles that enter the slab.
    std::size_t size(int slab) const { return begins_[index(slab) + 1] - begins_[index(slab)]; }
    /// Returns the i-th of them.
    LatticeTriangle triangle(int slab, std::size_t i) const
    {
        const openvdb::Vec3I& face = faces_[members_[begins_[index(slab)] + i]];
        return {{points_[face[0]], points_[face[1]], points_[face[2]]}};
    }
    /// Returns whether its crossings count. Those of a quad count under one of its diagonals only.
    bool counted(int slab, std::size_t i) const { return members_[begins_[index(slab)] + i] < counted_; }

private:
    static std::size_t index(int slab) { return static_cast<std::size_t>(slab); }
    Span slabsOf(const openvdb::Vec3I& face) const;
    void sortIntoSlabs(Interrupter* interrupter);

    std::vector<openvdb::Vec3i> points_; ///< lattice units, counted from the centre of the grid's first voxel
    std::vector<openvdb::Vec3I> faces_;
    std::size_t counted_; ///< the number of faces, the first ones, that count for parity
    int slabThickness_, slabCount_, planes_;
    std::vector<std::size_t> begins_; ///< by slab
    std::vector<std::uint32_t> members_;
};

} // namespace vdbcage::detail
