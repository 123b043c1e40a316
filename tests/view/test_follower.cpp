// The model as it follows a pose, and the verdict on it.
#include <boost/test/unit_test.hpp>

#include <atomic>

#include <support/shapes.h>
#include <support/temporary_folder.h>
#include <tools/view/jobs/model_values.h>
#include <tools/view/posing/follower.h>
#include <tools/view/posing/posing.h>
#include <tools/view/state/cage_changes.h>
#include <tools/view/state/session.h>
#include <tools/view/state/words.h>
#include <vdbcage/core/error.h>
#include <vdbcage/deform/inversions.h>
#include <vdbcage/deform/weights_io.h>
#include <view/support/orders.h>

using namespace vdbcage;
using namespace vdbcage::view;
using openvdb::Vec3d;

namespace {

struct Fixture {
    test::TemporaryFolder folder;
    const MeshPtr cage = std::make_shared<const Mesh>(test::torus(2, 0.6, 16, 8));
    const OpenedMeshPtr model = test::opened(test::torus(2, 0.3, 48, 24));
    Session session;
    std::atomic<int> bindings{0}; ///< that were begun
    Binder::Work work = [this](const BindOrder& order, Interrupter& interrupter, const auto& publish) {
        ++bindings;
        return bindingWork()(order, interrupter, publish);
    };
    Follower follower{work, [] {}};

    Fixture()
    {
        State state;
        state.document.model = model;
        session.restart(state);
        session.setCage(test::posable(cage));
        run("mode pose");
        run("select points 0 1 2 3 4 5 6 7 8 9 10 11 12");
    }
    void run(const std::string& line) { session.execute(commandOf(wordsOf(line))); }
    std::vector<Vec3d> points() const { return cagePoints(session.state(), session.cage()); }
    void followOnce(const Follower::Conditions& conditions)
    {
        follower.follow(session.state(), session.cage()->rest(), points(), conditions);
    }
    void follow(Follower::Conditions conditions = {true, true, true})
    {
        for (followOnce(conditions); !follower.isSettled(); followOnce(conditions)) {
            follower.waitForNews(1);
            follower.update();
        }
        followOnce(conditions);
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
    for (const FamilyInfo& family : coordinateFamilies()) {
        run(std::string("coordinates ") + family.name);
        follow();
        const Binding binding(*cage, model->mesh.points, family.family);
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

BOOST_AUTO_TEST_CASE(another_material_poses_it_anew_but_binds_nothing)
{
    run("coordinates somigliana");
    run("model-colours inverted");
    run("move -5 0.4 0.3");
    follow();
    const Binding binding(*cage, model->mesh.points, Coordinates::somigliana);
    const std::vector<Vec3d> before = follower.model().points();
    BOOST_TEST(before == binding.pose(points()), boost::test_tools::per_element());
    std::size_t counts = 0;
    for (const Elasticity& elasticity : {Elasticity{0.4, Elasticity::Rotations::global, 0, 20},
                                         Elasticity{-0.5, Elasticity::Rotations::local, 10, 0}}) {
        session.execute(SetMaterial{elasticity});
        // At once, before anything is waited for.
        followOnce({true, true, false});
        const Binding other = binding.with(elasticity);
        BOOST_TEST(follower.model().points() == other.pose(points()), boost::test_tools::per_element());
        BOOST_TEST(follower.model().points() != before);
        BOOST_TEST(
            follower.bindingIfReady(bindOrder(session.state().document, session.cage()->rest()))->pose(points()) ==
                other.pose(points()),
            boost::test_tools::per_element());
        follow();
        const std::vector<std::uint32_t>& inverted = *follower.check()->inverted;
        BOOST_TEST((inverted == invertedTriangles(other, model->mesh, {points()}).front()));
        counts += inverted != invertedTriangles(binding, model->mesh, {points()}).front() ? 1 : 0;
        run("model-colours stretch");
        follow();
        BOOST_TEST((*follower.values() == stretch(model->mesh, other.pose(points()))));
        run("model-colours influence");
        follow();
        BOOST_TEST((*follower.values() ==
                    influence(other, selectedPoints(*session.cage()->rest(), session.state().view.selection))));
        run("model-colours inverted");
    }
    BOOST_TEST(counts > 0u); // the verdicts differ
    // What does not change stays as it is.
    follow();
    const std::uint64_t version = follower.model().version();
    follow();
    BOOST_TEST(follower.model().version() == version);
    run("material 0 global 0 0");
    follow();
    BOOST_TEST(follower.model().points() == before, boost::test_tools::per_element());
    BOOST_TEST(bindings == 1);
    // Other families have none.
    run("coordinates green");
    follow();
    const std::uint64_t green = follower.model().version();
    const Binding byGreen(*cage, model->mesh.points, Coordinates::green);
    BOOST_TEST((*follower.check()->inverted == invertedTriangles(byGreen, model->mesh, {points()}).front()));
    run("material 0.3 global 0 5");
    follow();
    BOOST_TEST(follower.model().version() == green);
    BOOST_TEST(bindings == 2);
}

BOOST_AUTO_TEST_CASE(the_stand_in_has_the_material)
{
    run("move 0.3 0.2 0.1");
    const Elasticity elasticity{0.4, Elasticity::Rotations::local, 3, 5};
    const BindOrder order{model, cage, Coordinates::somigliana};
    const BoundModelPtr coarse = boundCoarsely(order, nullptr), other = withMaterial(coarse, elasticity);
    BOOST_TEST(other->coarse->pose(points()) == coarse->coarse->with(elasticity).pose(points()),
               boost::test_tools::per_element());
    BOOST_TEST(other->coarse->pose(points()) != coarse->coarse->pose(points()));
    BOOST_TEST(withMaterial(coarse, Elasticity()) == coarse);
    BOOST_TEST(!withMaterial(BoundModelPtr(), elasticity));
}

BOOST_AUTO_TEST_CASE(both_pictures_have_the_material)
{
    const auto posed = [&](const Posing& posing, const Follower& of) {
        return of.model().isWhole() && posing.cagePoints() == points();
    };
    run("move 0.3 0.2 0.1");
    run("compare somigliana");
    run("material 0.4 local 3 5");
    Planner planner;
    State state = session.state();
    OpenedMesh opened;
    opened.mesh = *cage;
    state.document.cage = std::make_shared<const OpenedMesh>(std::move(opened));
    planner.want(Order{state.document.model, state.document.options, state.document.cage}, false);
    planner.cancel(); // it is worth binding
    BOOST_TEST_REQUIRE(planner.isHalted());
    Posing posing(work, [] {});
    const auto follow = [&] {
        if (posing.cageOf(state, planner)) posing.follow(state, planner, true);
    };
    for (follow(); !posing.compared() || !posing.isSettled(); follow()) {
        posing.waitForNews(1);
        posing.update();
    }
    follow();
    BOOST_TEST_REQUIRE((posed(posing, posing.follower()) && posed(posing, *posing.compared())));
    const Binding binding = Binding(*cage, model->mesh.points, Coordinates::somigliana).with(state.document.elasticity);
    BOOST_TEST(posing.compared()->model().points() == binding.pose(points()), boost::test_tools::per_element());
    BOOST_TEST(posing.hasMaterial(state));
    state.view.compared.reset();
    follow();
    BOOST_TEST(!posing.hasMaterial(state));
    state.document.coordinates = Coordinates::somigliana;
    BOOST_TEST(posing.hasMaterial(state));
    state.view.mode = Mode::shape;
    BOOST_TEST(!posing.hasMaterial(state));
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
        const Follower::Conditions conditions{true, true, true};
        for (followOnce(conditions); !follower.isChecking(); followOnce(conditions)) {
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
    session.setCage(test::posable(test::torus(2, 0.6, 16, 9)));
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
    BOOST_TEST((&shown->cage.points == &posing.posable()->rest()->points));
    BOOST_TEST(posing.posable()->has(state.document.poses.keys()[0].pose));
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
