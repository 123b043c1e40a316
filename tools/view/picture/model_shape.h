#pragma once

#include <memory>
#include <optional>

#include <tools/draw/shape.h>
#include <tools/draw/stand_in.h>
#include <tools/view/jobs/model_values.h>
#include <tools/view/posing/posed_model.h>

namespace vdbcage::view {

/// A shape and its source. It is made again only for another source.
struct ShapeSlot {
    std::shared_ptr<const void> source; ///< kept, so that no other object has its address
    std::optional<draw::Shape> shape;   ///< none: there is nothing to draw

    /// Makes the shape of `mesh`, which belongs to `from`; null: no shape. \throw DeviceError
    void fill(const gl::Api& api, const draw::Frame& frame, const std::shared_ptr<const void>& from, const Mesh* mesh,
              double creaseDegrees)
    {
        shape.reset();
        if (mesh && faceCount(*mesh) > 0) shape.emplace(api, draw::Geometry(*mesh, frame, creaseDegrees));
        source = from;
    }
};

/// The model as drawn: at rest or posed, coloured by values, or by a stand-in for it.
class ModelShape {
public:
    /// `isSoftware`: the CPU draws; while something moves, a large model is drawn by a stand-in.
    ModelShape(const gl::Api& api, bool isSoftware) : api_(&api), isSoftware_(isSoftware) {}

    /// Set the model, pose or colours. Each returns whether anything changed. \throw DeviceError
    bool show(const OpenedMeshPtr& model, const draw::Frame& frame);
    bool pose(const OpenedMeshPtr& model, const PosedModel* posed, const draw::Frame& frame);
    bool colour(const OpenedMeshPtr& model, const ModelValues& values);

    /// Forgets everything, as for another frame.
    void clear() { *this = ModelShape(*api_, isSoftware_); }

    /// Returns the model's own shape.
    const std::optional<draw::Shape>& shape() const { return model_.shape; }
    const std::shared_ptr<const void>& source() const { return model_.source; }
    /// Returns the shape to draw: a stand-in while not all points of the model are bound, or for a large one while
    /// something moves.
    const std::optional<draw::Shape>& drawn(bool isMoving) const;
    bool isDrawnInValues() const { return values_ && !hasOnlyStandIn_; }

private:
    const gl::Api* api_;
    bool isSoftware_;
    ShapeSlot model_;
    draw::StandIn movingModel_;   ///< drawn while something moves; empty: the model itself is
    ShapeSlot movingShape_;       ///< its shape
    ShapeSlot boundStandInShape_; ///< until all points of the model are bound
    ModelValues values_;
    std::uint64_t posedVersion_ = 0;
    bool isPosed_ = false;        ///< the shape is not at rest
    bool hasOnlyStandIn_ = false; ///< the model's own points are not bound yet
};

} // namespace vdbcage::view
