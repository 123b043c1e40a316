#pragma once

#include <cstdint>

#include <vdbcage/core/detail/simd.h>
#include <vdbcage/volume/detail/mask_blocks.h>
#include <vdbcage/volume/detail/progress.h>
#include <vdbcage/volume/detail/sphere/radius_field.h>

namespace vdbcage::detail {

/// Returns the voxels p with a voxel q of `mask` such that |p - q|^2 <= squaredRadius.
/// \throw Cancelled
MaskTree::Ptr dilateBySphere(const MaskTree& mask, std::int64_t squaredRadius, const Progress& progress,
                             Simd simd = bestSimd());

/// Returns the voxels p such that every q with |p - q|^2 <= squaredRadius is in `mask`. It does not examine voxels of
/// `keep`, which may be null.
/// \pre the voxels of `keep` are in the result
/// \throw Cancelled
MaskTree::Ptr erodeBySphere(const MaskTree& mask, const MaskTree* keep, std::int64_t squaredRadius,
                            const Progress& progress, Simd simd = bestSimd());

/// Returns the voxels p with a voxel q of `mask` such that |p - q|^2 <= the field's square at p.
/// \throw Cancelled
MaskTree::Ptr dilateByField(const MaskTree& mask, const RadiusField& field, const Progress& progress,
                            Simd simd = bestSimd());

/// Returns the voxels p of `mask` such that |p - q|^2 is above square(q, factor) of the field for every q outside of
/// `mask`. `keep` is as in erodeBySphere.
/// \throw Cancelled
MaskTree::Ptr erodeByField(const MaskTree& mask, const MaskTree* keep, const RadiusField& field, double factor,
                           const Progress& progress, Simd simd = bestSimd());

} // namespace vdbcage::detail
