#pragma once

#include <array>
#include <optional>
#include <vector>

#include <tools/draw/pick.h>
#include <tools/draw/renderer.h>
#include <tools/edit/elements.h>
#include <tools/view/jobs/cage_result.h>
#include <tools/view/picture/ground_grid.h>
#include <tools/view/picture/model_shape.h>

namespace vdbcage::view {

/// The content of the picture.
struct PictureContent {
    OpenedMeshPtr model;
    CageResultPtr cage;                     ///< null: none
    bool isStale = false;                   ///< it fades the cage
    std::vector<openvdb::Vec3d> cagePoints; ///< points of the cage; if their number differs from its own: it is at rest
    ModelValues modelValues;                ///< shown by colours; null: none
    const PosedModel* posed = nullptr;      ///< the posed model; null or unbound: at rest
};

/// The layers of the picture, and the ground below them, as shapes. Only new parts are made and uploaded.
class LayerShapes {
public:
    /// `isSoftware`: see ModelShape.
    LayerShapes(const gl::Api& api, bool isSoftware);

    /// The changes of a call of show().
    struct Change {
        bool any = false;
        bool model = false; ///< the model or its points
    };
    /// Takes new content. \throw DeviceError
    Change show(const PictureContent& content, const ViewState& view);

    /// Returns the view of the last show().
    const ViewState& view() const { return view_; }
    /// Returns the layers of the last show() and how to draw them, from back to front.
    std::vector<draw::Layer> layers(bool isMoving) const;
    /// Returns the points of the drawn shapes, with the ground or without it.
    draw::PointSets points(const ViewState& view, bool withGround) const;
    /// Returns the first point where the ray meets a face that the section does not cut off.
    std::optional<draw::Hit> nearestHit(const draw::Ray& ray) const;
    /// Returns the section plane of the last show().
    std::optional<draw::Section> section() const;

    /// Returns the frame of all shapes: the model's.
    const draw::Frame& frame() const { return frame_; }
    /// Returns the model's box in world space; [-1, 1] if there is no model.
    const openvdb::BBoxd& box() const { return box_; }
    const GroundGrid& ground() const { return ground_; }
    const ModelShape& model() const { return model_; }
    const CageResultPtr& cage() const { return cage_; }
    /// Returns the drawn positions of the cage's points, world space.
    const std::vector<openvdb::Vec3d>& cagePoints() const { return cagePoints_; }
    /// Returns the number of edges that a layer shows, 0 if it shows nothing.
    std::size_t edgeCount(LayerId layer) const;
    /// Returns the largest of the distances that colours show now, in world units; 0 if they show none.
    double largestDistance() const { return largestDistance_; }

private:
    void setModel(const OpenedMeshPtr& model);
    bool fillLayer(LayerId id, const CageResultPtr& cage, const ViewState& view);
    bool poseCage(const std::vector<openvdb::Vec3d>& points);
    bool fillDistances(const CageResultPtr& cage, bool isWanted);
    void markFaces(const CageResult& cage, const edit::Selection& selection);
    void addCage(draw::Layer layer, std::vector<draw::Layer>& list) const;
    const std::optional<draw::Shape>& shape(LayerId id) const;
    /// \pre not the model's
    ShapeSlot& slot(LayerId id) { return slots_[static_cast<std::size_t>(id)]; }

    const gl::Api* api_;
    openvdb::BBoxd box_;
    draw::Frame frame_;
    ModelShape model_;
    std::array<ShapeSlot, layerCount> slots_; ///< of all layers except the model
    ShapeSlot distances_;                     ///< the cage coloured by its distance
    GroundGrid ground_;
    ViewState view_;
    CageResultPtr cage_;
    bool isStale_ = false;
    std::vector<openvdb::Vec3d> cagePoints_;
    double largestDistance_ = 0;
};

} // namespace vdbcage::view
