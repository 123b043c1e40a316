#pragma once

#include <vdbcage/core/export.h>
#include <vdbcage/core/interrupter.h>
#include <vdbcage/mesh/mesh.h>

namespace vdbcage {

/// The rule that decides on the inside of a model with holes.
enum class Interior {
    automatic, ///< shell where rays mostly disagree, as they do about sheets (leastAgreement), else solid
    solid,     ///< all that most rays count as inside: a bowl is filled to its rim
    shell      ///< only the places that the faces enclose without a gap: a bowl is its wall
};

/// Returns the share of rays that agree from both ends which side of the model is inside, 0 to 1.
///
/// 65 times 65 rays run along each axis through the box of the model, 1/64 of its longest side apart. Those that cross
/// no face do not count. One agrees if it crosses an even number of faces. The share is 1 for closed models, also of
/// several parts that meet. It is about 0 for a sheet, 0.5 for a hemisphere, and 0.9 for a statue without its base. It
/// is 1 where no ray meets the model.
/// \param model any polygon soup
/// \param interrupter asked whether to stop; may be null
/// \throw InputError when requireUsable() or voxelize() refuses the model
/// \throw Cancelled when the interrupter asks to stop
/// Cost: O(faces + rays crossed).
/// Based on: Nooruddin and Turk, Simplification and Repair of Polygonal Models Using Volumetric Techniques, 2003.
VDBCAGE_API double rayAgreement(const Mesh& model, Interrupter* interrupter = nullptr);

/// The least rayAgreement() for which Interior::automatic takes the solid.
constexpr double leastAgreement = 0.3;

} // namespace vdbcage
