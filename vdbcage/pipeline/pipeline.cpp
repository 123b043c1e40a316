// The chain of stages is that of "Cage Generation with User Interaction in Cage Modeler" and of Calderon and Boubekeur,
// Bounding Proxies for Shape Approximation, 2017.
// Differs: surfaces are changed under a guard that keeps the model inside, and a cage is certified before it is
// returned.

#include <vdbcage/pipeline/pipeline.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include <vdbcage/bounding/bounding_guard.h>
#include <vdbcage/bounding/detail/recorded_decimation.h>
#include <vdbcage/bounding/near_coplanar.h>
#include <vdbcage/bounding/smooth.h>
#include <vdbcage/bounding/tighten.h>
#include <vdbcage/bounding/triquad.h>
#include <vdbcage/core/detail/mask_grid.h>
#include <vdbcage/core/detail/nearest_float.h>
#include <vdbcage/core/detail/parallel.h>
#include <vdbcage/core/error.h>
#include <vdbcage/mesh/symmetry.h>
#include <vdbcage/mesh/topology.h>
#include <vdbcage/surface/decimate.h>
#include <vdbcage/surface/repair.h>
#include <vdbcage/surface/smooth.h>
#include <vdbcage/surface/triquad.h>
#include <vdbcage/volume/cavities.h>
#include <vdbcage/volume/convex_hull.h>
#include <vdbcage/volume/extract.h>
#include <vdbcage/volume/mirror.h>
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
    // A scale field made by a program has no text of its own.
    if (last >= PipelineStage::close) {
        std::ostringstream text;
        text.precision(17);
        text << options.scale.grid.get();
        for (const ScaleRegion& region : options.scale.regions) {
            text << ' ' << static_cast<int>(region.shape) << region.lower << region.upper << region.radius << ' '
                 << region.scale;
        }
        key += text.str();
    }
    return key;
}

Mesh roundedToFloat(Mesh mesh)
{
    for (openvdb::Vec3d& point : mesh.points) point = detail::nearestFloat(point);
    return mesh;
}

double longestSide(const openvdb::BBoxd& box)
{
    return box.extents()[static_cast<int>(box.maxExtent())];
}

/// The box of a box and its mirror image.
openvdb::BBoxd withMirrorImage(const openvdb::BBoxd& box, const SymmetryPlane& plane)
{
    openvdb::Vec3d low = box.min(), high = box.max();
    const double reach = std::max(high[plane.axis] - plane.offset, plane.offset - low[plane.axis]);
    low[plane.axis] = plane.offset - reach;
    high[plane.axis] = plane.offset + reach;
    openvdb::BBoxd both = box; // rounding must not make it smaller
    both.expand(openvdb::BBoxd(low, high));
    return both;
}

/// The active voxels of `mask`.
std::size_t countOf(const openvdb::MaskGrid& mask)
{
    return static_cast<std::size_t>(detail::isolated([&] { return mask.activeVoxelCount(); }));
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
        floatSafe_ = detail::fitsFloat(boundingBox(model_));
    }

    void run(const CageOptions& options, Interrupter* interrupter)
    {
        requireValid(options);
        const std::string key = keyUpTo(options, PipelineStage::merge);
        if (key == cageKey_) return;
        cageKey_.clear();
        for (const auto& start : starts_) start->isUsed = false;
        Candidate best = make(options, interrupter);
        updateClosed(options, best.voxels, interrupter); // others may have been tried since
        {
            const Stage stage(interrupter, "certify");
            best.check = checker(interrupter).check(best.cage, {}, interrupter);
        }
        if (options.bounding && !best.check.bounding()) {
            throw Error("the cage could not be certified; this is a defect of vdbcage, please report the model");
        }
        report_.check = best.check;
        report_.floatSafe = floatSafe_ && options.bounding;
        report_.resolution = best.voxels.resolution;
        report_.closeRadius = best.voxels.closeRadius;
        report_.offsetVoxels = best.offset;
        report_.start = best.start;
        report_.parts = best.topology.components();
        report_.handles = best.topology.genus();
        report_.repaired = best.repaired;
        best_ = std::move(best);
        best_.from.reset();
        starts_.erase(std::remove_if(starts_.begin(), starts_.end(), [](const auto& start) { return !start->isUsed; }),
                      starts_.end());
        cageKey_ = key;
    }

    const Mesh& model() const { return model_; }
    openvdb::MaskGrid::ConstPtr solid() const { return solid_; }
    openvdb::MaskGrid::ConstPtr closed() const { return closed_; }
    const CageReport& report() const { return report_; }

    /// What auto options stand for.
    struct Voxels {
        int resolution;
        double closeRadius;
        std::optional<SymmetryPlane> plane = {}; ///< across the middle of the voxels: the index resolution / 2
    };
    /// What cages of any face count begin with.
    struct Start {
        std::string key;                        ///< what it was made with
        openvdb::FloatGrid::ConstPtr scaleGrid; ///< whose address is in the key: kept, so that no other gets it
        double offset = 0;
        Mesh surface;
        MeshTopology topology;
        std::optional<detail::RecordedDecimation> decimation; ///< once it was asked for
        bool isUsed = true;                                   ///< in this run
    };
    /// How many faces the surface of a closing has.
    struct Counted {
        std::string key;                        ///< what it was made with
        openvdb::FloatGrid::ConstPtr scaleGrid; ///< as in Start
        std::size_t quads = 0;
    };
    /// A cage and what it was made from.
    struct Candidate {
        Voxels voxels{};
        double offset = 0;
        CageStart start = CageStart::closing;
        std::shared_ptr<Start> from; // bounding only
        Mesh surface, smoothed, decimated, cage;
        MeshTopology topology; // of the surface
        CageCheck check;
        bool repaired = false;
    };
    const Candidate& best() const { return best_; }

private:
    Candidate make(const CageOptions& options, Interrupter* interrupter)
    {
        try {
            return options.bounding ? makeBounding(options, interrupter) : makeUnguarded(options, interrupter);
        } catch (const Cancelled&) {
            throw; // asked for between two steps: what was recorded of the decimations is right
        } catch (...) {
            starts_.clear(); // a step may be half done
            throw;
        }
    }

    /// With what auto options stand for.
    static CageOptions resolved(CageOptions options, const Voxels& voxels)
    {
        options.resolution = voxels.resolution;
        options.closeRadius = voxels.closeRadius;
        if (!voxels.plane) options.symmetry = CageSymmetry::off;
        return options;
    }

    void updateClosed(const CageOptions& given, const Voxels& voxels, Interrupter* interrupter)
    {
        const CageOptions options = resolved(given, voxels);
        updateSolid(options, voxels, interrupter);
        const std::string key = keyUpTo(options, PipelineStage::close);
        if (key == closedKey_) return;
        closedKey_.clear();
        const Stage stage(interrupter, "close");
        CloseOptions closing;
        closing.closeRadiusVoxels = voxels.closeRadius * voxels.resolution;
        closing.erodeRadiusVoxels = options.erodeRadius.value_or(voxels.closeRadius) * voxels.resolution;
        closing.element = options.element;
        auto closed = closeMask(*solid_, closing, options.scale, interrupter);
        // The scale may be anything.
        if (voxels.plane) closed = mirroredToo(*closed, voxels, interrupter);
        closed_ = fillCavities(*closed, &report_.cavitiesFilled, interrupter);
        scaleGrid_ = options.scale.grid;
        report_.closedVoxels = countOf(*closed_);
        closedKey_ = key;
    }

    static openvdb::MaskGrid::Ptr mirroredToo(const openvdb::MaskGrid& mask, const Voxels& voxels,
                                              Interrupter* interrupter)
    {
        return withMirrorImage(mask, voxels.plane->axis, voxels.resolution, interrupter);
    }

    void updateSolid(const CageOptions& options, const Voxels& voxels, Interrupter* interrupter)
    {
        const std::string key = keyUpTo(options, PipelineStage::voxelize);
        if (key == solidKey_) return;
        solidKey_.clear();
        closedKey_.clear();
        const Stage stage(interrupter, "voxelize");
        VoxelizeOptions voxelization;
        voxelization.resolution = voxels.resolution;
        voxelization.voxelizer = options.voxelizer;
        if (voxels.plane) voxelization.box = withMirrorImage(boundingBox(model_), *voxels.plane);
        solid_ = voxelize(model_, voxelization, interrupter, &report_.voxels);
        if (voxels.plane) solid_ = mirroredToo(*solid_, voxels, interrupter);
        report_.solidVoxels = countOf(*solid_);
        const MeshTopology topology = analyzeTopology(extractSurface(*solid_, interrupter), interrupter);
        report_.solidParts = topology.components();
        report_.solidHandles = topology.genus();
        solidKey_ = key;
    }

    /// The voxels to try, finest first. What is given is obeyed.
    static std::vector<Voxels> ladder(const CageOptions& options)
    {
        constexpr double leastRadius = 0.03, greatestRadius = 0.24;
        constexpr int usual = 64, finest = 512, coarsest = 16;
        // The surface should have several times the faces that the cage is to have; still more gain little.
        const double share = options.effort == Effort::fast ? 2.0 / 3 : options.effort == Effort::fair ? 5.0 / 6 : 1.0;
        const double wanted = share * usual * std::sqrt(std::max(1.0, options.faces / 1000.0));
        const int resolution = options.resolution.value_or(std::min(finest, static_cast<int>(std::ceil(wanted))));
        std::vector<Voxels> list{{resolution, options.closeRadius.value_or(leastRadius)}};
        if (!options.closeRadius) {
            for (double radius = 2 * leastRadius; radius <= greatestRadius; radius *= 2) {
                list.push_back({resolution, radius});
            }
        }
        if (!options.resolution) {
            for (int coarser = resolution / 2; coarser >= coarsest; coarser /= 2) {
                list.push_back({coarser, options.closeRadius.value_or(greatestRadius)});
            }
        }
        return list;
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
            exactOnly.asFloats = true;
            check = checker(interrupter).check(cage, exactOnly, interrupter);
        }
        return check;
    }

    static double mergeAngle(const CageOptions& options)
    {
        constexpr double anyFold = 90, flat = 10, usual = 30;
        const double automatic = options.mesh == CageFaces::quads ? anyFold : options.bounding ? usual : flat;
        return options.mergeAngle.value_or(automatic);
    }

    /// The wide one costs up to 5 % of the tightness: too much where that or time is all that counts.
    static double minAngle(const CageOptions& options)
    {
        constexpr double wide = 10, usual = 6;
        const bool isWide = options.mesh == CageFaces::triangles && options.effort == Effort::fair;
        return options.minAngle.value_or(isWide ? wide : usual);
    }

    /// Quads by merging alone, where no guard is needed.
    static Mesh merged(const Mesh& triangles, const CageOptions& options)
    {
        if (options.mesh == CageFaces::triangles) return triangles;
        TriquadOptions merging;
        merging.mergeAngleDegrees = mergeAngle(options);
        return triquad(triangles, merging);
    }

    Candidate makeUnguarded(const CageOptions& options, Interrupter* interrupter)
    {
        report_.symmetry.reset();
        report_.noSymmetry = options.symmetry == CageSymmetry::off ? "" : "bounding is off";
        constexpr int removeSteps = 3; // smoothing that takes the steps of the voxels away
        Candidate candidate;
        candidate.voxels = ladder(options).front();
        updateClosed(options, candidate.voxels, interrupter);
        {
            const Stage stage(interrupter, "surface");
            candidate.surface = extractSurface(*closed_, interrupter);
            candidate.topology = analyzeTopology(candidate.surface, interrupter);
        }
        {
            const Stage stage(interrupter, "smooth");
            SmoothOptions smoothing;
            smoothing.iterations = std::min(100, removeSteps + options.smooth);
            candidate.smoothed = vdbcage::smooth(candidate.surface, smoothing, interrupter);
        }
        {
            const Stage stage(interrupter, "decimate");
            DecimateOptions target;
            target.faces = static_cast<std::size_t>(options.faces);
            candidate.decimated = decimate(candidate.smoothed, target, interrupter);
        }
        if (floatSafe_) candidate.decimated = roundedToFloat(std::move(candidate.decimated));
        if (hasRepair() && !certify(candidate.decimated, interrupter).valid()) {
            candidate.decimated = repair(candidate.decimated, nullptr, interrupter);
            candidate.repaired = true;
        }
        candidate.cage = merged(candidate.decimated, options);
        return candidate;
    }

    /// The plane found or given; the model has the same one in every run.
    const std::optional<Symmetry>& planeFor(CageSymmetry wanted, Interrupter* interrupter)
    {
        constexpr double tolerance = 0.005; // below the distance of a tight cage of some hundred faces
        if (wanted == soughtSymmetry_) return symmetry_;
        const Stage stage(interrupter, "symmetry");
        if (wanted == CageSymmetry::automatic) {
            symmetry_ = findSymmetry(model_, tolerance, interrupter);
        } else {
            const int axis = wanted == CageSymmetry::x ? 0 : wanted == CageSymmetry::y ? 1 : 2;
            symmetry_ = bestSymmetry(model_, axis, interrupter);
        }
        soughtSymmetry_ = wanted;
        return symmetry_;
    }

    const BoundingGuard& guardFor(const GuardOptions& options, Interrupter* interrupter)
    {
        const auto& plane = options.symmetry;
        const auto& last = guardOptions_.symmetry;
        const bool samePlane = plane ? last && plane->axis == last->axis && plane->offset == last->offset : !last;
        if (!guard_ || options.clearance != guardOptions_.clearance ||
            options.minAngleDegrees != guardOptions_.minAngleDegrees || !samePlane) {
            const Stage stage(interrupter, "guard");
            starts_.clear(); // they are under the guard
            guard_.reset();
            guard_ = std::make_unique<const BoundingGuard>(model_, options, interrupter);
            guardOptions_ = options;
        }
        return *guard_;
    }

    /// A symmetric cage where there is a plane, or else one that is not.
    Candidate makeBounding(const CageOptions& options, Interrupter* interrupter)
    {
        GuardOptions guarding;
        guarding.clearance = options.clearance;
        guarding.minAngleDegrees = minAngle(options);
        report_.symmetry.reset();
        if (options.symmetry != CageSymmetry::off) report_.symmetry = planeFor(options.symmetry, interrupter);
        report_.noSymmetry.clear();
        if (report_.symmetry) {
            guarding.symmetry = report_.symmetry->plane;
            const BoundingGuard& guard = guardFor(guarding, interrupter);
            report_.symmetry->plane = *guard.symmetry();
            if (auto candidate = shrinkStarts(options, guard, interrupter)) return *candidate;
            report_.symmetry.reset();
            report_.noSymmetry = "no symmetric cage with so few faces was certified";
        } else if (options.symmetry != CageSymmetry::off) {
            report_.noSymmetry = "the model is not symmetric across x, y or z";
        }
        guarding.symmetry.reset();
        const BoundingGuard& guard = guardFor(guarding, interrupter);
        const auto candidate = shrinkStarts(options, guard, interrupter);
        return candidate ? *candidate : makeBox(options, guard);
    }

    /// The first rung of the ladder that leads to few enough faces, or else a cage from the convex hull; nothing
    /// if that has too many too.
    std::optional<Candidate> shrinkStarts(const CageOptions& options, const BoundingGuard& guard,
                                          Interrupter* interrupter)
    {
        constexpr int hullResolution = 32; // a hull has no detail that more could show
        for (Voxels voxels : ladder(options)) {
            voxels.plane = guard.symmetry();
            std::vector<Candidate> starts = startsFrom(voxels, options, guard, interrupter);
            if (starts.empty()) continue;
            if (auto candidate = shrinkOnto(std::move(starts), options, guard, interrupter)) return candidate;
        }
        Candidate hull;
        hull.start = CageStart::hull;
        hull.voxels = ladder(options).front();
        hull.voxels.resolution = std::min(hull.voxels.resolution, hullResolution);
        hull.voxels.plane = guard.symmetry();
        begin(hull, options, guard, interrupter);
        return shrinkOnto({hull}, options, guard, interrupter);
    }

    static constexpr int fewFaces = 200, fewestFaces = 60;

    /// The shares of a resolution that cages are begun with, to take the tightest. Among few faces the order of the
    /// collapses is luck, so that several starts pay. For the fewest, voxels of up to twice the width are as good, and
    /// two starts with these take hardly more time than one without.
    static std::vector<double> startScales(const CageOptions& options)
    {
        if (options.resolution) return {1.0};
        if (options.effort != Effort::best && options.faces <= fewestFaces) return {0.65, 0.5};
        if (options.effort == Effort::best && options.faces <= fewFaces) return {1.0, 0.85, 0.7, 0.6};
        return {1.0};
    }

    /// What cages may be shrunk from with voxels like these: nothing if there are too many handles.
    std::vector<Candidate> startsFrom(const Voxels& voxels, const CageOptions& options, const BoundingGuard& guard,
                                      Interrupter* interrupter)
    {
        const int resolution = affordableResolution(voxels, options, interrupter);
        std::vector<Candidate> starts;
        for (const double scale : startScales(options)) {
            Candidate candidate;
            candidate.voxels = voxels;
            candidate.voxels.resolution = static_cast<int>(std::lround(scale * resolution));
            begin(candidate, options, guard, interrupter);
            if (fewEnoughHandles(candidate.topology, options)) starts.push_back(std::move(candidate));
            if (starts.empty()) break;
        }
        return starts;
    }

    /// The resolution of `voxels`, or a coarser one where time counts most and the surface, whose area the longest side
    /// tells little of, would have more triangles than cages of so many faces gain from.
    int affordableResolution(const Voxels& voxels, const CageOptions& options, Interrupter* interrupter)
    {
        constexpr double enough = 9000;   // triangles, for up to 1000 faces; with 7500 some are 8 % looser
        constexpr double coarsest = 0.75; // of the resolution: thin parts need some
        if (options.effort != Effort::fast || options.resolution || options.faces <= fewestFaces) {
            return voxels.resolution;
        }
        const std::string key = keyUpTo(resolved(options, voxels), PipelineStage::close);
        if (key != counted_.key) {
            updateClosed(options, voxels, interrupter);
            const Stage stage(interrupter, "surface");
            counted_ = {key, options.scale.grid, faceCount(extractSurface(*closed_, interrupter))};
        }
        const double triangles = 2 * static_cast<double>(counted_.quads);
        const double share = std::sqrt(enough * std::max(1.0, options.faces / 1000.0) / triangles);
        return static_cast<int>(std::lround(std::clamp(share, coarsest, 1.0) * voxels.resolution));
    }

    /// Gives a candidate what it is made from: of the run before, or anew.
    void begin(Candidate& candidate, const CageOptions& options, const BoundingGuard& guard, Interrupter* interrupter)
    {
        const CageOptions here = resolved(options, candidate.voxels);
        const std::string key =
            (candidate.start == CageStart::hull ? "hull " : "") + keyUpTo(here, PipelineStage::close);
        const auto hasKey = [&](const auto& start) { return start->key == key; };
        auto known = std::find_if(starts_.begin(), starts_.end(), hasKey);
        if (known == starts_.end()) {
            updateClosed(options, candidate.voxels, interrupter);
            const auto solid = candidate.start == CageStart::hull ? convexHull(*closed_, interrupter) : closed_;
            const auto start = std::make_shared<Start>(startFrom(*solid, candidate.voxels, guard, interrupter));
            start->key = key;
            start->scaleGrid = options.scale.grid;
            known = starts_.insert(starts_.end(), start);
        }
        (*known)->isUsed = true;
        candidate.from = *known;
        candidate.offset = candidate.from->offset;
        candidate.surface = candidate.from->surface;
        candidate.topology = candidate.from->topology;
    }

    /// The surface of `solid`, grown to keep the guard's clearance: all of it by as many whole voxels as the clearance
    /// has, then the places where that is not enough, until it is.
    static Start startFrom(const openvdb::MaskGrid& solid, const Voxels& voxels, const BoundingGuard& guard,
                           Interrupter* interrupter)
    {
        const Stage stage(interrupter, "surface");
        Start start;
        start.offset = std::floor(guard.clearance() / solid.voxelSize()[0]);
        const auto grownBy = [&](double radius, const openvdb::MaskGrid& mask) {
            return dilate(mask, radius, StructuringElement::sphere, interrupter);
        };
        auto mask = start.offset > 0 ? grownBy(start.offset, solid)
                                     : detail::maskGridLike(solid, std::make_shared<openvdb::MaskTree>(solid.tree()));
        for (;;) {
            throwIfInterrupted(interrupter);
            start.surface = guard.symmetry() ? guard.symmetrized(symmetricSurface(*mask, voxels, interrupter),
                                                                 mask->voxelSize()[0] / 4)
                                             : extractSurface(*mask, interrupter);
            const std::vector<std::size_t> tooNear = guard.facesTooNear(start.surface);
            if (tooNear.empty()) break;
            if (addVoxelsOutside(start.surface, tooNear, *mask) == 0) mask = grownBy(1, *mask);
        }
        start.topology = analyzeTopology(start.surface, interrupter);
        return start;
    }

    /// Adds the voxels on the outer side of faces between voxels; returns how many there were not.
    static std::size_t addVoxelsOutside(const Mesh& surface, const std::vector<std::size_t>& faces,
                                        openvdb::MaskGrid& mask)
    {
        auto voxels = mask.getAccessor();
        std::size_t added = 0;
        for (const std::size_t face : faces) {
            const openvdb::Vec4I& q = surface.quads[face - surface.triangles.size()];
            const auto corner = [&](int i) { return mask.worldToIndex(surface.points[q[i]]); };
            const openvdb::Vec3d a = corner(0), b = corner(1), c = corner(2), d = corner(3);
            openvdb::Vec3d outward = (c - a).cross(d - b);
            outward.normalize();
            const auto voxel = openvdb::Coord::round(0.25 * (a + b + c + d) + 0.5 * outward);
            added += !voxels.isValueOn(voxel);
            voxels.setValueOn(voxel);
        }
        return added;
    }

    /// The surface of a mask that is symmetric: so is what is added to make it well-composed.
    static Mesh symmetricSurface(const openvdb::MaskGrid& mask, const Voxels& voxels, Interrupter* interrupter)
    {
        for (auto both = mirroredToo(mask, voxels, interrupter);;) {
            const auto composed = makeWellComposed(*both, interrupter);
            both = mirroredToo(*composed, voxels, interrupter);
            if (countOf(*both) == countOf(*composed)) return extractSurface(*composed, interrupter);
        }
    }

    /// Whether parts and handles leave faces enough for the shape: a part needs about 8, a handle 12.
    static bool fewEnoughHandles(const MeshTopology& topology, const CageOptions& options)
    {
        constexpr double share = 0.15; // of the faces
        const auto parts = static_cast<double>(topology.components());
        if (options.parts == CageParts::merge && parts > 1) return false;
        return 8 * (parts - 1) + 12 * static_cast<double>(topology.genus()) <= share * options.faces;
    }

    /// Makes cages of the candidates' surfaces, side by side; the tightest that has few enough faces and is certified.
    std::optional<Candidate> shrinkOnto(std::vector<Candidate> starts, const CageOptions& options,
                                        const BoundingGuard& guard, Interrupter* interrupter)
    {
        const auto faces = static_cast<std::size_t>(options.faces);
        BoundingDecimateOptions decimation;
        decimation.effort = options.effort;
        // Two triangles a quad, and some that vanish. (Between 2 and 4 times the faces it hardly matters.)
        decimation.faces = options.mesh == CageFaces::triangles ? faces : 3 * faces;
        {
            const Stage stage(interrupter, "decimate");
            detail::parallelFor(std::size_t(0), starts.size(), [&](std::size_t i) {
                starts[i].smoothed = starts[i].surface;
                auto& known = starts[i].from->decimation;
                if (!known) known.emplace(starts[i].surface, guard, interrupter);
                starts[i].decimated = known->to(decimation, interrupter);
            });
        }
        const auto keepAtMost = [&](std::size_t most, const Mesh Candidate::*mesh) {
            const auto hasTooMany = [&](const Candidate& candidate) { return faceCount(candidate.*mesh) > most; };
            starts.erase(std::remove_if(starts.begin(), starts.end(), hasTooMany), starts.end());
        };
        keepAtMost(decimation.faces, &Candidate::decimated);
        TightenOptions tightening = tightenOptions(options.effort);
        if (guard.symmetry()) tightening.perturbations *= 3; // in the time that half a surface saves
        if (options.mesh == CageFaces::triangles) {
            const Stage stage(interrupter, "tighten");
            detail::parallelFor(std::size_t(0), starts.size(), [&](std::size_t i) {
                starts[i].cage = tighten(starts[i].decimated, guard, tightening, interrupter);
            });
        } else {
            const Stage stage(interrupter, "quads");
            constexpr double mostlyQuads = 0.875; // more cost a third of the tightness on models with edges
            BoundingTriquadOptions pairing;
            pairing.mergeAngleDegrees = mergeAngle(options);
            pairing.faces = faces;
            if (options.mesh == CageFaces::quads) pairing.quads = mostlyQuads;
            pairing.tightening = tightening;
            detail::parallelFor(std::size_t(0), starts.size(), [&](std::size_t i) {
                starts[i].cage = triquad(starts[i].decimated, guard, pairing, interrupter);
            });
        }
        keepAtMost(faces, &Candidate::cage);
        if (options.smooth > 0) {
            const Stage stage(interrupter, "smooth");
            detail::parallelFor(std::size_t(0), starts.size(), [&](std::size_t i) {
                starts[i].cage = vdbcage::smooth(starts[i].cage, guard, {options.smooth}, interrupter);
            });
        }
        if (options.mesh == CageFaces::triangles) {
            const Stage stage(interrupter, "bendNearCoplanarEdges");
            for (Candidate& candidate : starts)
                candidate.cage = bendNearCoplanarEdges(candidate.cage, guard, interrupter);
        }
        if (starts.size() > 1) {
            const Stage stage(interrupter, "certify");
            for (Candidate& candidate : starts) {
                candidate.check = checker(interrupter).check(candidate.cage, {}, interrupter);
            }
            std::stable_sort(starts.begin(), starts.end(), [](const Candidate& a, const Candidate& b) {
                return a.check.meanDistance < b.check.meanDistance;
            });
        }
        for (Candidate& candidate : starts) {
            if (certify(candidate.cage, interrupter).bounding()) return std::move(candidate);
        }
        return std::nullopt;
    }

    Candidate makeBox(const CageOptions& options, const BoundingGuard& guard)
    {
        openvdb::BBoxd box = boundingBox(model_);
        box.expand(std::max(2 * guard.clearance(), 0.01 * longestSide(box)));
        Candidate candidate;
        candidate.voxels = ladder(options).back();
        candidate.start = CageStart::box;
        candidate.surface = candidate.smoothed = candidate.decimated = boxMesh(box);
        if (floatSafe_) candidate.decimated = roundedToFloat(std::move(candidate.decimated));
        candidate.topology = analyzeTopology(candidate.surface, nullptr);
        candidate.cage = merged(candidate.decimated, options);
        return candidate;
    }

    Mesh model_;
    bool floatSafe_ = false;
    openvdb::MaskGrid::Ptr solid_, closed_;
    openvdb::FloatGrid::ConstPtr scaleGrid_; // that closed_ was made with: kept, so that no other gets its address
    std::unique_ptr<CageChecker> checker_;
    CageSymmetry soughtSymmetry_ = CageSymmetry::off; // what was asked for `symmetry_`; off: nothing yet
    std::optional<Symmetry> symmetry_;
    std::string solidKey_, closedKey_, cageKey_; // what the values were made with; empty: nothing
    std::unique_ptr<const BoundingGuard> guard_; // of the last run that was bounding
    GuardOptions guardOptions_;                  // that it was made with
    Counted counted_;                            // the last
    std::vector<std::shared_ptr<Start>> starts_; // of the last run, under guard_
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
    // Even the destructors of OpenVDB's trees crash in a task of the host that was cancelled.
    detail::isolated([&] { stages_->run(options, interrupter); });
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
    return detail::isolated([&] { return Pipeline(model).run(options, interrupter); });
}

} // namespace vdbcage
