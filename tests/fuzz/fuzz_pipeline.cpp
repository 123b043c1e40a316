// Small models of every bad kind, and options: a model or options that are refused are refused in one line. Every other
// run gives a cage with few enough faces that other code than the guard certifies, and a second run with other options
// gives what a fresh one would.

#include <cmath>
#include <cstddef>
#include <cstdint>

#include <fuzz/bytes.h>
#include <pipeline/runs.h>
#include <support/symmetric.h>
#include <vdbcage/core/error.h>
#include <vdbcage/pipeline/pipeline.h>

using namespace vdbcage;
using fuzz::Choices;
using fuzz::require;
using openvdb::Vec3d;

namespace {

Vec3d pointOf(Choices& choices, std::vector<Vec3d>& before)
{
    switch (choices.below(8)) {
    case 0: // at one place with another
        if (!before.empty()) return choices.of(before);
        return {0, 0, 0};
    case 1: // needles, and sheets that nearly lie in each other
        if (!before.empty()) {
            const Vec3d near = choices.of(before);
            const double distance = choices.small();
            return near + distance * choices.direction();
        }
        return {0, 0, 0};
    case 2: // in one plane
        return {2 * choices.share() - 1, 2 * choices.share() - 1, 0};
    case 3: // on a lattice
        return {double(choices.below(4)), double(choices.below(4)), double(choices.below(4))};
    case 4: // huge and tiny ones in one model
        if (choices.oneIn(4)) {
            const double size = std::pow(10.0, choices.between(-40, 6));
            return size * choices.direction();
        }
        return choices.direction();
    case 5: // any, also none
        if (choices.oneIn(8)) return {choices.any<double>(), choices.any<double>(), choices.any<double>()};
        return choices.direction();
    default:
        return choices.direction();
    }
}

Mesh modelOf(Choices& choices)
{
    Mesh model;
    const int points = 3 + choices.below(38), faces = 1 + choices.below(30);
    for (int i = 0; i < points; ++i) model.points.push_back(pointOf(choices, model.points));
    const auto corner = [&] {
        if (choices.any<std::uint8_t>() == 255) return choices.any<std::uint32_t>(); // hardly ever one that there is
        return static_cast<openvdb::Index32>(choices.below(points));
    };
    for (int i = 0; i < faces; ++i) {
        if (choices.oneIn(3)) {
            model.quads.push_back({corner(), corner(), corner(), corner()});
        } else {
            model.triangles.push_back({corner(), corner(), corner()});
        }
    }
    if (choices.oneIn(4)) model = test::joined(model, test::mirrored(model, {choices.below(3), choices.share()}));
    if (choices.oneIn(4)) {
        const double size = std::pow(10.0, choices.between(-30.0, 30.0));
        const double from = std::pow(10.0, choices.between(-3, 8)) * size;
        const Vec3d to = choices.direction();
        model = test::transformed(model, size, choices.oneIn(2) ? Vec3d(0) : from * to);
    }
    return model;
}

template <typename Name>
Name named(Choices& choices, int count)
{
    return static_cast<Name>(choices.below(count));
}

FactorField fieldOf(Choices& choices)
{
    FactorField field;
    FactorRegion region;
    region.shape = named<FactorRegion::Shape>(choices, 2);
    region.lower = choices.direction();
    region.upper = region.lower + 2.0 * choices.direction();
    region.radius = 2 * choices.share();
    region.factor = 8 * choices.share();
    field.regions.push_back(region);
    return field;
}

/// In half of the runs the lesser options are as by default.
CageOptions optionsOf(Choices& choices)
{
    CageOptions options;
    options.faces = choices.between(4, 80);
    options.mesh = choices.oneIn(8) ? CageFaces::loops : named<CageFaces>(choices, 3);
    // Loops take seconds where others take a tenth of one. They compete where quads are few, but not with Effort::fast.
    const bool areLoops = options.mesh == CageFaces::loops;
    const bool mayBeLoops = areLoops || (options.mesh != CageFaces::triangles && options.faces <= 24);
    // What takes long is rare: under sanitizers a run with Effort::fair can take half a minute.
    options.resolution = choices.between(8, areLoops ? 10 : 14);
    options.effort = !mayBeLoops && choices.oneIn(8) ? Effort::fair : Effort::fast;
    options.symmetry = choices.oneIn(2) ? named<CageSymmetry>(choices, 5) : CageSymmetry::off;
    options.bounding = !choices.oneIn(4);
    options.voxelizer = Voxelizer::cpu;
    if (choices.oneIn(2)) return options;
    if (choices.oneIn(2)) options.closeRadius = 0.25 * choices.share();
    if (choices.oneIn(4)) options.erodeRadius = options.closeRadius.value_or(0) * choices.share();
    if (choices.oneIn(4)) options.element = StructuringElement::cube;
    if (choices.oneIn(4)) options.scale = fieldOf(choices);
    if (choices.oneIn(4)) options.density = fieldOf(choices);
    if (choices.oneIn(4)) options.joints.list.push_back({choices.direction(), {}});
    if (!options.joints.list.empty() && choices.oneIn(2)) options.joints.list[0].axis = choices.direction();
    if (choices.oneIn(4)) options.smooth = choices.below(6);
    if (choices.oneIn(4)) options.parts = CageParts::merge;
    if (choices.oneIn(4)) options.clearance = std::pow(10.0, choices.between(-7.0, -1.0));
    if (choices.oneIn(4)) options.minAngle = 30 * choices.share();
    if (choices.oneIn(4)) options.quadShape = choices.share();
    if (choices.oneIn(4)) options.mergeAngle = 180 * choices.share();
    if (choices.oneIn(4)) options.symmetryTolerance = 0.3 * choices.share();
    options.interior = named<Interior>(choices, 3);
    return options;
}

/// Whether it was not refused.
bool run(Pipeline& pipeline, const CageOptions& options)
{
    try {
        pipeline.run(options);
        return true;
    } catch (const InputError& error) {
        fuzz::requireOneLine(error.what());
        return false;
    }
}

void requireRight(const Pipeline& pipeline, const CageOptions& options)
{
    const Mesh& cage = pipeline.cage();
    const CageReport& report = pipeline.report();
    for (const Vec3d& p : cage.points) require(p.isFinite());
    require(options.mesh != CageFaces::triangles || cage.quads.empty());
    require(options.mesh != CageFaces::loops || cage.triangles.empty());
    if (!options.bounding) return;
    require(cage.triangles.size() + cage.quads.size() <= static_cast<std::size_t>(options.faces));
    const CageChecker checker(pipeline.model());
    CheckOptions check;
    check.measure = false;
    require(checker.check(cage, check).bounding());
    check.asFloats = true;
    if (report.floatSafe) require(checker.check(cage, check).bounding());
    if (report.symmetry) require(test::isSymmetric(cage, report.symmetry->plane));
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    Choices choices(data, size);
    const bool isTwice = choices.oneIn(4);
    const CageOptions first = optionsOf(choices);
    CageOptions second = first;
    if (isTwice) second = choices.oneIn(2) ? optionsOf(choices) : first;
    if (isTwice) second.faces = choices.between(4, 80);
    const Mesh model = modelOf(choices);
    try {
        requireUsable(model, "fuzz");
    } catch (const InputError& error) {
        fuzz::requireOneLine(error.what());
        return 0;
    }
    Pipeline pipeline(model);
    if (!run(pipeline, first)) return 0;
    requireRight(pipeline, first);
    if (!isTwice) return 0;
    Pipeline fresh(model);
    const bool isMade = run(pipeline, second);
    require(isMade == run(fresh, second));
    if (!isMade) return 0;
    require(test::sameMesh(pipeline.cage(), fresh.cage()));
    requireRight(pipeline, second);
    return 0;
}
