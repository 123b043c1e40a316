// Cages that are symmetric in a plane: across an axis, or in any direction.

#include <boost/test/unit_test.hpp>

#include <algorithm>
#include <cmath>
#include <string>

#include "runs.h"
#include <openvdb/math/Mat3.h>
#include <support/shapes.h>
#include <support/symmetric.h>
#include <vdbcage/check/check.h>
#include <vdbcage/core/detail/grids.h>
#include <vdbcage/core/error.h>
#include <vdbcage/pipeline/pipeline.h>
#include <vdbcage/volume/factor_field.h>

using namespace vdbcage;
using test::coarse;
using test::sameMesh;
using test::saturn;
using test::Watcher;

BOOST_AUTO_TEST_SUITE(symmetric_cages)

BOOST_AUTO_TEST_CASE(a_symmetric_box_that_is_turned_in_its_plane_gets_a_symmetric_box)
{
    const Mesh model = test::turnedAboutZ(test::box({0, 0, 0}, {1, 2, 3}), 30);
    for (const CageFaces mesh : {CageFaces::quads, CageFaces::loops}) {
        CageOptions options;
        options.mesh = mesh;
        options.faces = 10; // the plane cuts four in two
        options.symmetry = CageSymmetry::z;
        Pipeline made(model);
        const Mesh& cage = made.run(options);
        BOOST_REQUIRE(made.report().symmetry);
        BOOST_CHECK(test::isSymmetric(cage, made.report().symmetry->plane));
        BOOST_TEST(cage.quads.size() == 10U);
        BOOST_TEST(cage.triangles.empty());
        BOOST_TEST(made.report().check.meanDistance < 0.001);
    }
}

BOOST_AUTO_TEST_CASE(symmetric_models_get_symmetric_cages)
{
    Mesh model = test::joined(test::torus(1, 0.3, 40, 16), test::sphere({0, 0.2, 1.5}, 0.7, 10));
    for (openvdb::Vec3d& p : model.points) p += openvdb::Vec3d(7.1, -3, 0.25);
    for (const CageFaces kind : {CageFaces::triangles, CageFaces::triquad, CageFaces::quads}) {
        CageOptions options = coarse();
        options.resolution = kind == CageFaces::quads ? 33 : 32; // between voxels, and through their centres
        options.mesh = kind;
        options.smooth = kind == CageFaces::triangles ? 2 : 0;
        options.symmetry = CageSymmetry::automatic;
        Pipeline made(model);
        const Mesh& cage = made.run(options);
        BOOST_REQUIRE(made.report().symmetry);
        const Symmetry found = *made.report().symmetry;
        BOOST_TEST(found.plane.axis == 0);
        BOOST_TEST(std::abs(found.plane.offset - 7.1) < 1e-5);
        BOOST_TEST(found.deviation < 1e-4);
        BOOST_TEST(made.report().noSymmetry == "");
        BOOST_CHECK(test::isSymmetric(cage, found.plane));
        BOOST_TEST(faceCount(cage) <= 200U);
        BOOST_TEST(faceCount(cage) > 180U);
        BOOST_TEST(checkCage(cage, model).bounding());
        BOOST_TEST(made.report().floatSafe);
        if (kind != CageFaces::triangles) continue;
        // Without being asked for there is none.
        options.symmetry = CageSymmetry::off;
        BOOST_CHECK(!test::isSymmetric(made.run(options), found.plane));
        BOOST_CHECK(!made.report().symmetry);
        BOOST_TEST(made.report().noSymmetry == "");
        BOOST_CHECK(sameMesh(made.cage(), makeCage(model, options)));
    }
}

BOOST_AUTO_TEST_CASE(a_plane_that_is_asked_for_is_obeyed)
{
    const Mesh model = test::joined(test::sphere({0, 0, 0}, 1, 12), test::box({1.1, 0.1, 0.2}, {1.6, 0.5, 0.6}));
    CageOptions options = coarse();
    const CageSymmetry planes[] = {CageSymmetry::x, CageSymmetry::y, CageSymmetry::z};
    for (const int axis : {0, 1, 2}) {
        options.symmetry = planes[axis];
        Pipeline made(model);
        const Mesh& cage = made.run(options);
        BOOST_REQUIRE(made.report().symmetry);
        const SymmetryPlane plane = made.report().symmetry->plane;
        BOOST_TEST(plane.axis == axis);
        BOOST_TEST(made.report().symmetry->deviation > 0.01);
        BOOST_CHECK(test::isSymmetric(cage, plane));
        BOOST_TEST(checkCage(cage, model).bounding());
        BOOST_TEST(checkCage(cage, test::mirrored(model, plane)).bounding());
    }
    // None is found, and it is as if none had been looked for.
    options.symmetry = CageSymmetry::automatic;
    Pipeline made(model);
    const Mesh found = made.run(options);
    BOOST_CHECK(!made.report().symmetry);
    const std::string reason = made.report().noSymmetry;
    BOOST_TEST(reason.rfind("the model misses ", 0) == 0U, reason);
    BOOST_TEST(reason.find(" % of its longest side, which is more than 0.5 %: --symmetry") != std::string::npos,
               reason);
    options.symmetry = CageSymmetry::off;
    BOOST_CHECK(sameMesh(found, makeCage(model, options)));
    options.bounding = false;
    made.run(options);
    BOOST_TEST(made.report().noSymmetry == "");
    options.symmetry = CageSymmetry::automatic; // not silently left out
    made.run(options);
    BOOST_TEST(made.report().noSymmetry == "bounding is off");
    options.symmetry = CageSymmetry::x;
    BOOST_CHECK_THROW(made.run(options), InputError);
}

BOOST_AUTO_TEST_CASE(a_model_that_stands_askew_gets_a_symmetric_cage)
{
    const auto turn = openvdb::math::rotation<openvdb::Mat3d>(openvdb::Vec3d(0.6, 0.5, -0.3).unit(), 0.9);
    const openvdb::Vec3d normal = turn * openvdb::Vec3d(1, 0, 0), place(7.1, -3, 0.25);
    Mesh model = test::joined(test::torus(1, 0.3, 40, 16), test::sphere({0, 0.2, 1.5}, 0.7, 10));
    for (openvdb::Vec3d& p : model.points) p = turn * p + place;
    CageOptions options = coarse();
    options.symmetry = CageSymmetry::automatic;
    for (const CageFaces kind : {CageFaces::triangles, CageFaces::quads}) {
        options.mesh = kind;
        Pipeline made(model);
        const Mesh& cage = made.run(options);
        BOOST_CHECK(!made.report().symmetry);
        BOOST_REQUIRE(made.report().tiltedSymmetry);
        const TiltedSymmetry found = *made.report().tiltedSymmetry;
        BOOST_TEST(std::abs(found.normal.dot(normal)) > 1 - 1e-6);
        BOOST_TEST(std::abs(found.offset - found.normal.dot(place)) < 1e-4);
        BOOST_TEST(found.deviation < 1e-3);
        BOOST_TEST(checkCage(cage, model).bounding());
        BOOST_TEST(made.report().floatSafe);
        BOOST_TEST(faceCount(cage) <= 200U);
        // Each point has its image, but for rounding.
        double farthest = 0;
        for (const openvdb::Vec3d& p : cage.points) {
            const openvdb::Vec3d image = p - 2 * (found.normal.dot(p) - found.offset) * found.normal;
            double nearest = 1;
            for (const openvdb::Vec3d& q : cage.points) nearest = std::min(nearest, (q - image).length());
            farthest = std::max(farthest, nearest);
        }
        BOOST_TEST(farthest < 1e-5);
        // What it was made from is where the model is.
        BOOST_TEST(checkCage(made.surface(), model).bounding());
        BOOST_TEST(checkCage(made.decimated(), model).bounding());
        for (const openvdb::Vec3d& p : model.points) {
            for (const auto& mask : {made.solid(), made.closed()}) {
                const openvdb::Coord voxel = mask->transform().worldToIndexCellCentered(p);
                BOOST_REQUIRE(mask->tree().isValueOn(voxel));
            }
        }
        BOOST_CHECK(sameMesh(cage, makeCage(model, options)));
    }
    // A field that varies in space is laid out along the axes.
    options.scale = readFactorField("sphere:7,-3,0,1,2");
    Pipeline made(model);
    made.run(options);
    BOOST_CHECK(!made.report().tiltedSymmetry);
}

BOOST_AUTO_TEST_CASE(models_are_taken_for_symmetric_up_to_the_tolerance)
{
    Mesh model = test::torus(1, 0.3, 40, 16);
    for (openvdb::Vec3d& p : model.points) {
        if (p[0] > 0) p[2] += 0.05 * p[0] * p[1] + 0.02 * p[0]; // misses every plane
        p[1] += 0.04 * p[0] * p[0] * p[0];
    }
    CageOptions options = coarse();
    options.symmetry = CageSymmetry::automatic;
    options.symmetryTolerance = 0.001;
    Pipeline made(model);
    made.run(options);
    BOOST_CHECK(!made.report().symmetry);
    BOOST_CHECK(!made.report().tiltedSymmetry);
    BOOST_TEST(made.report().noSymmetry.find("which is more than 0.1 %") != std::string::npos);
    options.symmetryTolerance = 0.3;
    made.run(options);
    BOOST_CHECK(made.report().symmetry);
    options.symmetryTolerance = 0.4;
    BOOST_CHECK_THROW(made.run(options), InputError);
}

BOOST_AUTO_TEST_CASE(a_plane_that_is_absurd_is_refused_with_its_figure)
{
    Mesh flag = test::box({0, 0, 0}, {0.2, 0.2, 4});
    flag = test::joined(flag, test::box({0.1, 0, 3}, {4, 0.2, 4}));
    CageOptions options = coarse();
    options.symmetry = CageSymmetry::x;
    std::string refusal;
    try {
        makeCage(flag, options);
    } catch (const InputError& error) {
        refusal = error.what();
    }
    const std::string start = "--symmetry: 'x' is not allowed: the model misses x by ";
    BOOST_REQUIRE(refusal.rfind(start, 0) == 0U);
    const double percent = std::stod(refusal.substr(start.size()));
    BOOST_TEST(percent > 30);
    BOOST_TEST(percent < 100);
    BOOST_TEST(refusal.find("; it may be at most 30 %") != std::string::npos, refusal);
    options.symmetry = CageSymmetry::y; // it is flat there
    Pipeline made(flag);
    made.run(options);
    BOOST_TEST(made.report().symmetry.has_value());
}

BOOST_AUTO_TEST_CASE(voxels_are_symmetric_whatever_the_scale_and_are_kept)
{
    CageOptions options = coarse();
    options.symmetry = CageSymmetry::y;
    options.closeRadius = 0.03;
    options.scale = readFactorField("sphere:0,1,0,0.5,0.25");
    Pipeline made(saturn());
    made.run(options);
    BOOST_REQUIRE(made.report().symmetry);
    BOOST_CHECK(test::isSymmetric(made.surface(), made.report().symmetry->plane));
    options.faces = 190;
    Watcher watcher;
    const Mesh again = made.run(options, &watcher);
    BOOST_TEST(watcher.runs["voxelize"] == 0);
    BOOST_TEST(watcher.runs["close"] == 0);
    BOOST_CHECK(sameMesh(again, makeCage(saturn(), options)));
}

BOOST_AUTO_TEST_CASE(symmetric_cages_of_the_fewest_faces)
{
    CageOptions options = coarse();
    options.symmetry = CageSymmetry::automatic;
    options.faces = 12;
    for (const Mesh& model : {saturn(), test::box({0, 0, 0}, {1, 2, 3}), test::torus(1, 0.05, 24, 6)}) {
        Pipeline made(model);
        const Mesh& cage = made.run(options);
        BOOST_TEST(faceCount(cage) <= 12U);
        BOOST_TEST(made.report().check.bounding());
        BOOST_REQUIRE(made.report().symmetry);
        BOOST_CHECK(test::isSymmetric(cage, made.report().symmetry->plane));
    }
}

BOOST_AUTO_TEST_SUITE_END()
