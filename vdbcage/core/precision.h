#pragma once

namespace vdbcage {

/// The type of the numbers that hold the coordinates of a cage.
enum class Precision {
    automatic, ///< float32 where rounding to it is below 1e-5 of the model's longest side, else float64
    float32,   ///< as in STL files, Blender and most game engines
    float64    ///< as in OBJ, OFF and PLY files
};

} // namespace vdbcage
