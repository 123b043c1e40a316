#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <vdbcage/bounding/bounding_guard.h>
#include <vdbcage/mesh/detail/aligned_axes.h>
#include <vdbcage/pipeline/detail/candidate.h>
#include <vdbcage/pipeline/detail/certifier.h>
#include <vdbcage/pipeline/detail/search.h>

namespace vdbcage::detail {

class TiltedSearch;

/// Looks for the bounding cage: shrinks surfaces under the guard, in the order of search.h, until one is certified.
///
/// What several runs share is kept between them: the guard, the plane of symmetry, and starting surfaces with their
/// decimations.
class BoundingSearch {
public:
    /// The first three must outlive this. `acrossX` is the best plane across x, where it is known. Surfaces of more
    /// than `largeSurface` faces are decimated one after the other, and nothing is recorded of it: that takes a third
    /// of the memory, and as much time again in each run. The cages are the same.
    BoundingSearch(const Mesh& model, Volumes& volumes, Certifier& certifier,
                   const std::optional<Symmetry>& acrossX = {}, std::size_t largeSurface = policy::largeSurface);
    ~BoundingSearch();

    /// A certified cage, or the model's bounding box with its verdict. It can be called again after any exception.
    /// \throw InputError as Pipeline::run
    /// \throw DeviceError
    /// \throw Cancelled
    Candidate run(const CageOptions& options, const ScaleVersion& scale, const ScaleVersion& density,
                  Interrupter* interrupter);

private:
    /// What stays the same in one run.
    struct Run {
        const CageOptions& options;
        const ScaleVersion &scale, &density;
        Interrupter* interrupter;
        bool isSheet = false; ///< the model
        double share = 1;     ///< shareOfSide()
    };
    using Candidates = std::vector<Candidate>;
    /// The model along its own axes.
    struct Turned {
        explicit Turned(Mesh mesh) : model(std::move(mesh)), volumes(model) {}
        const Mesh model;
        Volumes volumes;
    };

    bool isModelSheet(const Run& run);
    Candidate find(const Run& run);
    std::optional<Candidate> findSymmetric(const Run& run, std::string& objection);
    std::optional<Candidate> findTilted(const Run& run, std::string& objection);
    const Symmetry& planeFor(const Run& run);
    const BoundingGuard& guardFor(const Run& run, const std::optional<SymmetryPlane>& plane);
    std::optional<Candidate> tightest(const Run& run, const std::optional<SymmetryPlane>& plane);
    std::optional<Candidate> tightestOfCompeting(const Run& run, const BoundingGuard& guard);
    std::optional<Candidate> climb(const Run& run, const BoundingGuard& guard);
    const AlignedAxes& axesFor(const Run& run, const BoundingGuard& guard);
    Turned& turnedModel();
    Candidates startsFrom(const Run& run, const Voxels& voxels, const BoundingGuard& guard);
    int resolutionFor(const Run& run, const Voxels& voxels);
    double shareFor(const Run& run, const BoundingGuard& guard);
    std::size_t quadsOf(const Run& run, const Voxels& voxels);
    Candidates simpleSolids(const Run& run, const BoundingGuard& guard);
    Candidate begin(const Run& run, const Voxels& voxels, CageStart kind, const BoundingGuard& guard);
    std::optional<Candidate> shrinkOnto(const Run& run, Candidates starts, const BoundingGuard& guard);
    void collapseLoops(const Run& run, Candidates& starts, const BoundingGuard& guard) const;
    void decimateAndTighten(const Run& run, Candidates& starts, const BoundingGuard& guard) const;
    bool isLarge(const Candidate& candidate) const { return faceCount(*candidate.surface) > largeSurface_; }
    template <typename Change>
    void forEachSurface(Candidates& candidates, Interrupter* interrupter, StageName name, const Change& change) const;
    std::optional<Candidate> tightestCertified(const Run& run, Candidates candidates, const BoundingGuard& guard);
    Candidate box(const Run& run, const BoundingGuard& guard);

    const Mesh& model_;
    Volumes& volumes_;
    Certifier& certifier_;
    const std::size_t largeSurface_;                  // faces
    CageSymmetry soughtSymmetry_ = CageSymmetry::off; // what was asked for `symmetry_`; off: nothing yet
    Symmetry symmetry_;
    std::unique_ptr<TiltedSearch> tilted_;       // once a plane in another direction was looked for
    std::unique_ptr<const BoundingGuard> guard_; // of the last run
    GuardOptions guardOptions_;                  // that it was made with
    ScaleVersion density_;                       // the same
    std::optional<AlignedAxes> axes_;            // the model's own, under the guard's plane, once they were asked for
    std::unique_ptr<Turned> turned_;             // once it was asked for
    struct Sheet {
        SolidKey key;
        bool isOne = false;
    };
    std::optional<Sheet> sheet_; // whether the model is one, in the voxels that were last asked about
    struct Counted {
        ClosingKey key;
        std::size_t quads = 0;
    };
    std::optional<double> largestPart_;                    // of the longest side, once it was asked for
    std::vector<Counted> counted_;                         // closings whose faces were counted
    std::vector<std::shared_ptr<StartingSurface>> starts_; // of the last run, under guard_
};

} // namespace vdbcage::detail
