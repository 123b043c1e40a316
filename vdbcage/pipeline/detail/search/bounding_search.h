#pragma once

#include <cstddef>
#include <memory>
#include <optional>

#include <vdbcage/pipeline/detail/search_policy.h>
#include <vdbcage/pipeline/detail/stages/candidate.h>
#include <vdbcage/pipeline/detail/stages/certifier.h>
#include <vdbcage/pipeline/detail/stages/volumes.h>

namespace vdbcage::detail {

class StageCache;
class TiltedSearch;

/// The search for a bounding cage: it shrinks surfaces under the guard, in the order of a SearchPlan, until one is
/// certified. Several runs share a StageCache.
class BoundingSearch {
public:
    /// The first three must outlive this. `acrossX` is the best plane across x, where it is known. Surfaces of more
    /// than `largeSurface` faces are decimated one after the other, without a record: that takes a third of the memory,
    /// and each run takes the full time again. The cages are the same.
    BoundingSearch(const Mesh& model, Volumes& volumes, Certifier& certifier,
                   const std::optional<Symmetry>& acrossX = {}, std::size_t largeSurface = policy::largeSurface);
    ~BoundingSearch();

    /// The inputs of a run. `scale` and `density` are the versions of the options' fields.
    struct Request {
        const CageOptions& options;
        const FieldVersion &scale, &density;
        std::size_t memoryLimit; ///< bytes of the process
        Interrupter* interrupter;
    };
    /// Returns a certified cage, or the model's bounding box with its verdict. It can be called again after any
    /// exception.
    /// \throw InputError as Pipeline::run
    /// \throw MemoryError
    /// \throw DeviceError
    /// \throw Cancelled
    Candidate run(const Request& request);

private:
    Candidate find(const Request& request, bool ofSheet);
    std::optional<Candidate> findSymmetric(const Request& request, bool ofSheet, std::string& objection);
    std::optional<Candidate> findTilted(const Request& request, std::string& objection);

    const std::unique_ptr<StageCache> cache_;
    Certifier& certifier_;
    const std::size_t largeSurface_;       // faces
    std::unique_ptr<TiltedSearch> tilted_; // after a plane in another direction was sought
};

} // namespace vdbcage::detail
