#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include <tools/view/picture/gizmo.h>

namespace vdbcage::view {

/// The overlay of the picture for editing. Pixels count from the picture's top left.
struct PictureOverlay {
    struct Point {
        Pixel at;
        bool isSelected = false, isLocked = false;
    };
    std::vector<Point> points;               ///< of the cage: all if points are selected, else the locked ones
    std::vector<std::array<Pixel, 2>> edges; ///< the selected ones
    std::vector<GizmoPart> gizmo;
    std::optional<Handle> hot; ///< the handle under the pointer
    std::vector<Pixel> band;   ///< the border of a box or lasso that is being drawn
    std::string hint;          ///< the motion under way and its amount
};

} // namespace vdbcage::view
