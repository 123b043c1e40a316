#pragma once

#include <optional>
#include <vector>

#include <tools/edit/picking.h>
#include <tools/view/picture/layer_shapes.h>
#include <tools/view/picture/picture_overlay.h>
#include <vdbcage/core/detail/memo.h>

namespace vdbcage::view {

/// A search for points, edges and faces of the cage by their places in the picture. It keeps data for the next call
/// until it is told to forget it.
class CagePicker {
public:
    /// The picture to pick in; pixels count from its top left.
    struct Picture {
        const LayerShapes& shapes;
        draw::Eye eye;
        int width, height;
    };

    /// Returns the visible element of the selected kind within some pixels of `place`.
    std::optional<openvdb::Index32> at(const Picture& picture, const ViewState& view, const Pixel& place,
                                       double pixels);
    /// Returns the elements in a polygon: points, edges with both ends in it, faces with their middle in it.
    std::vector<openvdb::Index32> within(const Picture& picture, const ViewState& view,
                                         const std::vector<Pixel>& border);
    /// Adds the points or the selected edges to the overlay, whichever kind is selected, and locked points (ascending)
    /// with each kind. If `isMoved`, the points are those that were visible before the motion.
    void addElements(const Picture& picture, const ViewState& view, const std::vector<openvdb::Index32>& locked,
                     bool isMoved, PictureOverlay& overlay);

    void forgetModel() { occluder_.reset(); }
    void forgetVisible() { visiblePoints_.reset(); }

private:
    /// Returns a picker; none: no cage is visible.
    std::optional<edit::Picking> picking(const Picture& picture, const ViewState& view);
    const edit::Elements& elements(const CageResultPtr& cage);

    vdbcage::detail::Memo<CageResultPtr, edit::Elements> elements_;
    std::optional<edit::Occluder> occluder_;                     ///< the model as shown
    std::optional<std::vector<openvdb::Index32>> visiblePoints_; ///< of the cage
    std::optional<std::vector<openvdb::Index32>> lastPoints_;    ///< the visible ones before the motion
};

} // namespace vdbcage::view
