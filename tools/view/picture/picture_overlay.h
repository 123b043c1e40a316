#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include <tools/view/picture/gizmo.h>

namespace vdbcage::view {

/// What is drawn over the picture for who edits it. Pixels count from the picture's top left.
struct PictureOverlay {
    struct Point {
        Pixel at;
        bool isSelected = false;
    };
    std::vector<Point> points;               ///< of the cage, where points are selected
    std::vector<std::array<Pixel, 2>> edges; ///< that are selected
    std::vector<GizmoPart> gizmo;
    std::optional<Handle> hot; ///< of the gizmo, under the pointer
    std::vector<Pixel> band;   ///< the border of a box or lasso that is being drawn
    std::string hint;          ///< what is under way, and by how much
};

} // namespace vdbcage::view
