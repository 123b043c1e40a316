#include <boost/test/unit_test.hpp>

#include <cmath>
#include <limits>
#include <map>
#include <mutex>
#include <set>

#include "runs.h"
#include <support/shapes.h>
#include <support/temporary_folder.h>
#include <tbb/global_control.h>
#include <vdbcage/check/check.h>
#include <vdbcage/core/detail/grids.h>
#include <vdbcage/core/error.h>
#include <vdbcage/mesh/mesh_io.h>
#include <vdbcage/pipeline/pipeline.h>
#include <vdbcage/volume/factor_field.h>

using namespace vdbcage;
using test::coarse;
using test::sameMesh;
using test::saturn;
using test::Watcher;

BOOST_AUTO_TEST_SUITE(pipeline)

BOOST_AUTO_TEST_CASE(every_cage_is_certified_and_has_no_more_faces_than_asked)
{
    const std::vector<Mesh> models{test::sphere({0, 0, 0}, 1, 12), test::box({0, 0, 0}, {1, 2, 3}),
                                   test::torus(1, 0.3, 40, 16), saturn()};
    for (const Mesh& model : models) {
        for (const int faces : {12, 50, 400}) {
            for (const CageFaces kind : {CageFaces::triangles, CageFaces::triquad}) {
                CageOptions options = coarse();
                options.resolution = 24; // as with 32 no half of it competes
                options.faces = faces;
                options.mesh = kind;
                Pipeline made(model);
                const Mesh& cage = made.run(options);
                BOOST_TEST(faceCount(cage) <= static_cast<std::size_t>(faces));
                BOOST_TEST((kind == CageFaces::triquad || cage.quads.empty()));
                // Examined again here, by a check of its own.
                BOOST_TEST(checkCage(cage, model).bounding());
                BOOST_TEST(made.report().check.bounding());
                BOOST_TEST(made.report().floatSafe);
                for (const openvdb::Vec3d& p : cage.points) {
                    BOOST_TEST(p.x() == static_cast<double>(static_cast<float>(p.x())));
                }
            }
        }
    }
}

BOOST_AUTO_TEST_CASE(cages_of_loops_are_of_quads_only)
{
    const std::vector<Mesh> models{test::sphere({0, 0, 0}, 1, 12), test::box({0, 0, 0}, {1, 2, 3}),
                                   test::torus(1, 0.3, 40, 16), saturn()};
    for (const Mesh& model : models) {
        Pipeline made(model);
        for (const int faces : {6, 50, 150}) {
            CageOptions options;
            options.faces = faces;
            options.mesh = CageFaces::loops;
            options.effort = Effort::fast;
            options.symmetry = faces == 50 ? CageSymmetry::x : CageSymmetry::off;
            const Mesh& cage = made.run(options);
            BOOST_TEST(cage.triangles.empty());
            BOOST_TEST(cage.quads.size() <= static_cast<std::size_t>(faces));
            BOOST_TEST(checkCage(cage, model).bounding());
            BOOST_TEST(made.report().floatSafe);
        }
    }
}

BOOST_AUTO_TEST_CASE(the_cage_of_loops_of_a_brick_is_the_brick)
{
    const Mesh model = test::box({0, 0, 0}, {1, 2, 3});
    CageOptions options;
    options.faces = 6;
    options.mesh = CageFaces::loops;
    Pipeline made(model);
    BOOST_TEST(made.run(options).quads.size() == 6U);
    BOOST_TEST(made.report().check.meanDistance < 0.001);
    BOOST_CHECK(made.report().start != CageStart::box);
}

BOOST_AUTO_TEST_CASE(models_that_are_no_solids_get_cages_too)
{
    Mesh triangle;
    triangle.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    triangle.triangles = {{0, 1, 2}};
    Mesh sheet = test::box({0, 0, 0}, {1, 1, 1});
    sheet.quads.resize(1);
    Mesh bowl = test::sphere({0, 0, 0}, 1, 12);
    bowl.quads.resize(bowl.quads.size() / 2);
    Mesh partlyDegenerate = test::box({0, 0, 0}, {1, 1, 1});
    partlyDegenerate.triangles = {{0, 0, 0}, {1, 1, 2}};
    for (const Mesh& model : {triangle, sheet, bowl, partlyDegenerate}) {
        BOOST_TEST(checkCage(makeCage(model, coarse()), model).bounding());
    }
}

BOOST_AUTO_TEST_CASE(more_effort_does_not_end_in_the_box_where_less_does_not)
{
    CageOptions options = coarse();
    options.resolution = 24;
    options.faces = 12;
    options.parts = CageParts::merge;
    for (const Mesh& model : {saturn(), test::box({0, 0, 0}, {1, 1, 0.2}), test::torus(1, 0.05, 24, 6)}) {
        for (const Effort effort : {Effort::fast, Effort::fair, Effort::best}) {
            options.effort = effort;
            Pipeline made(model);
            made.run(options);
            BOOST_CHECK(made.report().start != CageStart::box);
        }
    }
}

BOOST_AUTO_TEST_CASE(no_angle_is_below_the_floor)
{
    struct Case {
        Effort effort;
        std::optional<double> asked;
        double floor;
    };
    CageOptions options = coarse();
    options.faces = 200;
    for (const Case& c :
         {Case{Effort::fast, {}, 6}, {Effort::fair, {}, 10}, {Effort::best, {}, 6}, {Effort::fair, 4, 4}}) {
        options.effort = c.effort;
        options.minAngle = c.asked;
        double least = 180;
        for (const Mesh& model : {saturn(), test::torus(1, 0.1, 40, 16)}) {
            least = std::min(least, checkCage(makeCage(model, options), model).minAngleDegrees);
        }
        BOOST_TEST(least > c.floor - 0.01);
        BOOST_TEST(least < c.floor + 2); // it is asked for where the shape wants less
    }
}

BOOST_AUTO_TEST_CASE(fast_cages_of_large_surfaces_begin_with_wider_voxels)
{
    const auto ball = [](double y, double z) {
        Mesh mesh = test::sphere({0, 0, 0}, 0.5, 24);
        for (openvdb::Vec3d& p : mesh.points) p *= openvdb::Vec3d(1, y, z);
        return mesh;
    };
    const Mesh slender = ball(0.25, 0.25), between = ball(0.9, 0.6), round = ball(1, 1);
    const auto reported = [](const Mesh& model, Effort effort, int faces, std::optional<int> resolution = {}) {
        CageOptions options;
        options.effort = effort;
        options.faces = faces;
        options.resolution = resolution;
        Pipeline made(model);
        made.run(options);
        return std::pair(made.report().resolution, 2 * faceCount(made.surface()));
    };
    BOOST_TEST(reported(slender, Effort::fast, 200).first == 43);
    const auto [resolution, triangles] = reported(between, Effort::fast, 200);
    BOOST_TEST(resolution < 43);
    BOOST_TEST(resolution > 32);
    BOOST_TEST(static_cast<double>(triangles) == 9000.0, boost::test_tools::tolerance(0.05));
    BOOST_TEST(reported(round, Effort::fast, 200).first == 32); // never by more than a quarter
    BOOST_TEST(std::abs(reported(between, Effort::fast, 4000).first - 2 * resolution) <= 2);
    BOOST_TEST(reported(round, Effort::fair, 200).first == 54);
    BOOST_TEST(reported(round, Effort::fast, 200, 40).first == 40); // what is given is obeyed

    Pipeline made(between);
    CageOptions options;
    options.effort = Effort::fast;
    options.faces = 200;
    made.run(options);
    options.faces = 300;
    Watcher watcher;
    made.run(options, &watcher);
    BOOST_TEST(watcher.runs["voxelize"] == 0);
    BOOST_CHECK(sameMesh(made.cage(), makeCage(between, options)));
}

BOOST_AUTO_TEST_CASE(of_few_faces_the_tighter_of_two_cages_is_kept)
{
    std::set<int> kept;
    const Mesh lollipop = test::joined(test::sphere({0, 0, 0}, 1, 16), test::box({0.5, -0.2, -0.2}, {2, 0.2, 0.2}));
    for (const Mesh& model : {lollipop, test::sphere({0, 0, 0}, 1, 16), test::box({0, 0, 0}, {1, 0.3, 0.02})}) {
        CageOptions options;
        options.effort = Effort::fast;
        options.faces = 50;
        Pipeline made(model);
        made.run(options);
        const double distance = made.report().check.meanDistance;
        for (const int resolution : {28, 22}) {
            options.resolution = resolution;
            Pipeline alone(model);
            alone.run(options);
            BOOST_TEST(distance <= alone.report().check.meanDistance + options.clearance);
            if (made.report().resolution != resolution) continue;
            BOOST_CHECK(sameMesh(made.cage(), alone.cage()));
            kept.insert(resolution);
        }
    }
    BOOST_TEST(kept.size() == 2U);
}

BOOST_AUTO_TEST_CASE(of_few_faces_no_effort_gives_a_looser_cage_than_a_lower_one)
{
    Pipeline made(test::joined(test::sphere({0, 0, 0}, 1, 16), test::box({0.5, -0.2, -0.2}, {2, 0.2, 0.2})));
    const std::pair<CageFaces, int> cases[] = {{CageFaces::triangles, 12},  {CageFaces::triangles, 50},
                                               {CageFaces::triangles, 100}, {CageFaces::quads, 20},
                                               {CageFaces::quads, 50},      {CageFaces::loops, 12}};
    for (const auto& [mesh, faces] : cases) {
        CageOptions options;
        options.mesh = mesh;
        options.faces = faces;
        double before = std::numeric_limits<double>::infinity();
        for (const Effort effort : {Effort::fast, Effort::fair, Effort::best}) {
            options.effort = effort;
            made.run(options);
            const double distance = made.report().check.meanDistance;
            BOOST_TEST(distance <= before, faces << " faces of kind " << static_cast<int>(mesh));
            before = distance;
        }
    }
}

BOOST_AUTO_TEST_CASE(the_cage_of_a_box_is_that_box_and_of_two_boxes_nearly_so)
{
    const Mesh ell = test::joined(test::box({0, 0, 0}, {3, 1, 1}), test::box({0, 0, 0}, {1, 2.5, 1}));
    struct Case {
        Mesh model;
        CageFaces mesh;
        int asked;
        std::size_t faces;
    };
    std::vector<Case> cases;
    for (const Mesh& box : {test::box({0, 0, 0}, {1, 1, 1}), test::turnedAboutZ(test::box({0, 0, 0}, {1, 2, 3}), 30)}) {
        for (const CageFaces mesh : {CageFaces::triquad, CageFaces::quads, CageFaces::loops}) {
            cases.push_back({box, mesh, 6, 6});
        }
        cases.push_back({box, CageFaces::quads, 50, 6});
        cases.push_back({box, CageFaces::triangles, 12, 12});
        cases.push_back({box, CageFaces::triangles, 50, 12});
    }
    for (const double degrees : {0, 30}) {
        cases.push_back({test::turnedAboutZ(ell, degrees), CageFaces::quads, 12, 12});
        cases.push_back({test::turnedAboutZ(ell, degrees), CageFaces::loops, 12, 12});
    }
    for (const Case& c : cases) {
        CageOptions options;
        options.mesh = c.mesh;
        options.faces = c.asked;
        Pipeline made(c.model);
        const Mesh& cage = made.run(options);
        BOOST_TEST(faceCount(cage) <= c.faces);
        BOOST_TEST(cage.triangles.empty() == (c.mesh != CageFaces::triangles));
        BOOST_TEST(made.report().check.meanDistance < 0.001);
        BOOST_TEST(checkCage(cage, c.model).bounding());
    }
}

BOOST_AUTO_TEST_CASE(the_cage_of_a_slender_box_keeps_its_angles)
{
    const Mesh model = test::box({0, 0, 0}, {1, 1, 30});
    for (const auto& [asked, floor] : {std::pair(std::optional<double>(), 6.0), {1.0, 1.0}}) {
        CageOptions options;
        options.faces = 12;
        options.effort = Effort::fast;
        options.minAngle = asked;
        Pipeline made(model);
        made.run(options);
        BOOST_TEST(made.report().check.minAngleDegrees > floor - 0.01);
    }
}

BOOST_AUTO_TEST_CASE(the_fewest_faces_bound_any_model)
{
    Mesh triangle;
    triangle.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    triangle.triangles = {{0, 1, 2}};
    const Mesh plate = test::box({0, 0, 0}, {1, 1, 1e-4});
    const std::vector<CageSymmetry> both{CageSymmetry::off, CageSymmetry::automatic};
    const std::vector<std::pair<Mesh, std::vector<CageSymmetry>>> cases{
        {saturn(), both},
        {test::torus(1, 0.05, 24, 6), both},
        {triangle, both},
        {plate, both},
        {test::transformed(saturn(), 1e-6, {0, 0, 0}), {CageSymmetry::automatic}},
        {test::transformed(saturn(), 1e6, {1e7, 0, 0}), {CageSymmetry::off}}};
    for (const auto& [model, symmetries] : cases) {
        for (const CageFaces mesh : {CageFaces::triangles, CageFaces::triquad, CageFaces::quads, CageFaces::loops}) {
            for (const CageSymmetry symmetry : symmetries) {
                CageOptions options;
                options.effort = Effort::fast;
                options.mesh = mesh;
                options.symmetry = symmetry;
                for (int faces = leastFaces(mesh); faces < leastFaces(mesh) + 3; faces += 2) {
                    options.faces = faces;
                    Pipeline made(model);
                    const Mesh& cage = made.run(options);
                    BOOST_TEST(faceCount(cage) <= static_cast<std::size_t>(faces));
                    BOOST_TEST(checkCage(cage, model).bounding());
                    BOOST_TEST(made.report().floatSafe);
                    BOOST_TEST((made.report().start != CageStart::box), faces << " faces of kind "
                                                                              << static_cast<int>(mesh) << " around "
                                                                              << boundingBox(model));
                }
            }
        }
    }
}

// Up and down. Few faces have several starts, all kept.
BOOST_AUTO_TEST_CASE(what_no_closing_joins_is_shrunk_from_its_hull)
{
    // A flat triangle: its box has twice the volume.
    const Mesh model = test::joined(test::joined(test::sphere({0, 0, 0}, 0.5, 8), test::sphere({9, 0, 0}, 0.5, 8)),
                                    test::sphere({0, 9, 0}, 0.5, 8));
    CageOptions options;
    options.parts = CageParts::merge;
    Pipeline made(model);
    // The second run knows the hull, and tries other closings before.
    for (const auto& [effort, faces] : {std::pair(Effort::fast, 30), std::pair(Effort::best, 250)}) {
        options.effort = effort;
        options.faces = faces;
        made.run(options);
        const CageReport& report = made.report();
        BOOST_CHECK(report.start == CageStart::hull);
        BOOST_TEST(report.check.volumeRatio < 32);
        BOOST_TEST(report.check.components == 1U);
        for (const auto& stage : {made.solid(), made.closed()}) {
            BOOST_TEST(stage->voxelSize()[0] * report.resolution == 10, boost::test_tools::tolerance(1e-9));
        }
        BOOST_CHECK(sameMesh(made.cage(), makeCage(model, options)));
    }
}

BOOST_AUTO_TEST_CASE(scaled_and_moved_models_get_the_scaled_and_moved_cage)
{
    const Mesh model = saturn();
    const std::size_t faces = faceCount(makeCage(model, coarse()));
    const std::vector<std::pair<double, openvdb::Vec3d>> maps{
        {1e-6, {0, 0, 0}}, {1e6, {0, 0, 0}}, {1, {-1000, -1000, -1000}}, {1e-6, {-1000, 0, 0}}, {1e6, {-1000, 5, 1e7}}};
    for (const auto& map : maps) {
        const Mesh changed = test::transformed(model, map.first, map.second);
        Pipeline made(changed);
        const Mesh& cage = made.run(coarse());
        BOOST_TEST(faceCount(cage) == faces);
        BOOST_TEST(checkCage(cage, changed).bounding());
    }
    // A power of two and no move round nothing: the very same cage.
    BOOST_CHECK(sameMesh(test::transformed(makeCage(model, coarse()), 8, {0, 0, 0}),
                         makeCage(test::transformed(model, 8, {0, 0, 0}), coarse())));
}

BOOST_AUTO_TEST_CASE(the_number_of_threads_does_not_matter)
{
    CageOptions options = coarse();
    options.mesh = CageFaces::triquad;
    const Mesh many = makeCage(saturn(), options);
    const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
    BOOST_CHECK(sameMesh(many, makeCage(saturn(), options)));
}

BOOST_AUTO_TEST_CASE(without_bounding_the_cage_is_reported_as_it_is)
{
    CageOptions options = coarse();
    options.bounding = false;
    const Mesh model = test::sphere({0, 0, 0}, 1, 24);
    Pipeline made(model);
    made.run(options);
    BOOST_TEST(made.report().offsetVoxels == 0);
    BOOST_TEST(made.report().check.valid());
    const double free = made.report().check.meanDistance;
    options.bounding = true;
    made.run(options);
    BOOST_TEST(made.report().check.bounding());
    BOOST_TEST(free > made.report().check.meanDistance); // the guarded operators are tighter, too
}

BOOST_AUTO_TEST_CASE(a_clearance_moves_what_cages_are_made_of_no_farther_than_it_must)
{
    const Mesh model = test::sphere({0, 0, 0}, 1, 24);
    const CageChecker checker(model);
    const double voxel = 2.0 / 32;
    for (const CageSymmetry symmetry : {CageSymmetry::off, CageSymmetry::x}) {
        CageOptions options = coarse();
        options.symmetry = symmetry;
        const auto distance = [&](double clearance) {
            options.clearance = clearance / 2; // it is a fraction of the longest side
            Pipeline made(model);
            made.run(options);
            BOOST_TEST(made.report().check.bounding());
            BOOST_TEST(made.report().offsetVoxels == std::floor(clearance / voxel));
            const CageCheck start = checker.check(made.surface());
            BOOST_TEST(2 * start.minDistance >= clearance);
            return 2 * start.meanDistance;
        };
        const double least = distance(1e-5 * voxel), some = distance(0.05 * voxel);
        BOOST_TEST(least < some);
        BOOST_TEST(some - least < 0.2 * voxel);
        BOOST_TEST(distance(1.5 * voxel) - least < 2 * voxel);
    }
}

BOOST_AUTO_TEST_CASE(more_smoothing_is_rounder)
{
    CageOptions options = coarse();
    options.bounding = false;
    options.faces = 100000;
    const Mesh model = test::box({0, 0, 0}, {1, 1, 1});
    std::vector<double> volumes;
    for (const int iterations : {0, 3, 9}) {
        options.smooth = iterations;
        Pipeline made(model);
        made.run(options);
        volumes.push_back(made.report().check.cageVolume);
    }
    BOOST_TEST(volumes[0] > volumes[1]);
    BOOST_TEST(volumes[1] > volumes[2]);
}

BOOST_AUTO_TEST_CASE(what_is_left_to_the_pipeline_is_in_its_report)
{
    const Mesh model = test::box({0, 0, 0}, {1, 1, 1});
    CageOptions options = coarse();
    options.mesh = CageFaces::quads;
    Pipeline made(model);
    made.run(options);
    BOOST_TEST(made.report().resolution == 32);
    BOOST_TEST(made.report().closeRadius == 0.03);
    BOOST_TEST(made.report().erodeRadius == 0.03);
    BOOST_TEST(made.report().minAngle.value() == 6);
    BOOST_TEST(made.report().mergeAngle.value() == 90);
    BOOST_TEST(made.report().smooth == 0);
    options.bounding = false;
    options.closeRadius = 0.1;
    options.erodeRadius = 0.05;
    options.mesh = CageFaces::triangles;
    made.run(options);
    BOOST_TEST(made.report().closeRadius == 0.1);
    BOOST_TEST(made.report().erodeRadius == 0.05);
    BOOST_TEST(!made.report().minAngle.has_value());
    BOOST_TEST(!made.report().mergeAngle.has_value());
    BOOST_TEST(made.report().smooth == 3);
    const Mesh cage = made.cage();
    options.smooth = 3;
    BOOST_CHECK(sameMesh(made.run(options), cage));
}

// The help once promised an offset by the erode radius with bounding on, too, where tightening takes it back.
BOOST_AUTO_TEST_CASE(room_around_the_model_is_left_as_the_options_say)
{
    const Mesh model = test::sphere({0, 0, 0}, 1, 24);
    const double offset = 0.1; // of the longest side, as distances are
    CageOptions closed = coarse();
    closed.closeRadius = 0.1;
    CageOptions lessEroded = closed;
    lessEroded.erodeRadius = 0;
    std::string help;
    for (const OptionText& option : describeOptions()) {
        if (option.name == "erode-radius") help = option.help;
    }
    BOOST_TEST(help.find("offset without bounding") != std::string::npos, help);
    const auto meanDistance = [&](CageOptions options, bool bounding) {
        options.bounding = bounding;
        return checkCage(Pipeline(model).run(options), model).meanDistance;
    };
    BOOST_TEST(meanDistance(lessEroded, false) - meanDistance(closed, false) > 0.7 * offset);
    BOOST_TEST(meanDistance(lessEroded, true) - meanDistance(closed, true) < 0.05 * offset);
    CageOptions apart = closed;
    apart.clearance = 0.1;
    const CageCheck check = checkCage(Pipeline(model).run(apart), model);
    BOOST_TEST(check.bounding());
    BOOST_TEST(check.minDistance >= offset);
}

BOOST_AUTO_TEST_CASE(the_smoothed_stage_is_what_smoothing_gave)
{
    CageOptions options = coarse();
    Pipeline made(saturn());
    made.run(options);
    BOOST_TEST(faceCount(made.smoothed()) == faceCount(made.cage()));
    const Mesh sharp = made.smoothed();
    options.smooth = 9;
    made.run(options);
    BOOST_TEST(faceCount(made.smoothed()) == faceCount(made.cage()));
    BOOST_CHECK(!sameMesh(made.smoothed(), sharp));
    options.bounding = false;
    made.run(options);
    BOOST_TEST(faceCount(made.smoothed()) == faceCount(made.surface()));
    BOOST_CHECK(!sameMesh(made.smoothed(), made.surface()));
}

/// Bars side by side on two others: how many holes are left between them depends on the width of the voxels.
Mesh grille()
{
    Mesh mesh = test::joined(test::box({0, 0, 0}, {10, 0.4, 0.4}), test::box({0, 7, 0}, {10, 7.4, 0.4}));
    for (int i = 0; i < 10; ++i) mesh = test::joined(mesh, test::box({i + 0.1, 0, 0.2}, {i + 0.5, 7.4, 0.6}));
    return mesh;
}

BOOST_AUTO_TEST_CASE(twice_the_resolution_never_gives_a_looser_cage)
{
    for (const CageFaces mesh : {CageFaces::triangles, CageFaces::triquad}) {
        bool wasHalfTaken = false;
        double least = 1;
        for (const int resolution : {32, 64, 128}) {
            CageOptions options;
            options.faces = 160;
            options.effort = Effort::fast;
            options.mesh = mesh;
            options.resolution = resolution;
            Pipeline made(grille());
            made.run(options);
            BOOST_TEST(made.report().check.meanDistance <= least);
            least = made.report().check.meanDistance;
            wasHalfTaken = wasHalfTaken || made.report().resolution < resolution;
        }
        BOOST_TEST(wasHalfTaken);
    }
}

BOOST_AUTO_TEST_CASE(where_gaps_are_half_of_the_automatic_resolution_competes)
{
    constexpr int automaticResolution = 54, half = 27; // of Effort::fair, up to 1000 faces
    bool wasHalfTaken = false;
    for (const int faces : {160, 300, 500}) {
        CageOptions options;
        options.faces = faces;
        options.symmetry = CageSymmetry::off;
        Pipeline made(grille());
        made.run(options);
        const CageReport automatic = made.report();
        wasHalfTaken = wasHalfTaken || automatic.resolution == half;
        for (const int resolution : {automaticResolution, half}) {
            options.resolution = resolution;
            made.run(options);
            BOOST_TEST(automatic.check.meanDistance <= made.report().check.meanDistance);
        }
    }
    BOOST_TEST(wasHalfTaken);
}

BOOST_AUTO_TEST_CASE(unusable_models_and_options_are_refused_before_any_work)
{
    BOOST_CHECK_THROW(Pipeline(Mesh{}), InputError);
    Mesh bad = test::box({0, 0, 0}, {1, 1, 1});
    bad.points[3].x() = std::nan("");
    BOOST_CHECK_THROW(makeCage(bad), InputError);
    CageOptions options;
    options.faces = 3;
    BOOST_CHECK_THROW(makeCage(test::box({0, 0, 0}, {1, 1, 1}), options), InputError);
}

BOOST_AUTO_TEST_CASE(a_cage_bounds_its_model_however_another_program_splits_the_polygons)
{
    const test::TemporaryFolder folder;
    const std::string crumpled = "OFF\n9 3 0\n0 0 0\n2 0 0.9\n0.4 0.4 0\n0 2 -0.8\n" // a concave quad
                                 "3 0 0\n4 0 1\n5 1 0\n4 2 1.2\n3 2 -0.3\n"          // with more, crumpled pentagons
                                 "4 0 1 2 3\n5 4 5 6 7 8\n5 1 4 8 3 2\n";
    test::writeText(folder / "crumpled.off", crumpled);
    const Mesh model = readMesh(folder / "crumpled.off");
    BOOST_TEST(model.quads.empty());
    Mesh everything{model.points, {}, {}};
    const std::vector<openvdb::Index32> faces[] = {{0, 1, 2, 3}, {4, 5, 6, 7, 8}, {1, 4, 8, 3, 2}};
    for (const auto& face : faces) {
        for (std::size_t i = 0; i < face.size(); ++i) {
            for (std::size_t j = i + 1; j < face.size(); ++j) {
                for (std::size_t k = j + 1; k < face.size(); ++k) {
                    everything.triangles.emplace_back(face[i], face[j], face[k]);
                }
            }
        }
    }
    for (const int count : {20, 100, 400}) {
        CageOptions options;
        options.faces = count;
        options.effort = Effort::fast;
        BOOST_TEST(checkCage(makeCage(model, options), everything).bounding());
    }
}

BOOST_AUTO_TEST_CASE(a_scale_field_keeps_a_handle_that_closes_otherwise)
{
    // Two rings side by side; a close radius that fills both.
    Mesh right = test::torus(1, 0.4, 40, 16);
    for (openvdb::Vec3d& point : right.points) point.x() += 4;
    const Mesh model = test::joined(test::torus(1, 0.4, 40, 16), right);
    CageOptions options = coarse();
    options.resolution = 48;
    options.faces = 400;
    options.closeRadius = 0.14;
    Pipeline pipeline(model);
    pipeline.run(options);
    BOOST_TEST(pipeline.report().solidParts == 2U);
    BOOST_TEST(pipeline.report().solidHandles == 2);
    BOOST_TEST(pipeline.report().parts == 1U);
    BOOST_TEST(pipeline.report().handles == 0);
    FactorRegion region;
    region.lower = openvdb::Vec3d(0, 0, 0);
    region.radius = 1.2;
    region.factor = 0;
    options.scale.regions = {region};
    pipeline.run(options);
    BOOST_TEST(pipeline.report().handles == 1);
    BOOST_TEST(pipeline.report().check.bounding());
    BOOST_TEST(pipeline.report().check.genus == 1);
    // Another field of a program's own, and the same closing again without one.
    options.scale.regions[0].lower.x() = 4;
    pipeline.run(options);
    BOOST_TEST(pipeline.report().handles == 1);
    BOOST_CHECK(!pipeline.closed()->tree().isValueOn(
        openvdb::Coord::round(pipeline.closed()->worldToIndex(openvdb::Vec3d(4, 0, 0)))));
    options.scale = {};
    pipeline.run(options);
    BOOST_TEST(pipeline.report().handles == 0);
}

BOOST_AUTO_TEST_CASE(cavities_are_filled_and_reported)
{
    // A hollow cube with a hole in its top that the closing shuts.
    Mesh model = test::box({0, 0, 0}, {1, 1, 0.15});
    for (const auto& wall : {test::box({0, 0, 0}, {0.15, 1, 1}), test::box({0.85, 0, 0}, {1, 1, 1}),
                             test::box({0, 0, 0}, {1, 0.15, 1}), test::box({0, 0.85, 0}, {1, 1, 1}),
                             test::box({0, 0, 0.85}, {0.45, 1, 1}), test::box({0.55, 0, 0.85}, {1, 1, 1}),
                             test::box({0, 0, 0.85}, {1, 0.45, 1}), test::box({0, 0.55, 0.85}, {1, 1, 1})}) {
        model = test::joined(model, wall);
    }
    CageOptions options = coarse();
    options.closeRadius = 0.1;
    Pipeline pipeline(model);
    pipeline.run(options);
    BOOST_TEST(pipeline.report().cavitiesFilled == 1U);
    BOOST_TEST(pipeline.report().modelHollows == 0U); // its hollow was open
    BOOST_TEST(pipeline.report().parts == 1U);
}

BOOST_AUTO_TEST_CASE(progress_grows_in_every_long_stage)
{
    struct Recorder : Interrupter {
        void start(const char* name) override
        {
            stage = name;
            last = 0;
            grows.try_emplace(stage, true);
        }
        bool wasInterrupted(int percent) override
        {
            if (percent < 0) return false;
            const std::lock_guard lock(mutex);
            grows[stage] = grows[stage] && percent >= last && percent <= 100;
            last = std::max(last, percent);
            farthest[stage] = std::max(farthest[stage], percent);
            ++times[stage];
            return false;
        }
        std::mutex mutex;
        std::string stage;
        int last = 0;
        std::map<std::string, bool> grows;
        std::map<std::string, int> farthest, times;
    };
    const Mesh model = test::torus(1, 0.3, 40, 16);
    const std::vector<std::pair<CageFaces, std::vector<std::string>>> kinds{
        {CageFaces::triangles, {"decimate", "tighten"}},
        {CageFaces::quads, {"decimate", "quads"}},
        {CageFaces::loops, {"loops"}}};
    for (const Effort effort : {Effort::fair, Effort::best}) {
        for (const auto& [kind, stages] : kinds) {
            CageOptions options = coarse();
            options.mesh = kind;
            options.effort = effort;
            Recorder recorder;
            makeCage(model, options, &recorder);
            for (const std::string& stage : stages) {
                BOOST_TEST(recorder.farthest[stage] >= 50, stage);
                BOOST_TEST(recorder.times[stage] >= 2, stage);
                BOOST_TEST(recorder.grows[stage], stage);
            }
        }
    }
}

BOOST_AUTO_TEST_CASE(cages_of_sheets_are_flat)
{
    Mesh sheet; // an L that lies askew
    const auto turn = openvdb::math::rotation<openvdb::Mat3d>(openvdb::Vec3d(0.6, 0.5, -0.3).unit(), 0.9);
    for (const openvdb::Vec3d& p :
         {openvdb::Vec3d(0, 0, 0), {2, 0, 0}, {2, 0.6, 0}, {0.6, 0.6, 0}, {0.6, 3, 0}, {0, 3, 0}}) {
        sheet.points.push_back(turn * p);
    }
    sheet.quads = {{0, 1, 2, 3}, {0, 3, 4, 5}};
    CageOptions options;
    options.effort = Effort::fast;
    const auto distance = [&] {
        Pipeline made(sheet);
        made.run(options);
        BOOST_TEST(made.report().check.bounding());
        return made.report().check.meanDistance;
    };
    BOOST_TEST(distance() < 7e-4);
    options.minAngle = 6; // as other models have
    BOOST_TEST(distance() > 7e-4);
}

BOOST_AUTO_TEST_SUITE_END()
