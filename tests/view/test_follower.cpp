// The model as it follows a pose, and the verdict on it.
#include <boost/test/unit_test.hpp>

#include <cmath>

#include "orders.h"
#include <support/shapes.h>
#include <support/temporary_folder.h>
#include <tools/view/state/follower.h>
#include <tools/view/state/model_values.h>
#include <tools/view/state/move.h>
#include <tools/view/state/posing.h>
#include <tools/view/state/session.h>
#include <tools/view/state/words.h>
#include <vdbcage/core/error.h>
#include <vdbcage/deform/inversions.h>
#include <vdbcage/deform/weights_io.h>

using namespace vdbcage;
using namespace vdbcage::view;
using openvdb::Vec3d;

namespace {

struct Fixture {
    test::TemporaryFolder folder;
    const MeshPtr cage = std::make_shared<const Mesh>(test::torus(2, 0.6, 16, 8));
    const OpenedMeshPtr model = test::opened(test::torus(2, 0.3, 48, 24));
    Session session;
    Follower follower{bindingWork(), [] {}};

    Fixture()
    {
        State state;
        state.document.model = model;
        session.restart(state);
        session.setCage(cage);
        run("mode pose");
        run("select points 0 1 2 3 4 5 6 7 8 9 10 11 12");
    }
    void run(const std::string& line) { session.execute(commandOf(wordsOf(line))); }
    std::vector<Vec3d> points() const { return cagePoints(session.state()); }
    void follow(Follower::Effort effort = {true, true, true})
    {
        for (follower.follow(session.state(), points(), effort); !follower.isSettled();
             follower.follow(session.state(), points(), effort)) {
            follower.waitForNews(1);
            follower.update();
        }
        follower.follow(session.state(), points(), effort);
    }
};

} // namespace

BOOST_FIXTURE_TEST_SUITE(follower, Fixture)

BOOST_AUTO_TEST_CASE(it_is_posed_as_the_binding_poses_it_by_every_family)
{
    follow();
    BOOST_TEST(!follower.model().bound()); // at rest
    BOOST_TEST(!follower.check());
    run("move 0.3 0.2 0.1");
    for (const char* const family : {"mvc", "green", "mlc", "harmonic"}) {
        run(std::string("coordinates ") + family);
        follow();
        const Binding binding(*cage, model->mesh.points, coordinatesNamed(family));
        BOOST_TEST(follower.model().points() == binding.pose(points()), boost::test_tools::per_element());
        BOOST_TEST_REQUIRE(follower.check());
        BOOST_TEST(!follower.check()->inverted);
        run("model-colours inverted");
        follow();
        BOOST_TEST_REQUIRE(follower.check()->inverted.has_value());
        BOOST_TEST((*follower.check()->inverted == invertedTriangles(binding, model->mesh, {points()}).front()));
        run("model-colours stretch");
        follow();
        BOOST_TEST((*follower.values() == stretch(model->mesh, follower.model().points())));
        run("model-colours plain");
    }
    BOOST_TEST(follower.error().empty());
}

BOOST_AUTO_TEST_CASE(a_pose_through_itself_is_not_valid_and_turns_triangles_inside_out)
{
    run("model-colours inverted");
    run("move 0.01 0 0");
    follow();
    BOOST_TEST(follower.check()->isValid);
    BOOST_TEST(follower.check()->inverted->empty());
    BOOST_TEST((*follower.values() == std::vector<double>(model->mesh.points.size(), 0)));
    run("move -5 0 0");
    follow();
    BOOST_TEST(!follower.check()->isValid);
    BOOST_TEST(follower.check()->selfIntersections > 0u);
    const std::vector<std::uint32_t>& inverted = *follower.check()->inverted;
    BOOST_TEST_REQUIRE(!inverted.empty());
    BOOST_TEST((*follower.values() == cornersOf(inverted, model->mesh)));
    BOOST_TEST((*follower.values())[triangulate(model->mesh)[inverted[0]][1]] == 1);
    // While it moves nothing is checked.
    run("move 0 0 1");
    follow({true, true, false});
    BOOST_TEST(!follower.check());
    BOOST_TEST(follower.model().points() == Binding(*cage, model->mesh.points, Coordinates::meanValue).pose(points()),
               boost::test_tools::per_element());
    follow({false, false, false});
    BOOST_TEST(!follower.model().bound());
}

BOOST_AUTO_TEST_CASE(a_count_that_was_stopped_is_begun_anew)
{
    run("model-colours inverted");
    run("move -5 0 0");
    follow();
    const PoseCheckPtr first = follower.check();
    for (int i = 0; i < 20; ++i) {
        run("coordinates mlc");
        const Follower::Effort effort{true, true, true};
        for (follower.follow(session.state(), points(), effort); !follower.isChecking();
             follower.follow(session.state(), points(), effort)) {
            follower.waitForNews(1);
            follower.update();
        }
        run("coordinates mvc");
        follow();
        BOOST_TEST_REQUIRE(follower.check());
        BOOST_TEST((follower.check()->inverted == first->inverted));
    }
}

BOOST_AUTO_TEST_CASE(weights_from_a_file_pose_it)
{
    const std::vector<Vec3d>& rest = model->mesh.points;
    const auto path = (folder / "w.npy").string();
    const std::vector<float> weights = computeWeights(*cage, rest, Coordinates::maximumLikelihood);
    writeWeights(*cage, rest, Coordinates::maximumLikelihood, weights, path);
    run("move 0.3 0.2 0.1");
    run("open-weights " + quotedWord(path));
    follow();
    BOOST_TEST(follower.model().points() == Binding(*cage, rest, Coordinates::maximumLikelihood).pose(points()),
               boost::test_tools::per_element());
    // A matrix of others, as libigl writes it: columns one after the other.
    std::string text = std::to_string(cage->points.size()) + ' ' + std::to_string(rest.size()) + '\n';
    for (std::size_t column = 0; column < cage->points.size(); ++column) {
        for (std::size_t row = 0; row < rest.size(); ++row) {
            char number[32];
            std::snprintf(number, sizeof number, "%.9g\n", double{weights[row * cage->points.size() + column]});
            text += number;
        }
    }
    const auto matrix = folder / "w.dmat";
    test::writeText(matrix, text);
    run("open-weights " + quotedWord(matrix.string()));
    run("model-colours inverted"); // cannot be counted by them
    follow();
    BOOST_TEST_REQUIRE(follower.model().isWhole());
    const std::vector<Vec3d> expected = Binding(*cage, rest, Coordinates::maximumLikelihood).pose(points());
    for (std::size_t i = 0; i < rest.size(); ++i) {
        BOOST_TEST((follower.model().points()[i] - expected[i]).length() < 1e-5);
    }
    BOOST_TEST(follower.check()->isValid);
    BOOST_TEST(!follower.check()->inverted);
    BOOST_TEST(follower.error().empty());
    // Of another cage: it says so, and all else goes on.
    session.setCage(std::make_shared<const Mesh>(test::torus(2, 0.6, 16, 9)));
    follow();
    BOOST_TEST(follower.error().find("w.dmat") != std::string::npos, follower.error());
    run("coordinates mvc");
    BOOST_TEST(!session.state().document.weights);
    follow();
    BOOST_TEST(follower.error().empty());
    BOOST_CHECK_THROW(run("open-weights " + quotedWord((folder / "none.npy").string())), IoError);
    BOOST_CHECK_THROW(run("coordinates given"), InputError);
}

BOOST_AUTO_TEST_CASE(a_cage_is_seen_when_its_poses_are_there_and_mode_shape_waits_for_none)
{
    run("move 0.3 0.2 0.1");
    Planner planner;
    Posing posing(bindingWork(), [] {});
    OpenedMesh other;
    other.mesh = test::torus(2, 0.7, 20, 8);
    State state = session.state();
    state.document.cage = std::make_shared<const OpenedMesh>(std::move(other));
    BOOST_TEST(!posing.cageOf(state, planner)); // there was none before
    CageResultPtr shown;
    for (; !shown; shown = posing.cageOf(state, planner)) {
        BOOST_TEST_REQUIRE(!posing.isSettled());
        posing.waitForNews(1);
        posing.update();
    }
    BOOST_TEST((&shown->cage.points == &posing.carried()->cage()->points));
    BOOST_TEST(posing.carried()->has(state.document.poses.keys()[0].pose));
    // Tab while it is carried over to a third one.
    OpenedMesh third;
    third.mesh = test::torus(2, 0.8, 20, 8);
    state.document.cage = std::make_shared<const OpenedMesh>(std::move(third));
    BOOST_TEST(posing.cageOf(state, planner) == shown);
    state.view.mode = Mode::shape;
    BOOST_TEST(posing.cageOf(state, planner) != shown);
    while (!posing.isSettled()) {
        posing.waitForNews(1);
        posing.update();
        posing.cageOf(state, planner);
    }
}

BOOST_AUTO_TEST_SUITE_END()
