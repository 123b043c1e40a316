#pragma once

/// \file The whole public interface of vdbcage.

#include <vdbcage/bounding/bounding_guard.h>
#include <vdbcage/bounding/decimate.h>
#include <vdbcage/bounding/effort.h>
#include <vdbcage/bounding/near_coplanar.h>
#include <vdbcage/bounding/smooth.h>
#include <vdbcage/bounding/tighten.h>
#include <vdbcage/bounding/triquad.h>
#include <vdbcage/check/check.h>
#include <vdbcage/core/error.h>
#include <vdbcage/core/export.h>
#include <vdbcage/core/interrupter.h>
#include <vdbcage/core/version.h>
#include <vdbcage/deform/binding.h>
#include <vdbcage/deform/inversions.h>
#include <vdbcage/deform/weights_io.h>
#include <vdbcage/mesh/mesh.h>
#include <vdbcage/mesh/mesh_io.h>
#include <vdbcage/mesh/symmetry.h>
#include <vdbcage/mesh/topology.h>
#include <vdbcage/pipeline/options.h>
#include <vdbcage/pipeline/pipeline.h>
#include <vdbcage/surface/decimate.h>
#include <vdbcage/surface/repair.h>
#include <vdbcage/surface/smooth.h>
#include <vdbcage/surface/triquad.h>
#include <vdbcage/volume/boundary_voxels.h>
#include <vdbcage/volume/cavities.h>
#include <vdbcage/volume/convex_hull.h>
#include <vdbcage/volume/extract.h>
#include <vdbcage/volume/mirror.h>
#include <vdbcage/volume/morphology.h>
#include <vdbcage/volume/scale_field.h>
#include <vdbcage/volume/vdb_io.h>
#include <vdbcage/voxelize/voxelize.h>
