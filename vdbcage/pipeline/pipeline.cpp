// The chain of stages is that of "Cage Generation with User Interaction in Cage Modeler" and of Calderon and Boubekeur,
// Bounding Proxies for Shape Approximation, 2017.
// Differs: surfaces are changed under a guard that keeps the model inside, and a cage is certified before it is
// returned.

#include <vdbcage/core/detail/grids.h>
#include <vdbcage/pipeline/pipeline.h>

#include <optional>
#include <string_view>
#include <type_traits>
#include <utility>

#include <vdbcage/core/detail/parallel.h>
#include <vdbcage/core/error.h>
#include <vdbcage/mesh/parts.h>
#include <vdbcage/pipeline/detail/search/bounding_search.h>
#include <vdbcage/pipeline/detail/search/textbook.h>
#include <vdbcage/voxelize/detail/interior_by.h>

namespace vdbcage {

using detail::Candidate;
using detail::FieldVersion;

namespace {

/// Returns whether two sets of options are equal, except for fields, which count by their versions.
bool areEqual(const CageOptions& a, const CageOptions& b)
{
    bool equal = true;
    visitOptions(a, [&](const OptionInfo& of, const auto& first) {
        visitOptions(b, [&](const OptionInfo& other, const auto& second) {
            using First = std::decay_t<decltype(first)>;
            using Second = std::decay_t<decltype(second)>;
            if constexpr (std::is_same_v<First, Second> && !std::is_same_v<First, FactorField>) {
                if (std::string_view(of.name) == other.name) equal = equal && first == second;
            }
        });
    });
    return equal;
}

CageReport reportOf(const Candidate& candidate, const CageOptions& options, bool areFloats)
{
    const detail::Closing& closing = *candidate.closing;
    const detail::Solid& solid = *closing.solid;
    CageReport report;
    report.check = candidate.check;
    report.floatSafe = options.bounding && areFloats && candidate.boundsAsFloats;
    report.resolution = candidate.voxels.resolution;
    report.voxels = solid.report;
    report.closeRadius = closing.key.closeRadius;
    report.erodeRadius = closing.key.erodeRadius;
    report.minAngle = candidate.minAngle;
    if (detail::arePaired(options)) report.mergeAngle = detail::mergeAngle(options);
    report.smooth = detail::smoothing(options);
    report.offsetVoxels = candidate.offsetVoxels;
    report.start = candidate.startKind;
    report.symmetry = candidate.symmetry;
    report.tiltedSymmetry = candidate.tiltedSymmetry;
    report.noSymmetry = candidate.noSymmetry;
    report.plan = candidate.plan;
    report.repaired = candidate.repaired;
    report.sideShare = candidate.sideShare;
    report.startFaces = faceCount(*candidate.surface);
    report.cavitiesFilled = closing.cavitiesFilled;
    report.solidParts = solid.boundary.components;
    report.solidHandles = solid.boundary.genus;
    report.parts = candidate.topology.components();
    report.handles = candidate.topology.genus();
    report.solidVoxels = solid.voxels;
    report.closedVoxels = closing.voxels;
    return report;
}

} // namespace

class Pipeline::Impl {
public:
    explicit Impl(Mesh model) : model_((requireUsable(model, "model"), std::move(model))) {}

    void run(const CageOptions& options, Interrupter* interrupter, std::size_t memoryLimit)
    {
        requireValid(options);
        FieldVersion scale(options.scale), density(options.density);
        if (last_ && scale == last_->scale && density == last_->density && areEqual(options, last_->options)) return;
        Work& work = workFor(options.leastPart);
        detail::requireHeld(options.precision, boundingBox(work.model));
        CageOptions decided = options;
        if (options.interior == Interior::automatic) decided.interior = work.interior(interrupter);
        Candidate candidate = options.bounding ? work.search.run({decided, scale, density, memoryLimit, interrupter})
                                               : detail::textbookCage(decided, scale, work.volumes, work.certifier,
                                                                      memoryLimit, interrupter);
        if (options.bounding && !candidate.check.bounding()) {
            throw Error("the cage could not be certified; this is a defect of vdbcage, please report the model");
        }
        const std::size_t hollows = work.certifier.hollows(interrupter);
        report_ = reportOf(candidate, options, work.certifier.areFloats(options.precision));
        report_.modelHollows = hollows;
        if (work.parts) {
            report_.partsLeftOut = work.parts->partsLeftOut;
            report_.facesLeftOut = work.parts->facesLeftOut;
            report_.leastPartSide = work.parts->leastSide;
        }
        if (options.interior == Interior::automatic) report_.voxels.agreement = work.agreement;
        candidate_ = std::move(candidate);
        last_ = Last{options, std::move(scale), std::move(density)};
        last_->options.scale = last_->options.density = {};
    }

    const Mesh& model() const { return model_; }
    const Candidate& candidate() const { return candidate_; }
    const CageReport& report() const { return report_; }

private:
    /// The data made of the model, or of its large parts.
    struct Work {
        Work(const Mesh& whole, double least)
            : leastPart(least), parts(least > 0 ? std::optional(largeParts(whole, least)) : std::nullopt),
              model(parts ? parts->mesh : whole)
        {
        }

        /// Returns the same interior for every copy of the model, turned ones included, of which voxels are made.
        Interior interior(Interrupter* interrupter)
        {
            if (!agreement) {
                const Stage stage(interrupter, StageName::interior);
                agreement = rayAgreement(model, interrupter);
            }
            return detail::interiorBy(*agreement);
        }

        double leastPart;
        std::optional<LargeParts> parts; // without it none are left out
        const Mesh& model;
        detail::Volumes volumes{model};
        detail::Certifier certifier{model};
        detail::BoundingSearch search{model, volumes, certifier};
        std::optional<double> agreement; // of rays about the model's inside, once it is needed
    };

    Work& workFor(double leastPart)
    {
        if (!work_ || work_->leastPart != leastPart) work_ = std::make_unique<Work>(model_, leastPart);
        return *work_;
    }

    /// The options with which the cage was made.
    struct Last {
        CageOptions options;
        FieldVersion scale, density;
    };

    static Candidate nothing()
    {
        Candidate candidate;
        candidate.surface = std::make_shared<const Mesh>();
        return candidate;
    }

    const Mesh model_;
    std::unique_ptr<Work> work_;
    Candidate candidate_ = nothing();
    CageReport report_;
    std::optional<Last> last_;
};

Pipeline::Pipeline(Mesh model) : impl_(std::make_unique<Impl>(std::move(model)))
{
}
Pipeline::~Pipeline() = default;
Pipeline::Pipeline(Pipeline&&) noexcept = default;
Pipeline& Pipeline::operator=(Pipeline&&) noexcept = default;

const Mesh& Pipeline::run(const CageOptions& options, Interrupter* interrupter, std::size_t memoryLimit)
{
    // Even the destructors of OpenVDB's trees crash in a task of the host that was cancelled.
    detail::isolated([&] { impl_->run(options, interrupter, memoryLimit); });
    return cage();
}

const Mesh& Pipeline::model() const
{
    return impl_->model();
}
openvdb::MaskGrid::ConstPtr Pipeline::solid() const
{
    const auto& closing = impl_->candidate().closing;
    return closing ? closing->solid->mask : nullptr;
}
openvdb::MaskGrid::ConstPtr Pipeline::closed() const
{
    const auto& closing = impl_->candidate().closing;
    return closing ? closing->mask : nullptr;
}
const Mesh& Pipeline::surface() const
{
    return *impl_->candidate().surface;
}
const Mesh& Pipeline::smoothed() const
{
    return impl_->candidate().smoothed;
}
const Mesh& Pipeline::decimated() const
{
    return impl_->candidate().decimated;
}
const Mesh& Pipeline::cage() const
{
    return impl_->candidate().cage;
}
const CageReport& Pipeline::report() const
{
    return impl_->report();
}

Mesh makeCage(const Mesh& model, const CageOptions& options, Interrupter* interrupter)
{
    return detail::isolated([&] { return Pipeline(model).run(options, interrupter); });
}

} // namespace vdbcage
