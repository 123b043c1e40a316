#pragma once

#include <optional>
#include <vector>

#include <tools/view/picture/averaged_canvas.h>
#include <tools/view/picture/cage_picker.h>
#include <tools/view/picture/layer_shapes.h>

namespace vdbcage::view {

/// The picture of model, cage and the stages between them (see AveragedCanvas, LayerShapes, CagePicker). The final
/// picture does not depend on the calls before.
///
/// Its context must be current in each call, and must outlive it.
class Viewport {
public:
    /// `isSoftware`: the CPU draws. \throw DeviceError
    Viewport(const gl::Api& api, bool isSoftware);

    /// \pre width > 0, height > 0 \throw DeviceError
    void resize(int width, int height);

    /// Takes new content. Returns whether anything changed. \throw DeviceError
    bool show(const PictureContent& content, const ViewState& view);

    /// Draws a frame, if there is any left to draw. \throw DeviceError
    void draw(bool isMoving);
    /// Returns the picture at rest, without overlays. \throw DeviceError
    draw::Picture picture();
    const AveragedCanvas& canvas() const { return canvas_; }

    const LayerShapes& shapes() const { return shapes_; }
    /// Returns the eye of the shown picture.
    const draw::Eye& eye() const { return eye_; }

    /// Returns the camera of `view`, moved to see all of the picture, or the selection if there is one.
    draw::Camera fitted(const ViewState& view, bool selection) const;
    /// Returns the visible point of a layer at (x, y) of the panel, [-1, 1] both ways, y up.
    std::optional<openvdb::Vec3d> pointAt(double x, double y) const;
    /// Returns the mean of the selected points, in drawing coordinates; none if nothing is selected.
    std::optional<openvdb::Vec3d> selectionCentre(const ViewState& view) const;

    /// See CagePicker.
    std::optional<openvdb::Index32> elementAt(const ViewState& view, const Pixel& at, double pixels);
    std::vector<openvdb::Index32> elementsWithin(const ViewState& view, const std::vector<Pixel>& border);
    void addElements(const ViewState& view, const std::vector<openvdb::Index32>& locked, bool isMoved,
                     PictureOverlay& overlay);

private:
    /// Notes a change: the picture must be drawn again.
    void restart();
    double aspect() const { return 1.0 * canvas_.width() / canvas_.height(); }
    /// Returns the points of the cage that are selected or belong to selected elements, in drawing coordinates.
    std::vector<openvdb::Vec3d> selectedPoints(const ViewState& view) const;
    CagePicker::Picture pickedPicture() const { return {shapes_, eye_, canvas_.width(), canvas_.height()}; }

    draw::Renderer renderer_;
    AveragedCanvas canvas_;
    LayerShapes shapes_;
    CagePicker picker_;
    draw::Eye eye_;
};

} // namespace vdbcage::view
