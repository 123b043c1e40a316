#pragma once

#include <optional>
#include <vector>

#include <tools/view/picture/averaged_canvas.h>
#include <tools/view/picture/cage_picker.h>
#include <tools/view/picture/layer_shapes.h>

namespace vdbcage::view {

/// The picture of model, cage and what is between them (see AveragedCanvas, LayerShapes, CagePicker). What is seen in
/// the end does not depend on how it came about.
///
/// Its context must be current whenever it is used, and must outlive it.
class Viewport {
public:
    /// `isSoftware`: a program on the CPU draws. \throw DeviceError
    Viewport(const gl::Api& api, bool isSoftware);

    /// \pre width > 0, height > 0 \throw DeviceError
    void resize(int width, int height);

    /// Takes over what is to be seen. Returns whether anything changed. \throw DeviceError
    bool show(const Shown& shown, const ViewState& view);

    /// Draws a frame, if there is any left to draw. \throw DeviceError
    void draw(bool isMoving);
    /// What is seen when nothing moves, without what others draw over it. \throw DeviceError
    draw::Picture picture();
    const AveragedCanvas& canvas() const { return canvas_; }

    const LayerShapes& shapes() const { return shapes_; }
    /// Of what is shown.
    const draw::Eye& eye() const { return eye_; }

    /// The camera of `view` moved to see all that is shown, or the selected faces.
    draw::Camera fitted(const ViewState& view, bool selection) const;
    /// What is seen at (x, y) of the panel, [-1, 1] both ways, y up.
    std::optional<openvdb::Vec3d> pointAt(double x, double y) const;
    /// The middle of what is selected, in drawing coordinates; none if nothing is selected.
    std::optional<openvdb::Vec3d> selectionCentre(const ViewState& view) const;

    /// See CagePicker.
    std::optional<openvdb::Index32> elementAt(const ViewState& view, const Pixel& at, double pixels);
    std::vector<openvdb::Index32> elementsWithin(const ViewState& view, const std::vector<Pixel>& border);
    void addElements(const ViewState& view, bool isMoved, PictureOverlay& overlay);

private:
    /// Something changed: what was drawn is no longer what is to be seen.
    void restart();
    double aspect() const { return 1.0 * canvas_.width() / canvas_.height(); }
    /// Those of the cage that are selected, or belong to what is; in drawing coordinates.
    std::vector<openvdb::Vec3d> selectedPoints(const ViewState& view) const;
    CagePicker::Picture pickedPicture() const { return {shapes_, eye_, canvas_.width(), canvas_.height()}; }

    draw::Renderer renderer_;
    AveragedCanvas canvas_;
    LayerShapes shapes_;
    CagePicker picker_;
    draw::Eye eye_;
};

} // namespace vdbcage::view
