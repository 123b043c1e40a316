#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include <vdbcage/bounding/bounding_guard.h>
#include <vdbcage/bounding/detail/triangles/recorded_decimation.h>
#include <vdbcage/bounding/face_wishes.h>
#include <vdbcage/core/detail/memo.h>
#include <vdbcage/mesh/detail/aligned_axes.h>
#include <vdbcage/pipeline/detail/stages/candidate.h>

namespace vdbcage::detail {

/// The inputs of the wishes of a run.
struct WishesKey {
    GuardOptions guard;
    FieldVersion density;
    std::vector<Joint> joints;
    double jointDensity = 0;

    bool operator==(const WishesKey& other) const;
};

/// The rules for changes of surfaces: constraints, and wishes where these leave a choice.
struct Rules {
    WishesKey key;
    std::shared_ptr<const BoundingGuard> guard;
    FaceWishes wishes;
};

/// A starting surface, kept from run to run with its decimations. Its key is turned, with kind and closing: all that
/// are kept are of the guard that rules() returned last.
struct KeptStart {
    bool turned = false; ///< its voxels lie along the model's own axes
    std::shared_ptr<const BoundingGuard> guard;
    StartingSurface surface;
    Memo<WishesKey, RecordedDecimation> decimation;
    bool isUsed = true; ///< in this run
};

/// The results of the stages of a search for one model, kept from run to run under keys: equal keys, equal values.
class StageCache {
public:
    /// The arguments must outlive this. `acrossX` is the best plane across x, where it is known.
    StageCache(const Mesh& model, Volumes& volumes, const std::optional<Symmetry>& acrossX);

    const Mesh& model() const { return model_; }
    Volumes& volumes() { return volumes_; }

    /// Returns whether the model is a sheet, in voxels that depend on no option except the interior.
    bool isSheet(const CageOptions& options, Interrupter* interrupter);
    /// Returns the best plane of those that `choice` allows. \pre it asks for one
    const Symmetry& symmetry(CageSymmetry choice, Interrupter* interrupter);
    /// Returns constraints and wishes. Forgets starts under other constraints, for memory.
    Rules rules(const CageOptions& options, const FieldVersion& density, bool ofSheet,
                const std::optional<SymmetryPlane>& plane, Interrupter* interrupter);
    /// Returns the model's own axes; where there is a plane, one is across it.
    const AlignedAxes& axes(const std::optional<SymmetryPlane>& plane, Interrupter* interrupter);
    /// Returns the longest side of the model turned to its axes(), in the model's own longest sides.
    double turnedSide(const std::optional<SymmetryPlane>& plane, Interrupter* interrupter);
    /// Returns the number of quads of the surface of a closing.
    std::size_t quadsOf(const CageOptions& options, const FieldVersion& scale, const Voxels& voxels,
                        Interrupter* interrupter);
    /// Returns a surface from which a cage may be shrunk.
    std::shared_ptr<KeptStart> keptStart(const CageOptions& options, const FieldVersion& scale, const Voxels& voxels,
                                         CageStart kind, const Rules& rules, Interrupter* interrupter);

    /// Marks all starts as unused.
    void beginRun();
    /// Forgets the starts that were not used since beginRun().
    void endRun();
    /// Forgets all starts: a step may be half done.
    void forgetStarts() { starts_.clear(); }

private:
    /// The model along its own axes.
    struct Turned {
        explicit Turned(Mesh mesh) : model(std::move(mesh)), volumes(model) {}
        const Mesh model;
        Volumes volumes;
    };
    using Axis = std::optional<int>; // across the plane of symmetry

    Turned& turnedModel(const std::optional<SymmetryPlane>& plane, Interrupter* interrupter);
    StartingSurface makeStart(const CageOptions& options, const FieldVersion& scale, const Voxels& voxels,
                              CageStart kind, const Rules& rules, Interrupter* interrupter);

    const Mesh& model_;
    Volumes& volumes_;
    Memo<SolidKey, bool> sheet_;
    Memo<CageSymmetry, Symmetry> symmetry_;
    Memo<GuardOptions, std::shared_ptr<const BoundingGuard>> guard_;
    Memo<WishesKey, FaceWishes> wishes_;
    Memo<Axis, AlignedAxes> axes_;
    Memo<Axis, std::unique_ptr<Turned>> turned_;
    Memo<ClosingKey, std::shared_ptr<const Mesh>> closingSurface_; // until a start is made from it
    std::vector<std::pair<ClosingKey, std::size_t>> quads_;        // of surfaces, of many runs
    std::vector<std::shared_ptr<KeptStart>> starts_;
};

} // namespace vdbcage::detail
