#pragma once

#include <string>
#include <vector>

#include <vdbcage/mesh/mesh.h>

namespace vdbcage::bench {

/// A cage as people have them: near a model, but cutting it.
struct DrawnCage {
    std::string name;
    Mesh mesh;
    double noisePercent = 0; ///< its points were moved by up to this, of the model's longest side; 0 for other defects
    double makeCpuSeconds = 0; ///< that a cage of as many faces took to be made, at effort fair; 0 if none was
};

/// Makes the same 15 cages for a model each time: made ones of all kinds with points moved by up to 1, 2, 4 and 8 % of
/// its longest side, and scaled by 0.9; a made one with a part turned back through itself; one of a coarse version of
/// the model; boxes that are too small, and a tube of four sides inside.
/// \throw InputError when no cage can be made for the model
std::vector<DrawnCage> drawnCages(const Mesh& model);

} // namespace vdbcage::bench
