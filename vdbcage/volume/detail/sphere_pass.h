#pragma once

#include <cstdint>

#include <vdbcage/volume/detail/mask_blocks.h>
#include <vdbcage/volume/detail/progress.h>
#include <vdbcage/volume/detail/radius_field.h>
#include <vdbcage/volume/detail/simd.h>

namespace vdbcage::detail {

/// The voxels p with a voxel q of `mask` such that |p - q|^2 <= squaredRadius.
MaskTree::Ptr dilateBySphere(const MaskTree& mask, std::int64_t squaredRadius, const Progress& progress,
                             Simd simd = bestSimd());

/// The voxels p such that every q with |p - q|^2 <= squaredRadius is in `mask`. `keep`, if not null, are voxels known
/// to be in the result: no work is done on them.
MaskTree::Ptr erodeBySphere(const MaskTree& mask, const MaskTree* keep, std::int64_t squaredRadius,
                            const Progress& progress, Simd simd = bestSimd());

/// The voxels p with a voxel q of `mask` such that |p - q|^2 <= the field's square at p.
MaskTree::Ptr dilateByField(const MaskTree& mask, const RadiusField& field, const Progress& progress,
                            Simd simd = bestSimd());

/// The voxels p of `mask` such that |p - q|^2 is above the field's square at q, its radii times `factor`, for every q
/// that is not in `mask`. `keep` as above.
MaskTree::Ptr erodeByField(const MaskTree& mask, const MaskTree* keep, const RadiusField& field, double factor,
                           const Progress& progress, Simd simd = bestSimd());

} // namespace vdbcage::detail
