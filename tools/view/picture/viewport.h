#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include <tools/draw/canvas.h>
#include <tools/draw/pick.h>
#include <tools/draw/picture.h>
#include <tools/draw/renderer.h>
#include <tools/draw/stand_in.h>
#include <tools/edit/picking.h>
#include <tools/view/jobs/cage_result.h>
#include <tools/view/jobs/posed_model.h>
#include <tools/view/picture/picture_overlay.h>

namespace vdbcage::view {

/// What a Viewport shows.
struct Shown {
    OpenedMeshPtr model;
    CageResultPtr cage;                                     ///< null: none
    bool isStale = false;                                   ///< it fades the cage
    std::vector<openvdb::Vec3d> cagePoints;                 ///< where the cage's points are; of another number: at rest
    std::shared_ptr<const std::vector<double>> modelValues; ///< that colours show, one a point; null: none
    const PosedModel* posed = nullptr;                      ///< where the model is
};

/// The picture of model, cage and what is between them. While something moves a frame has one sample a pixel and, where
/// a program on the CPU draws, a stand-in for a large model. When nothing moves, frames shifted by parts of a pixel are
/// averaged, one a call. What is seen in the end does not depend on how it came about.
///
/// Its context must be current whenever it is used, and must outlive it.
class Viewport {
public:
    /// `isSoftware`: a program on the CPU draws. \throw DeviceError
    Viewport(const gl::Api& api, bool isSoftware);

    /// \pre width > 0, height > 0 \throw DeviceError
    void resize(int width, int height);

    /// Takes over what is to be seen. Only what is new is made and uploaded. Returns whether anything changed.
    /// \throw DeviceError
    bool show(const Shown& shown, const ViewState& view);

    /// Draws a frame, if there is any left to draw. \throw DeviceError
    void draw(bool isMoving);
    /// Nothing is left to draw until something changes.
    bool isRefined() const { return frames_ == shifts; }
    /// What is to be seen was drawn once at least, if only as it is while something moves.
    bool isDrawn() const { return isDrawn_; }

    /// What is seen when nothing moves, without what others draw over it. \throw DeviceError
    draw::Picture picture();

    /// Copies what was drawn to `target`, its lower left corner to (left, bottom).
    void copyTo(GLuint framebuffer, int left, int bottom) const;

    /// In which it all is drawn: that of the model.
    const draw::Frame& frame() const { return frame_; }
    /// Of the model, world space; without a model [-1, 1].
    const openvdb::BBoxd& box() const { return box_; }
    /// Of what is shown.
    const draw::Eye& eye() const { return eye_; }
    /// Distance between two lines of the ground grid, in world space: 1, 2 or 5 times a power of ten.
    double gridStep() const { return gridStep_; }
    /// Of the distances that colours show now, world units; 0 if they show none.
    double largestDistance() const { return largestDistance_; }

    /// Edges of what a layer shows, 0 if it shows nothing.
    std::size_t edgeCount(LayerId layer) const;

    /// The camera of `view` moved to see all that is shown, or the selected faces.
    draw::Camera fitted(const ViewState& view, bool selection) const;
    /// What is seen at (x, y) of the panel, [-1, 1] both ways, y up.
    std::optional<openvdb::Vec3d> pointAt(double x, double y) const;
    /// The part of the cage, of the kind that is selected, that is within some pixels of `at` and not hidden.
    std::optional<openvdb::Index32> elementAt(const ViewState& view, const Pixel& at, double pixels);
    /// Those that are in a polygon: points, edges with both ends, faces with their middle.
    std::vector<openvdb::Index32> elementsWithin(const ViewState& view, const std::vector<Pixel>& border);
    /// The points or selected edges of the cage, for who selects them. While something `isMoved` the points are those
    /// that were seen before.
    void addElements(const ViewState& view, bool isMoved, PictureOverlay& overlay);
    /// The middle of what is selected, in drawing coordinates; none if nothing is selected.
    std::optional<openvdb::Vec3d> selectionCentre(const ViewState& view) const;

private:
    /// A shape and what it was made of.
    struct Slot {
        std::shared_ptr<const void> source; ///< kept, so that no other thing has its address
        std::optional<draw::Shape> shape;
    };

    /// Something changed: what was drawn is no longer what is to be seen.
    void restart();
    void setFrame(const OpenedMeshPtr& model);
    void fill(Slot& slot, const std::shared_ptr<const void>& source, const Mesh* mesh, double creaseDegrees);
    void fillDistances(const CageResultPtr& cage, bool isWanted);
    void fillGround(draw::UpAxis up);
    void markFaces(const CageResult& cage, const ViewState& view);
    std::vector<draw::Layer> layers(const ViewState& view, bool standIn) const;
    draw::PointSets seen(const ViewState& view) const;
    std::optional<draw::Section> section() const;
    draw::Ray rayAt(double x, double y) const;
    bool poseCage(const CageResultPtr& cage, const std::vector<openvdb::Vec3d>& points);
    bool poseModel(const OpenedMeshPtr& model, const PosedModel* posed);
    bool colourModel(const OpenedMeshPtr& model, const std::shared_ptr<const std::vector<double>>& values);
    std::vector<openvdb::Index32> selectedPoints(const ViewState& view) const;
    /// None: there is no cage to be seen.
    std::optional<edit::Picking> picking(const ViewState& view);

    static constexpr int shifts = 16; ///< frames that are averaged

    const gl::Api* api_;
    bool isSoftware_;
    draw::Renderer renderer_;
    int width_ = 0, height_ = 0;
    std::optional<draw::Canvas> canvas_;
    gl::Texture average_;
    gl::Framebuffer averageFramebuffer_;
    std::vector<std::uint16_t> sums_; ///< of each channel of the frames so far
    std::vector<std::uint8_t> means_;
    int frames_ = 0;
    bool isDrawn_ = false;

    openvdb::BBoxd box_;
    draw::Frame frame_;
    draw::Eye eye_;
    double gridStep_ = 0, largestDistance_ = 0;
    ViewState view_; ///< what is shown now
    bool isStale_ = false;
    std::vector<openvdb::Vec3d> cagePoints_; ///< as shown, world space
    CageResultPtr cage_;
    std::shared_ptr<const std::vector<double>> modelValues_;
    std::uint64_t posedVersion_ = 0;
    bool isPosed_ = false;        ///< the model's shape is not at rest
    bool hasOnlyStandIn_ = false; ///< the model's own points are not bound yet
    // Made when they are asked for.
    std::optional<edit::Elements> elements_;                     ///< of the cage
    std::optional<edit::Occluder> occluder_;                     ///< the model as it is seen
    std::optional<std::vector<openvdb::Index32>> visiblePoints_; ///< of the cage
    std::optional<std::vector<openvdb::Index32>> lastPoints_;    ///< the visible ones when nothing was moved
    std::array<Slot, layerCount> slots_;
    draw::StandIn movingModel_; ///< what is drawn while something moves; empty: the model itself
    Slot standIn_;              ///< its shape
    Slot boundStandIn_;         ///< the part of the model that is bound, as long as not all of it is
    Slot distances_, ground_;
};

} // namespace vdbcage::view
