#include <vdbcage/pipeline/memory.h>

#include <vdbcage/mesh/parts.h>
#include <vdbcage/pipeline/detail/search/memory_demand.h>
#include <vdbcage/pipeline/detail/stages/volumes.h>
#include <vdbcage/voxelize/detail/interior_by.h>

namespace vdbcage {

namespace {

/// An interrupter that passes questions on, but no stages: the count belongs to no stage of a run.
class QuestionsOnly : public Interrupter {
public:
    explicit QuestionsOnly(Interrupter* next) : next_(next) {}
    bool wasInterrupted(int /*percent*/) override { return next_ && next_->wasInterrupted(); }

private:
    Interrupter* next_;
};

detail::MemoryDemand demandOf(const Mesh& model, const CageOptions& options, Interrupter* interrupter)
{
    if (options.leastPart > 0) {
        CageOptions ofAllParts = options;
        ofAllParts.leastPart = 0;
        return demandOf(largeParts(model, options.leastPart).mesh, ofAllParts, interrupter);
    }
    QuestionsOnly questions(interrupter);
    CageOptions countedOptions = options;
    countedOptions.voxelizer = Voxelizer::cpu;
    if (options.interior == Interior::automatic) {
        countedOptions.interior = detail::interiorBy(rayAgreement(model, &questions));
    }
    detail::Volumes volumes(model);
    const detail::FieldVersion scale(options.scale);
    const auto quadsOf = [&](const detail::Voxels& voxels) {
        return detail::quadsOf(volumes, countedOptions, scale, voxels, &questions);
    };
    const double share = options.bounding ? detail::shareOfSide(options, model, quadsOf) : 1;
    return {model, options, share, quadsOf};
}

} // namespace

MemoryError::~MemoryError() = default; // the key function, as those of core/error.cpp

std::size_t predictedMemory(const Mesh& model, const CageOptions& options, Interrupter* interrupter)
{
    requireValid(options);
    requireUsable(model, "model");
    return static_cast<std::size_t>(demandOf(model, options, interrupter).bytes());
}

void requireMemory(const Mesh& model, const CageOptions& options, std::size_t limit, Interrupter* interrupter)
{
    requireValid(options);
    requireUsable(model, "model");
    demandOf(model, options, interrupter).requireWithin(limit);
}

} // namespace vdbcage
