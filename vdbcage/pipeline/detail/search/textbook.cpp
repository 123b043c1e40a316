#include <vdbcage/pipeline/detail/search/textbook.h>

#include <utility>

#include <vdbcage/pipeline/detail/search/memory_demand.h>
#include <vdbcage/pipeline/memory.h>
#include <vdbcage/surface/decimate.h>
#include <vdbcage/surface/repair.h>
#include <vdbcage/surface/smooth.h>
#include <vdbcage/surface/triquad.h>
#include <vdbcage/volume/extract.h>

namespace vdbcage::detail {

namespace {

/// Makes quads by merging alone, as the options ask.
Mesh merged(const Mesh& triangles, const CageOptions& options)
{
    if (options.mesh == CageFaces::triangles) return triangles;
    TriquadOptions merging;
    merging.mergeAngleDegrees = mergeAngle(options);
    return triquad(triangles, merging);
}

} // namespace

Candidate textbookCage(const CageOptions& options, const FieldVersion& scale, Volumes& volumes, Certifier& certifier,
                       std::size_t memoryLimit, Interrupter* interrupter)
{
    if (memoryLimit < unlimitedMemory) {
        const auto quadsOf = [&](const Voxels& voxels) {
            return detail::quadsOf(volumes, options, scale, voxels, interrupter);
        };
        MemoryDemand(certifier.model(), options, 1, quadsOf).requireWithin(memoryLimit);
    }

    Candidate candidate;
    if (options.symmetry != CageSymmetry::off) candidate.noSymmetry = "bounding is off";
    candidate.voxels = finestVoxels(options);
    candidate.closing = volumes.closing(options, scale, candidate.voxels, interrupter);
    {
        const Stage stage(interrupter, StageName::surface);
        candidate.surface = std::make_shared<const Mesh>(extractSurface(*candidate.closing->mask, interrupter));
    }
    candidate.topology = analyzeTopology(*candidate.surface, interrupter);
    {
        const Stage stage(interrupter, StageName::smooth);
        SmoothOptions smoothing;
        smoothing.iterations = detail::smoothing(options);
        candidate.smoothed = smooth(*candidate.surface, smoothing, interrupter);
    }
    {
        const Stage stage(interrupter, StageName::decimate);
        DecimateOptions target;
        target.faces = static_cast<std::size_t>(options.faces);
        candidate.decimated = certifier.rounded(decimate(candidate.smoothed, target, interrupter), options.precision);
    }
    CageCheck check = certifier.check(candidate.decimated, interrupter);
    if (hasRepair() && !check.valid()) {
        candidate.decimated = certifier.rounded(repair(candidate.decimated, interrupter).cage, options.precision);
        candidate.repaired = true;
    }
    candidate.cage = merged(candidate.decimated, options);
    const bool isExamined = !candidate.repaired && options.mesh == CageFaces::triangles;
    candidate.check = isExamined ? std::move(check) : certifier.check(candidate.cage, interrupter);
    return candidate;
}

} // namespace vdbcage::detail
