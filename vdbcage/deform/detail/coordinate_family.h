#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include <openvdb/Types.h>
#include <vdbcage/core/interrupter.h>
#include <vdbcage/deform/coordinates.h>
#include <vdbcage/deform/detail/kernels/row_kernels.h>
#include <vdbcage/deform/detail/unit_cage.h>

namespace vdbcage::detail {

using Packet = double[packetSize]; ///< one number for each of several points

/// Functions that compute rows of coordinates in one cage, which must outlive this, on any number of threads. One of
/// the two is set.
struct CageRows {
    /// Writes the row of the scaled point `x`. Returns false where the family is not defined.
    std::function<bool(const openvdb::Vec3d& x, double* row)> one;
    /// Writes the rows of `count` points, at most `packetSize`: number k of point i to rows[k][i]. Returns a bit for
    /// each point where the family is not defined. A row depends on its own point only.
    std::function<unsigned(const openvdb::Vec3d* points, std::size_t count, Packet* rows)> several = nullptr;
};

/// Returns the CageRows of a formula that needs only the cage: `row` is their CageRows::one.
template <bool (*row)(const UnitCage& cage, const openvdb::Vec3d& x, double* row)>
CageRows formulaRows(const UnitCage& cage, const CoordinateOptions& /*options*/, Interrupter* /*interrupter*/)
{
    return {[&cage](const openvdb::Vec3d& x, double* to) { return row(cage, x, to); }};
}

/// The handles that are vectors. They come after the points in each row: see cageHandles().
struct VectorHandles {
    std::size_t perTriangle = 0, perQuad = 0;
    /// Appends them to `handles`.
    void (*add)(const Mesh& cage, const std::vector<openvdb::Vec3d>& posed, const CoordinateOptions& options,
                std::vector<openvdb::Vec3d>& handles) = nullptr;
    /// Appends to `reach` about how far each of them may move, in longest sides of the cage.
    void (*addReach)(const Mesh& cage, std::vector<float>& reach) = nullptr;
};

/// The parts of a family of coordinates that differ from the others. Each family has a file in families/.
struct CoordinateFamily {
    FamilyInfo info;
    /// Prepares the computation of rows. Null: the family cannot be computed. If info.splitsQuads, `cage` must have
    /// triangles only.
    /// \throw InputError the family cannot take the cage or the options
    /// \throw Cancelled
    CageRows (*rowsIn)(const UnitCage& cage, const CoordinateOptions& options, Interrupter* interrupter);
    RowKernels::Rows* RowKernels::*kernel = nullptr; ///< faster than CageRows::one, which computes the rows left out
    VectorHandles vectors = {};                      ///< none, if handles are points only
};

/// Returns the family of a value. families/families.cpp has the list.
const CoordinateFamily& coordinateFamily(Coordinates family);

/// Returns the names of all that can be computed: "mvc, green".
std::string familyNames();

} // namespace vdbcage::detail
