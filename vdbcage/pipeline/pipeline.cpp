// The chain of stages is that of "Cage Generation with User Interaction in Cage Modeler" and of Calderon and Boubekeur,
// Bounding Proxies for Shape Approximation, 2017.
// Differs: a cage is certified before it is returned; where the plain operators cut the model the closing is grown.

#include <vdbcage/pipeline/pipeline.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <string>
#include <utility>

#include <vdbcage/core/error.h>
#include <vdbcage/surface/decimate.h>
#include <vdbcage/surface/extract.h>
#include <vdbcage/surface/repair.h>
#include <vdbcage/surface/smooth.h>
#include <vdbcage/surface/triquad.h>
#include <vdbcage/volume/cavities.h>
#include <vdbcage/volume/morphology.h>

namespace vdbcage {

namespace {

/// The values of all options that decide the result up to and including `last`: equal keys, equal results.
std::string keyUpTo(const CageOptions& options, PipelineStage last)
{
    const auto values = optionValues(options);
    std::string key;
    std::size_t i = 0;
    visitOptions(options, [&](const OptionInfo& info, const auto& /*field*/) {
        if (info.stage <= last) key += values[i].first + '=' + values[i].second + ' ';
        ++i;
    });
    return key;
}

/// The float next to `value`. Volatile, because g++ 12 -O3 drops the conversion in the remainder of a vectorized loop.
double nearestFloat(double value)
{
    const volatile float rounded = static_cast<float>(value);
    return static_cast<double>(rounded);
}

Mesh roundedToFloat(Mesh mesh)
{
    for (openvdb::Vec3d& point : mesh.points) {
        for (int axis = 0; axis < 3; ++axis) point[axis] = nearestFloat(point[axis]);
    }
    return mesh;
}

double longestSide(const openvdb::BBoxd& box)
{
    return box.extents()[static_cast<int>(box.maxExtent())];
}

/// Whether a host that stores floats can hold the model at all: 2^-24 of its largest coordinate is far below its size.
bool fitsFloat(const openvdb::BBoxd& box)
{
    double largest = 0;
    for (int axis = 0; axis < 3; ++axis) {
        largest = std::max({largest, std::abs(box.min()[axis]), std::abs(box.max()[axis])});
    }
    const double side = longestSide(box);
    return largest < 1e30 && side > 1e-30 && largest * 0x1p-24 < 1e-5 * side;
}

/// The six faces of `box`, each as two triangles facing outward.
Mesh boxMesh(const openvdb::BBoxd& box)
{
    Mesh mesh;
    for (int corner = 0; corner < 8; ++corner) {
        mesh.points.emplace_back((corner & 1 ? box.max() : box.min()).x(), (corner & 2 ? box.max() : box.min()).y(),
                                 (corner & 4 ? box.max() : box.min()).z());
    }
    const openvdb::Vec4I sides[6] = {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4},
                                     {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}};
    for (const openvdb::Vec4I& side : sides) {
        mesh.triangles.emplace_back(side[0], side[1], side[2]);
        mesh.triangles.emplace_back(side[0], side[2], side[3]);
    }
    return mesh;
}

} // namespace

class Pipeline::Stages {
public:
    explicit Stages(Mesh model) : model_(std::move(model))
    {
        requireUsable(model_, "model");
        const openvdb::BBoxd box = boundingBox(model_);
        floatSafe_ = fitsFloat(box);
    }

    void run(const CageOptions& options, Interrupter* interrupter)
    {
        requireValid(options);
        updateSolid(options, interrupter);
        updateClosed(options, interrupter);
        const std::string key = keyUpTo(options, PipelineStage::merge);
        if (key == cageKey_) return;
        cageKey_.clear();
        attempts_ = 0;
        Candidate best = options.bounding ? findBounding(options, interrupter) : makeUnguarded(options, interrupter);
        {
            const Stage stage(interrupter, "certify");
            best.check = checker(interrupter).check(best.cage, {}, interrupter);
        }
        if (options.bounding && !best.check.bounding()) {
            throw Error("the cage could not be certified; this is a defect of vdbcage, please report the model");
        }
        report_.check = best.check;
        report_.floatSafe = floatSafe_ && options.bounding;
        report_.offsetVoxels = best.offset;
        report_.attempts = attempts_;
        report_.isBox = best.isBox;
        report_.repaired = best.repaired;
        best_ = std::move(best);
        cageKey_ = key;
    }

    const Mesh& model() const { return model_; }
    openvdb::MaskGrid::ConstPtr solid() const { return solid_; }
    openvdb::MaskGrid::ConstPtr closed() const { return closed_; }
    const CageReport& report() const { return report_; }

    /// One try at a cage: the closing grown by `offset` voxels and what was made of it.
    struct Candidate {
        double offset = 0;
        Mesh surface, smoothed, decimated, cage;
        CageCheck check;
        bool isBox = false, repaired = false;
    };
    const Candidate& best() const { return best_; }

private:
    void updateSolid(const CageOptions& options, Interrupter* interrupter)
    {
        const std::string key = keyUpTo(options, PipelineStage::voxelize);
        if (key == solidKey_) return;
        solidKey_.clear();
        const Stage stage(interrupter, "voxelize");
        VoxelizeOptions voxels;
        voxels.resolution = options.resolution;
        voxels.voxelizer = options.voxelizer;
        solid_ = voxelize(model_, voxels, interrupter);
        report_.solidVoxels = static_cast<std::size_t>(solid_->activeVoxelCount());
        solidKey_ = key;
    }

    void updateClosed(const CageOptions& options, Interrupter* interrupter)
    {
        const std::string key = keyUpTo(options, PipelineStage::close);
        if (key == closedKey_) return;
        closedKey_.clear();
        const Stage stage(interrupter, "close");
        CloseOptions closing;
        closing.closeRadiusVoxels = options.closeRadius * options.resolution;
        closing.erodeRadiusVoxels = options.erodeRadius.value_or(options.closeRadius) * options.resolution;
        closing.element = options.element;
        const auto closed = closeMask(*solid_, closing, interrupter);
        closed_ = fillCavities(*closed, &report_.cavitiesFilled, interrupter);
        report_.closedVoxels = static_cast<std::size_t>(closed_->activeVoxelCount());
        closedKey_ = key;
    }

    const CageChecker& checker(Interrupter* interrupter)
    {
        if (!checker_) checker_ = std::make_unique<CageChecker>(model_, interrupter);
        return *checker_;
    }

    /// Exact verdict without measures, against the model as given and as a host that stores floats would hold it.
    CageCheck certify(const Mesh& cage, Interrupter* interrupter)
    {
        const Stage stage(interrupter, "certify");
        CheckOptions exactOnly;
        exactOnly.measure = false;
        CageCheck check = checker(interrupter).check(cage, exactOnly, interrupter);
        if (check.bounding() && floatSafe_) {
            if (!floatChecker_) floatChecker_ = std::make_unique<CageChecker>(roundedToFloat(model_), interrupter);
            check = floatChecker_->check(cage, exactOnly, interrupter);
        }
        return check;
    }

    /// Surface, smoothing and decimation of the closing grown by `offset` voxels; triangles, not examined.
    Candidate makeTriangles(const CageOptions& options, double offset, Interrupter* interrupter)
    {
        ++attempts_;
        Candidate candidate;
        candidate.offset = offset;
        {
            const Stage stage(interrupter, "surface");
            const openvdb::MaskGrid::ConstPtr grown =
                offset > 0 ? dilate(*closed_, offset, Element::sphere, interrupter) : closed_;
            candidate.surface = extractSurface(*grown, interrupter);
        }
        {
            const Stage stage(interrupter, "smooth");
            SmoothOptions smoothing;
            smoothing.iterations = options.smooth;
            candidate.smoothed = vdbcage::smooth(candidate.surface, smoothing, interrupter);
        }
        {
            const Stage stage(interrupter, "decimate");
            DecimateOptions target;
            target.faces = static_cast<std::size_t>(options.faces);
            candidate.decimated = decimate(candidate.smoothed, target, interrupter);
        }
        if (floatSafe_) candidate.decimated = roundedToFloat(std::move(candidate.decimated));
        candidate.cage = candidate.decimated;
        return candidate;
    }

    TriquadOptions mergeOptions(const CageOptions& options) const
    {
        TriquadOptions merging;
        merging.mergeAngleDegrees = options.mergeAngle;
        return merging;
    }

    Candidate makeUnguarded(const CageOptions& options, Interrupter* interrupter)
    {
        Candidate candidate = makeTriangles(options, 0, interrupter);
        if (hasRepair() && !certify(candidate.cage, interrupter).valid()) {
            candidate.decimated = repair(candidate.decimated, nullptr, interrupter);
            candidate.cage = candidate.decimated;
            candidate.repaired = true;
        }
        if (options.mesh == CageFaces::triquad) candidate.cage = triquad(candidate.decimated, mergeOptions(options));
        return candidate;
    }

    /// A certified candidate grown by as little as a short search finds. The first guess follows from the error of a
    /// quadric decimation, which falls like 1 / faces; then the offset is bracketed by steps of `step` and the bracket
    /// narrowed once. Not every larger offset holds where a smaller one does, so the smallest that held is taken.
    Candidate findBounding(const CageOptions& options, Interrupter* interrupter)
    {
        constexpr double step = 1.6;
        const double largest = std::min(0.5 * options.resolution, 512.0);
        double offset = std::clamp(8.0 * options.resolution / options.faces, 1.0, largest);
        std::optional<Candidate> held;
        double failed = 0;
        const auto attempt = [&](double at) {
            Candidate candidate = makeTriangles(options, at, interrupter);
            const bool few = faceCount(candidate.cage) <= static_cast<std::size_t>(options.faces);
            if (few && certify(candidate.cage, interrupter).bounding()) {
                held = std::move(candidate);
                return true;
            }
            failed = std::max(failed, at);
            return false;
        };
        if (attempt(offset)) {
            while (offset / step >= 0.7 && attempt(offset / step)) offset /= step;
        } else {
            while (!held && offset * step <= largest) attempt(offset *= step);
        }
        if (!held) return makeBox(options);
        if (failed > 0) attempt(std::sqrt(failed * held->offset));
        if (options.mesh == CageFaces::triquad) mergeCertified(options, *held, interrupter);
        return std::move(*held);
    }

    /// Quads that count under both diagonals: pairs that the verdict objects to are split again until it does not.
    void mergeCertified(const CageOptions& options, Candidate& candidate, Interrupter* interrupter)
    {
        using Edge = std::pair<openvdb::Index32, openvdb::Index32>;
        std::set<Edge> refused; // the pairs' common edges
        const auto edge = [](const openvdb::Vec4I& quad) {
            return Edge(std::min(quad[0], quad[2]), std::max(quad[0], quad[2]));
        };
        for (;;) {
            candidate.cage = triquad(candidate.decimated, mergeOptions(options),
                                     [&](const openvdb::Vec4I& quad) { return refused.count(edge(quad)) == 0; });
            if (candidate.cage.quads.empty()) return;
            const CageCheck check = certify(candidate.cage, interrupter);
            if (check.bounding()) return;
            const std::size_t before = refused.size();
            for (const std::uint32_t face : check.badFaces) {
                if (face < candidate.cage.triangles.size()) continue;
                refused.insert(edge(candidate.cage.quads[face - candidate.cage.triangles.size()]));
            }
            if (refused.size() == before) {
                for (const openvdb::Vec4I& quad : candidate.cage.quads) refused.insert(edge(quad));
            }
        }
    }

    Candidate makeBox(const CageOptions& options)
    {
        openvdb::BBoxd box = boundingBox(model_);
        const double margin = 0.01 * longestSide(box);
        box.expand(margin);
        Candidate candidate;
        candidate.isBox = true;
        candidate.offset = 0.01 * options.resolution;
        candidate.decimated = boxMesh(box);
        if (floatSafe_) candidate.decimated = roundedToFloat(std::move(candidate.decimated));
        candidate.cage = candidate.decimated;
        if (options.mesh == CageFaces::triquad) candidate.cage = triquad(candidate.decimated, mergeOptions(options));
        return candidate;
    }

    Mesh model_;
    bool floatSafe_ = false;
    openvdb::MaskGrid::Ptr solid_, closed_;
    std::unique_ptr<CageChecker> checker_, floatChecker_;
    std::string solidKey_, closedKey_, cageKey_; // what the values were made with; empty: nothing
    int attempts_ = 0;
    Candidate best_;
    CageReport report_;
};

Pipeline::Pipeline(Mesh model) : stages_(std::make_unique<Stages>(std::move(model)))
{
}
Pipeline::~Pipeline() = default;
Pipeline::Pipeline(Pipeline&&) noexcept = default;
Pipeline& Pipeline::operator=(Pipeline&&) noexcept = default;

const Mesh& Pipeline::run(const CageOptions& options, Interrupter* interrupter)
{
    stages_->run(options, interrupter);
    return cage();
}

const Mesh& Pipeline::model() const
{
    return stages_->model();
}
openvdb::MaskGrid::ConstPtr Pipeline::solid() const
{
    return stages_->solid();
}
openvdb::MaskGrid::ConstPtr Pipeline::closed() const
{
    return stages_->closed();
}
const Mesh& Pipeline::surface() const
{
    return stages_->best().surface;
}
const Mesh& Pipeline::smoothed() const
{
    return stages_->best().smoothed;
}
const Mesh& Pipeline::decimated() const
{
    return stages_->best().decimated;
}
const Mesh& Pipeline::cage() const
{
    return stages_->best().cage;
}
const CageReport& Pipeline::report() const
{
    return stages_->report();
}

Mesh makeCage(const Mesh& model, const CageOptions& options, Interrupter* interrupter)
{
    return Pipeline(model).run(options, interrupter);
}

} // namespace vdbcage
