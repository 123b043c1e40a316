// A pipeline that ran before: what it does again, and what it gives.
#include <boost/test/unit_test.hpp>

#include <atomic>
#include <map>
#include <set>
#include <string>

#include "runs.h"
#include <fstream>
#include <openvdb/tools/ChangeBackground.h>
#include <support/cancelled_host.h>
#include <support/option_values.h>
#include <support/shapes.h>
#include <support/temporary_folder.h>
#include <tbb/global_control.h>
#include <vdbcage/check/check.h>
#include <vdbcage/core/error.h>
#include <vdbcage/pipeline/detail/search/bounding_search.h>
#include <vdbcage/pipeline/detail/stages/volumes.h>
#include <vdbcage/pipeline/pipeline.h>
#include <vdbcage/volume/factor_field.h>

using namespace vdbcage;
using test::coarse;
using test::sameMesh;
using test::saturn;
using test::Watcher;

BOOST_AUTO_TEST_SUITE(reruns)

BOOST_AUTO_TEST_CASE(only_stale_stages_run_again)
{
    Pipeline made(saturn());
    CageOptions options = coarse();
    Watcher first;
    made.run(options, &first);
    BOOST_TEST(first.runs["voxelize"] == 2); // once of them to see whether the model is a sheet
    BOOST_TEST(first.runs["close"] == 1);
    const auto solid = made.solid();

    Watcher same;
    made.run(options, &same);
    BOOST_TEST(same.runs.empty());

    for (const auto& change : std::vector<std::pair<std::string, std::string>>{
             {"smooth", "5"}, {"faces", "150"}, {"mesh", "triquad"}, {"merge-angle", "20"}}) {
        setOption(options, change.first, change.second);
        Watcher watcher;
        made.run(options, &watcher);
        BOOST_TEST(watcher.runs["voxelize"] == 0);
        BOOST_TEST(watcher.runs["close"] == 0);
        BOOST_TEST(watcher.runs["decimate"] > 0);
        BOOST_CHECK(sameMesh(made.cage(), makeCage(saturn(), options)));
    }

    setOption(options, "close-radius", "0.05");
    Watcher closing;
    made.run(options, &closing);
    BOOST_TEST(closing.runs["voxelize"] == 0);
    BOOST_TEST(closing.runs["close"] == 1);
    BOOST_CHECK(made.solid() == solid);

    setOption(options, "resolution", "24");
    Watcher voxels;
    made.run(options, &voxels);
    BOOST_TEST(voxels.runs["voxelize"] == 1);
    BOOST_CHECK(sameMesh(made.cage(), makeCage(saturn(), options)));

    for (const char* symmetry : {"auto", "y"}) {
        setOption(options, "symmetry", symmetry);
        Watcher found;
        made.run(options, &found);
        BOOST_TEST(found.runs["symmetry"] == 1);
        options.faces -= 10;
        Watcher kept;
        made.run(options, &kept);
        BOOST_TEST(kept.runs["symmetry"] == 0);
        BOOST_TEST(kept.runs["decimate"] > 0);
        BOOST_CHECK(made.report().symmetry.has_value());
        BOOST_CHECK(sameMesh(made.cage(), makeCage(saturn(), options)));
    }
    setOption(options, "symmetry", "off");
    made.run(options);
    BOOST_CHECK(!made.report().symmetry);
}

BOOST_AUTO_TEST_CASE(a_new_face_count_gives_the_cage_of_a_fresh_run)
{
    const Mesh model = test::joined(test::sphere({0, 0, 0}, 1, 16), test::box({0.5, -0.2, -0.2}, {2, 0.2, 0.2}));
    for (const auto& [effort, counts] : std::vector<std::pair<Effort, std::vector<int>>>{
             {Effort::fast, {150, 400, 70, 90, 400}}, {Effort::fair, {50, 60, 40}}, {Effort::best, {120, 70, 90}}}) {
        CageOptions options;
        options.effort = effort;
        Pipeline made(model);
        for (std::size_t i = 0; i < counts.size(); ++i) {
            options.faces = counts[i];
            Watcher watcher;
            made.run(options, &watcher);
            BOOST_TEST((watcher.runs["surface"] > 0) == (i == 0));
            BOOST_CHECK(sameMesh(made.cage(), makeCage(model, options)));
        }
    }
}

BOOST_AUTO_TEST_CASE(cancelling_throws_and_the_pipeline_runs_again)
{
    const Mesh model = saturn();
    CageOptions options = coarse();
    options.resolution = 16;
    options.faces = 100;
    Watcher whole(1L << 40);
    const Mesh expected = [&] {
        Pipeline made(model);
        return made.run(options, &whole);
    }();
    const long checks = whole.checks;
    BOOST_TEST(checks > 500);
    Pipeline made(model);
    for (int i = 0; i < 50; ++i) {
        Pipeline fresh(model);
        Watcher watcher(checks * i / 50);
        BOOST_CHECK_THROW(fresh.run(options, &watcher), Cancelled);
        BOOST_TEST(watcher.open() == 0);
        Watcher again(checks * i / 100);
        try {
            made.run(options, &again);
        } catch (const Cancelled&) {
        }
    }
    BOOST_CHECK(sameMesh(made.run(options), expected));
}

BOOST_AUTO_TEST_CASE(a_scale_grid_that_is_edited_in_place_counts_anew)
{
    const Mesh model = saturn();
    CageOptions options = coarse();
    options.closeRadius = 0.15; // it closes the gap between ball and ring
    const auto grid = openvdb::FloatGrid::create(1.0F);
    grid->setTransform(openvdb::math::Transform::createLinearTransform(0.25));
    options.scale.grid = grid;
    Pipeline made(model);
    made.run(options);
    const auto edit = [&](auto&& change) {
        change();
        const Mesh again = made.run(options);
        Pipeline fresh(model);
        BOOST_CHECK(sameMesh(again, fresh.run(options)));
        BOOST_TEST(made.report().closedVoxels == fresh.report().closedVoxels);
    };
    const std::size_t before = made.report().closedVoxels;
    edit([&] { grid->fill(openvdb::CoordBBox({-20, -20, -20}, {20, 20, 20}), 0.0F); }); // tiles and leaves
    BOOST_TEST(made.report().closedVoxels < before);
    const std::size_t none = made.report().closedVoxels;
    edit([&] { grid->sparseFill(openvdb::CoordBBox({-8, -8, -8}, {7, 7, 7}), 2.0F); });
    edit([&] { grid->tree().setValue({3, 3, 3}, 0.5F); }); // one voxel
    edit([&] { grid->setTransform(openvdb::math::Transform::createLinearTransform(1e-3)); });
    edit([&] { openvdb::tools::changeBackground(grid->tree(), 0.0F); });
    BOOST_TEST(made.report().closedVoxels == none);
}

BOOST_AUTO_TEST_CASE(a_run_that_throws_leaves_the_last_good_result)
{
    const Mesh model = saturn();
    CageOptions options = coarse();
    Pipeline made(model);
    const Mesh cage = made.run(options);
    const auto closed = made.closed(), solid = made.solid();
    const Mesh surface = made.surface(), decimated = made.decimated();
    const auto isUnchanged = [&] {
        return sameMesh(made.cage(), cage) && sameMesh(made.surface(), surface) &&
               sameMesh(made.decimated(), decimated) && made.closed() == closed && made.solid() == solid &&
               made.report().resolution == *options.resolution && made.report().check.bounding();
    };
    CageOptions other = options;
    other.resolution = *options.resolution + 5;
    other.faces = options.faces + 10;
    for (int i = 0; i < 20; ++i) {
        Watcher watcher(40 * i);
        BOOST_CHECK_THROW(made.run(other, &watcher), Cancelled);
        BOOST_TEST(isUnchanged());
    }
    CageOptions wrong = options;
    wrong.faces = 3;
    BOOST_CHECK_THROW(made.run(wrong), InputError);
    BOOST_TEST(isUnchanged());
    BOOST_CHECK(sameMesh(made.run(options), cage));
}

BOOST_AUTO_TEST_CASE(cages_are_whole_where_the_host_has_cancelled)
{
    const Mesh model = saturn();
    std::vector<CageOptions> runs(4, coarse());
    runs[0].resolution.reset(); // two starts, side by side
    runs[0].faces = 60;
    runs[0].effort = Effort::fast;
    runs[1].mesh = CageFaces::triquad;
    runs[1].symmetry = CageSymmetry::automatic;
    runs[2].scale = readFactorField("sphere:0,0,0,2,0.5");
    runs[2].faces = 12;
    runs[2].parts = CageParts::merge; // from the hull
    runs[3].bounding = false;
    for (const CageOptions& options : runs) {
        const Mesh expected = makeCage(model, options);
        Mesh cage;
        bool isBounding = false;
        test::inCancelledHost([&] {
            cage = makeCage(model, options);
            isBounding = checkCage(cage, model).bounding();
        });
        BOOST_CHECK(sameMesh(cage, expected));
        BOOST_TEST((isBounding || !options.bounding));
    }
}

BOOST_AUTO_TEST_CASE(a_stop_that_only_one_of_several_starts_sees_stops_them_all)
{
    CageOptions options;
    options.faces = 60;
    options.effort = Effort::fast;
    const Mesh model = saturn();
    Watcher whole(1L << 40);
    Pipeline made(model);
    const Mesh expected = made.run(options, &whole);
    /// Says stop once, to whoever asks at that moment.
    struct Once : Interrupter {
        explicit Once(long k) : left(k) {}
        bool wasInterrupted(int) override { return left-- == 0; }
        std::atomic<long> left;
    };
    for (int i = 1; i < 40; ++i) {
        Pipeline fresh(model);
        Once once(whole.checks * i / 40);
        BOOST_CHECK_THROW(fresh.run(options, &once), Cancelled);
        BOOST_CHECK(sameMesh(fresh.run(options), expected));
    }
}

BOOST_AUTO_TEST_CASE(every_option_counts)
{
    const test::TemporaryFolder folder;
    const std::string joints = folder / "knee.joints";
    std::ofstream(joints) << "0 0 0.5\n";
    // Where test::otherValues has none, or its first would change nothing here or take long.
    const std::map<std::string, std::string> given{{"density", "sphere:0,0,1,0.7,8"},
                                                   {"joints", joints},
                                                   {"faces", "110"},
                                                   {"resolution", "20"},
                                                   {"close-radius", "0.2"},
                                                   {"erode-radius", "0.02"},
                                                   {"scale-field", "sphere:0,0,0,5,3"},
                                                   {"smooth", "2"},
                                                   {"mesh", "triangles"},
                                                   {"quad-shape", "0"},
                                                   {"merge-angle", "60"},
                                                   {"symmetry", "x"},
                                                   {"symmetry-tolerance", "0.01"},
                                                   {"interior", "shell"},
                                                   {"clearance", "0.01"},
                                                   {"min-angle", "12"},
                                                   {"precision", "float64"},
                                                   {"least-part", "0.5"},
                                                   {"effort", "fair"}};
    const auto otherValue = [&](const OptionText& option) {
        const auto at = given.find(option.name);
        return at != given.end() ? at->second : test::otherValues(option).at(0);
    };
    Mesh ball = test::sphere({0, 0, 0}, 1, 16);
    ball.quads.resize(ball.quads.size() * 2 / 3);                       // open, so that the interior matters
    const Mesh model = test::joined(ball, test::torus(3, 0.3, 48, 12)); // apart when closed
    const std::set<std::string> idle{"voxelizer", "symmetry-tolerance"};
    CageOptions options = coarse();
    options.resolution = 16;
    options.closeRadius = 0.08;
    options.mesh = CageFaces::triquad; // so that the merge angle matters
    options.faces = 150;               // enough for two parts
    options.effort = Effort::fast;
    Pipeline made(model);
    const Mesh cage = made.run(options);
    for (const OptionText& option : describeOptions()) {
        CageOptions changed = options;
        setOption(changed, option.name, otherValue(option));
        Watcher watcher;
        const Mesh again = made.run(changed, &watcher);
        BOOST_TEST(!watcher.runs.empty(), option.name << " was not looked at");
        BOOST_CHECK(sameMesh(again, makeCage(model, changed)));
        BOOST_TEST(sameMesh(again, cage) == (idle.count(option.name) > 0), option.name << " changes nothing here");
        made.run(options);
    }
}

BOOST_AUTO_TEST_CASE(a_density_puts_faces_where_it_is_above_1)
{
    const Mesh model = test::sphere({0, 0, 0}, 1, 32);
    const auto facesAbove = [](const Mesh& cage) {
        const std::vector<openvdb::Vec3I> faces = triangulate(cage);
        return std::count_if(faces.begin(), faces.end(), [&](const openvdb::Vec3I& t) {
            return cage.points[t[0]].z() + cage.points[t[1]].z() + cage.points[t[2]].z() > 3 * 0.6;
        });
    };
    for (const CageFaces mesh : {CageFaces::triangles, CageFaces::quads, CageFaces::loops}) {
        CageOptions options;
        options.faces = 120;
        options.effort = Effort::fast;
        options.mesh = mesh;
        Pipeline made(model);
        const long before = facesAbove(made.run(options));
        options.density = readFactorField("box:-2,-2,0.6,2,2,2,2", "density");
        Watcher watcher;
        const Mesh denser = made.run(options, &watcher);
        for (const char* stage : {"guard", "voxelize", "close", "surface"}) BOOST_TEST(watcher.runs[stage] == 0, stage);
        BOOST_TEST(10 * facesAbove(denser) >= 14 * before);
        BOOST_TEST(faceCount(denser) <= 120U);
        BOOST_TEST(checkCage(denser, model).bounding());
        BOOST_CHECK(sameMesh(denser, makeCage(model, options)));
        tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
        BOOST_CHECK(sameMesh(denser, makeCage(model, options)));
    }
}

BOOST_AUTO_TEST_CASE(large_surfaces_give_the_same_cages)
{
    const Mesh model = saturn();
    detail::Volumes volumes(model);
    detail::Certifier certifier(model);
    CageOptions options = coarse();
    options.resolution = 48; // and half of it
    options.effort = Effort::fast;
    constexpr std::size_t anySurface = 0, theFiner = 5000; // faces that are large
    for (const auto& [mesh, largest] : {std::pair{CageFaces::triangles, anySurface}, {CageFaces::triquad, theFiner}}) {
        options.mesh = mesh;
        CageOptions other = options;
        other.faces += 50;
        detail::BoundingSearch search(model, volumes, certifier, {}, largest);
        const detail::FieldVersion none;
        search.run({other, none, none, unlimitedMemory, nullptr});
        BOOST_CHECK(
            sameMesh(search.run({options, none, none, unlimitedMemory, nullptr}).cage, makeCage(model, options)));
    }
}

BOOST_AUTO_TEST_SUITE_END()
