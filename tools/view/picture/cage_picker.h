#pragma once

#include <optional>
#include <vector>

#include <tools/edit/picking.h>
#include <tools/view/picture/layer_shapes.h>
#include <tools/view/picture/picture_overlay.h>
#include <vdbcage/core/detail/memo.h>

namespace vdbcage::view {

/// Finds points, edges and faces of the cage by where they are seen in the picture. It keeps what the next question
/// needs too, until that is forgotten.
class CagePicker {
public:
    /// The picture; pixels count from its top left.
    struct Picture {
        const LayerShapes& shapes;
        draw::Eye eye;
        int width, height;
    };

    /// The element of the kind that is selected that is within some pixels of `at` and not hidden.
    std::optional<openvdb::Index32> at(const Picture& picture, const ViewState& view, const Pixel& place,
                                       double pixels);
    /// Those that are in a polygon: points, edges with both ends, faces with their middle.
    std::vector<openvdb::Index32> within(const Picture& picture, const ViewState& view,
                                         const std::vector<Pixel>& border);
    /// Adds the points or the selected edges, for who selects them. While something `isMoved` the points are those that
    /// were seen before.
    void addElements(const Picture& picture, const ViewState& view, bool isMoved, PictureOverlay& overlay);

    void forgetModel() { occluder_.reset(); }
    void forgetVisible() { visiblePoints_.reset(); }

private:
    /// None: there is no cage to be seen.
    std::optional<edit::Picking> picking(const Picture& picture, const ViewState& view);
    const edit::Elements& elements(const CageResultPtr& cage);

    vdbcage::detail::Memo<CageResultPtr, edit::Elements> elements_;
    std::optional<edit::Occluder> occluder_;                     ///< the model as it is seen
    std::optional<std::vector<openvdb::Index32>> visiblePoints_; ///< of the cage
    std::optional<std::vector<openvdb::Index32>> lastPoints_;    ///< the visible ones when nothing was moved
};

} // namespace vdbcage::view
