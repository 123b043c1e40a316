#pragma once

#include <optional>

#include <vdbcage/core/export.h>
#include <vdbcage/core/interrupter.h>
#include <vdbcage/mesh/mesh.h>

namespace vdbcage {

/// A plane across an axis.
struct SymmetryPlane {
    int axis = 0;      ///< 0, 1, 2: x, y, z
    double offset = 0; ///< of its points along the axis, world units

    /// Returns whether axis and offset are exactly the same.
    bool operator==(const SymmetryPlane& other) const { return axis == other.axis && offset == other.offset; }
};

/// The agreement of a model with its mirror image.
struct Symmetry {
    SymmetryPlane plane; ///< in which the model is mirrored
    /// Fraction of the model's longest side: almost all of the surface (99 % of its area) is no farther than this from
    /// its mirror image.
    double deviation = 0;
};

/// Returns the plane across an axis in which the model agrees best with its mirror image.
///
/// The search begins in the middle of the model's bounding box. It moves the plane to where mirrored samples of the
/// surface lie on the surface as well as can be.
/// \param model any polygon soup
/// \param axis 0, 1, 2: x, y, z
/// \param interrupter asked whether to stop; may be null
/// \throw InputError when `axis` is out of range, or requireUsable() refuses the model
/// \throw Cancelled when the interrupter asks to stop
/// Cost: O(faces log faces), in parallel.
/// Based on: Besl and McKay, A Method for Registration of 3-D Shapes, 1992 (nearest points as counterparts).
VDBCAGE_API Symmetry bestSymmetry(const Mesh& model, int axis, Interrupter* interrupter = nullptr);

/// The agreement of a model with its mirror image in a plane of any direction.
struct TiltedSymmetry {
    openvdb::Vec3d normal{1, 0, 0}; ///< of length 1; its largest component is positive
    double offset = 0;              ///< of the plane's points along the normal, world units
    double deviation = 0;           ///< as Symmetry
};

/// Returns the plane of any direction in which the model agrees best with its mirror image.
///
/// Planes through the centroid of the surface, in 500 directions and across its principal axes, are compared by a few
/// samples. Those that agree best are moved and turned to where mirrored samples lie on the surface as well as can be.
/// \param model any polygon soup
/// \param interrupter asked whether to stop; may be null
/// \throw InputError when requireUsable() refuses the model
/// \throw Cancelled when the interrupter asks to stop
/// Cost: O(faces log faces), in parallel; some ten times bestSymmetry().
/// Based on: Besl and McKay, 1992. Podolak, Shilane, Golovinskiy, Rusinkiewicz, Funkhouser, A Planar-Reflective
/// Symmetry Transform for 3D Shapes, 2006 (a look at all directions, then refinement).
VDBCAGE_API TiltedSymmetry bestTiltedSymmetry(const Mesh& model, Interrupter* interrupter = nullptr);

/// Returns the best plane of the three axes, if its deviation is small enough.
/// \param model any polygon soup
/// \param tolerance largest deviation, fraction of the model's longest side
/// \param interrupter asked whether to stop; may be null
/// \throw InputError when requireUsable() refuses the model
/// \throw Cancelled when the interrupter asks to stop
VDBCAGE_API std::optional<Symmetry> findSymmetry(const Mesh& model, double tolerance,
                                                 Interrupter* interrupter = nullptr);

} // namespace vdbcage
