// More faces make no cage looser: neither in the mean nor at its farthest place. Models with flat sides, which have no
// use for many faces, show it most.
#include <boost/test/data/monomorphic.hpp>
#include <boost/test/data/test_case.hpp>
#include <boost/test/unit_test.hpp>

#include <algorithm>
#include <limits>
#include <ostream>
#include <string>
#include <vector>

#include <support/shapes.h>
#include <vdbcage/check/check.h>
#include <vdbcage/mesh/mesh_io.h>
#include <vdbcage/pipeline/pipeline.h>

using namespace vdbcage;
using openvdb::Vec3d;
using test::box;

namespace {

void requireNeverLooser(const Mesh& model, CageFaces mesh, const std::vector<int>& counts)
{
    Pipeline made(model);
    CageOptions options;
    options.mesh = mesh;
    double mean = std::numeric_limits<double>::infinity(), most = mean;
    for (const int faces : counts) {
        options.faces = faces;
        made.run(options);
        const CageCheck& check = made.report().check;
        BOOST_TEST_CONTEXT(faces << " faces")
        {
            BOOST_TEST(check.bounding());
            BOOST_TEST(check.meanDistance <= mean + options.clearance);
            BOOST_TEST(check.maxDistance <= 1.05 * most + 4 * options.clearance);
        }
        mean = std::min(mean, check.meanDistance);
        most = std::min(most, check.maxDistance);
    }
}

struct FlatModel {
    std::string name;
    std::vector<openvdb::BBoxd> boxes;
};

std::ostream& operator<<(std::ostream& out, const FlatModel& model)
{
    return out << model.name;
}

const std::vector<FlatModel> flatModels{
    {"box", {{{0, 0, 0}, {3, 2, 1}}}},
    {"rod", {{{0, 0, 0}, {10, 1, 1}}}},
    {"slab", {{{0, 0, 0}, {5, 4, 0.2}}}},
    {"ell", {{{0, 0, 0}, {3, 1, 1}}, {{0, 0, 0}, {1, 1, 3}}}},
    {"chair",
     {{{0, 0, 0.9}, {1, 1, 1}},
      {{0, 0.9, 1}, {1, 1, 2}},
      {{0, 0, 0}, {0.1, 0.1, 0.9}},
      {{0.9, 0, 0}, {1, 0.1, 0.9}},
      {{0, 0.9, 0}, {0.1, 1, 0.9}},
      {{0.9, 0.9, 0}, {1, 1, 0.9}}}},
};

} // namespace

BOOST_AUTO_TEST_SUITE(flat_models)

BOOST_DATA_TEST_CASE(more_triangles_are_never_looser, flatModels, flat)
{
    Mesh model;
    for (const openvdb::BBoxd& part : flat.boxes) model = test::joined(std::move(model), box(part.min(), part.max()));
    requireNeverLooser(model, CageFaces::triangles, {25, 50, 100, 200, 400});
}

BOOST_AUTO_TEST_CASE(more_quads_are_never_looser)
{
    requireNeverLooser(box({0, 0, 0}, {3, 2, 1}), CageFaces::quads, {12, 50, 150, 400});
}

BOOST_AUTO_TEST_CASE(a_box_is_met)
{
    for (const CageFaces mesh : {CageFaces::triangles, CageFaces::quads}) {
        Pipeline made(box({0, 0, 0}, {3, 2, 1}));
        CageOptions options;
        options.mesh = mesh;
        for (const int faces : {12, 400}) {
            options.faces = faces;
            made.run(options);
            BOOST_TEST(made.report().check.maxDistance < 5e-4);
        }
    }
}

// The open ones of data/ are not here: a cage spans their holes, where all of it is far from any face.
BOOST_DATA_TEST_CASE(more_faces_are_never_looser_around_others,
                     boost::unit_test::data::make({"bishop", "botijo", "creature"}), name)
{
    const std::string file = std::string(VDBCAGE_MODELS_DIR "/") + name + ".obj";
    requireNeverLooser(readMesh(file), CageFaces::triangles, {50, 100, 200, 400});
}

BOOST_AUTO_TEST_SUITE_END()
