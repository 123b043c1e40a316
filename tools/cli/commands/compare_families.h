#pragma once

#include <functional>
#include <string>

#include <tools/draw/picture.h>
#include <vdbcage/core/interrupter.h>
#include <vdbcage/deform/binding.h>
#include <vdbcage/mesh/mesh.h>

namespace vdbcage::cli {

/// A model as the families of coordinates pose it.
struct FamilyComparison {
    draw::Picture sheet; ///< a panel a family, in the order of the table, row by row, with the posed cage
    std::string table;   ///< a line a family: distortion, volume and inverted triangles, or why it has no panel
};

/// `posed` is the cage with its points moved. `optionsOf` tells with which options a family is taken.
/// \throw InputError no family can pose the model; as Binding if the cage cannot be used
/// \throw Cancelled
/// \throw DeviceError no OpenGL 4.5
FamilyComparison compareFamilies(const Mesh& cage, const Mesh& posed, const Mesh& model,
                                 const std::function<CoordinateOptions(Coordinates)>& optionsOf,
                                 Interrupter* interrupter);

} // namespace vdbcage::cli
