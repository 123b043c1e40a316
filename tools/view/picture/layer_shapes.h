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

/// What is to be seen.
struct Shown {
    OpenedMeshPtr model;
    CageResultPtr cage;                     ///< null: none
    bool isStale = false;                   ///< it fades the cage
    std::vector<openvdb::Vec3d> cagePoints; ///< where the cage's points are; of another number: at rest
    ModelValues modelValues;                ///< that colours show; null: none
    const PosedModel* posed = nullptr;      ///< where the model is
};

/// The layers of the picture, and the ground below them, as shapes. Only what is new is made and uploaded.
class LayerShapes {
public:
    /// `isSoftware`: see ModelShape.
    LayerShapes(const gl::Api& api, bool isSoftware);

    /// What a call of show() changed.
    struct Change {
        bool any = false;
        bool model = false; ///< or where it is
    };
    /// Takes over what is to be seen. \throw DeviceError
    Change show(const Shown& shown, const ViewState& view);

    /// As of the last show().
    const ViewState& view() const { return view_; }
    /// How each is drawn, as of the last show(), from the back to the front.
    std::vector<draw::Layer> layers(bool isMoving) const;
    /// The points of what is drawn: with the ground or without.
    draw::PointSets points(const ViewState& view, bool withGround) const;
    /// The first face of a layer that the ray meets, and the section does not cut off.
    std::optional<draw::Hit> nearestHit(const draw::Ray& ray) const;
    /// What cuts off, as of the last show().
    std::optional<draw::Section> section() const;

    /// In which it all is drawn: that of the model.
    const draw::Frame& frame() const { return frame_; }
    /// Of the model, world space; without a model [-1, 1].
    const openvdb::BBoxd& box() const { return box_; }
    const GroundGrid& ground() const { return ground_; }
    const ModelShape& model() const { return model_; }
    const CageResultPtr& cage() const { return cage_; }
    /// Where the cage's points are seen, world space.
    const std::vector<openvdb::Vec3d>& cagePoints() const { return cagePoints_; }
    /// Edges of what a layer shows, 0 if it shows nothing.
    std::size_t edgeCount(LayerId layer) const;
    /// Of the distances that colours show now, world units; 0 if they show none.
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
    std::array<ShapeSlot, layerCount> slots_; ///< of all layers but the model
    ShapeSlot distances_;                     ///< the cage in colours of its distance
    GroundGrid ground_;
    ViewState view_;
    CageResultPtr cage_;
    bool isStale_ = false;
    std::vector<openvdb::Vec3d> cagePoints_;
    double largestDistance_ = 0;
};

} // namespace vdbcage::view
