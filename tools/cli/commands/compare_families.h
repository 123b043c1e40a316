#pragma once

#include <functional>
#include <string>

#include <tools/draw/picture.h>
#include <vdbcage/core/interrupter.h>
#include <vdbcage/deform/binding.h>
#include <vdbcage/mesh/mesh.h>

namespace vdbcage::cli {

/// A model posed by each of the families of coordinates.
struct FamilyComparison {
    draw::Picture sheet; ///< a panel for each family, in the order of the table, row by row, with the posed cage
    std::string table;   ///< a line for each family: distortion, volume and inverted triangles, or the reason why it
                         ///< has no panel
};

/// Poses the model by each family and draws it. `posed` is the cage with its points moved. `optionsOf` returns the
/// options of a family.
/// \throw InputError no family can pose the model; as Binding if the cage cannot be used
/// \throw Cancelled
/// \throw DeviceError no OpenGL 4.5
FamilyComparison compareFamilies(const Mesh& cage, const Mesh& posed, const Mesh& model,
                                 const std::function<CoordinateOptions(Coordinates)>& optionsOf,
                                 Interrupter* interrupter);

} // namespace vdbcage::cli
