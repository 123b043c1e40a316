#include <boost/test/unit_test.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>

#include <support/shapes.h>
#include <tools/edit/mirror.h>
#include <tools/edit/topology.h>
#include <tools/view/jobs/model_values.h>
#include <tools/view/posing/posed_model.h>
#include <tools/view/state/cage_changes.h>
#include <tools/view/state/session.h>
#include <tools/view/state/words.h>
#include <vdbcage/core/error.h>
#include <view/support/orders.h>

using namespace vdbcage;
using namespace vdbcage::view;
using openvdb::Vec3d;

namespace {

/// Numbers that are mirrored exactly.
Mesh ring()
{
    Mesh mesh = test::torus(2, 0.6, 16, 8);
    for (Vec3d& p : mesh.points) {
        for (int k = 0; k < 3; ++k) p[k] = std::round(std::ldexp(p[k], 20)) / std::ldexp(1.0, 20);
    }
    return mesh;
}

/// A session in which a ring's cage is posed.
struct Posing {
    const MeshPtr cage = std::make_shared<const Mesh>(ring());
    const OpenedMeshPtr model = test::opened(test::torus(2, 0.3, 96, 48));
    Session session;

    Posing()
    {
        State state;
        state.document.model = model;
        session.restart(state);
        session.setCage(test::posable(cage));
        run("mode pose");
        run("select points 0 1 2 3 4 5 6 7");
    }
    void run(const std::string& line) { session.execute(commandOf(wordsOf(line))); }
    std::vector<Vec3d> points() const { return cagePoints(session.state(), session.cage()); }
};

double largestDistance(const std::vector<Vec3d>& a, const std::vector<Vec3d>& b)
{
    double largest = 0;
    for (std::size_t i = 0; i < a.size(); ++i) largest = std::max(largest, (a[i] - b[i]).length());
    return largest;
}

} // namespace

BOOST_FIXTURE_TEST_SUITE(pose, Posing)

BOOST_AUTO_TEST_CASE(what_is_selected_moves_and_nothing_else_and_undo_is_exact)
{
    run("move 0.25 0 -1");
    for (std::size_t i = 0; i < cage->points.size(); ++i) {
        BOOST_TEST(points()[i] == cage->points[i] + (i < 8 ? Vec3d(0.25, 0, -1) : Vec3d(0)));
    }
    const std::vector<Vec3d> moved = points();
    run("rotate 0 1 0 33 1 2 3");
    run("scale 2 0.5 1 0 0 0");
    session.undo();
    session.undo();
    BOOST_TEST(points() == moved, boost::test_tools::per_element());
    session.undo();
    BOOST_TEST(session.state().document.poses.isEmpty());
}

BOOST_AUTO_TEST_CASE(four_quarter_turns_return)
{
    for (int i = 0; i < 4; ++i) run("rotate 1 2 3 90 0.3 0.2 0.1");
    BOOST_TEST(largestDistance(points(), cage->points) < 1e-12);
}

BOOST_AUTO_TEST_CASE(a_pose_of_nothing_moved_is_none)
{
    run("move 1 0 0");
    run("reset-pose selected");
    BOOST_TEST(session.state().document.poses.isEmpty());
    run("move 1 0 0");
    run("reset-pose all");
    BOOST_TEST(session.state().document.poses.isEmpty());
}

BOOST_AUTO_TEST_CASE(a_drag_is_done_from_its_start_and_can_be_given_up)
{
    run("move 1 0 0");
    const std::vector<Vec3d> before = points();
    const std::size_t depth = session.documents().depth();
    session.beginDrag();
    for (int i = 1; i <= 10; ++i) session.replaceDragged(MoveSelected{{0, 0.1 * i, 0}});
    session.endDrag();
    BOOST_TEST(session.documents().depth() == depth + 1);
    BOOST_TEST(session.documents().undone() == "move 0 1 0");
    const std::vector<Vec3d> dragged = points();
    session.undo();
    run("move 0 1 0");
    BOOST_TEST(points() == dragged, boost::test_tools::per_element());
    session.beginDrag();
    session.replaceDragged(MoveSelected{{5, 5, 5}});
    session.cancelDrag();
    BOOST_TEST(points() == dragged, boost::test_tools::per_element());
    BOOST_TEST(session.documents().depth() == depth + 1);
    session.undo();
    BOOST_TEST(points() == before, boost::test_tools::per_element());
}

BOOST_AUTO_TEST_CASE(mirrored_moves_are_symmetric_exactly)
{
    std::mt19937 random(3);
    std::uniform_real_distribution<double> real(-1, 1);
    run("mirror x 0");
    for (int i = 0; i < 50; ++i) {
        std::string line = "select points";
        for (std::size_t k = 0; k < cage->points.size(); ++k) {
            if (random() % 8 == 0) line += ' ' + std::to_string(k);
        }
        run(line);
        session.execute(RotateSelected{{real(random), real(random), 1}, 30 * real(random), {real(random), 0, 0}});
        session.execute(MoveSelected{{real(random), real(random), real(random)}});
    }
    const auto partners = edit::mirrorPartners(cage->points, 0, 0);
    const std::vector<Vec3d> posed = points();
    std::size_t pairs = 0;
    for (std::size_t i = 0; i < posed.size(); ++i) {
        if (partners[i] == edit::none || partners[i] == i) continue;
        ++pairs;
        const Vec3d& other = posed[partners[i]];
        BOOST_TEST(other == Vec3d(-posed[i].x(), posed[i].y(), posed[i].z()));
    }
    BOOST_TEST(pairs > 50);
}

BOOST_AUTO_TEST_CASE(soft_selection_moves_the_neighbourhood_alone)
{
    run("select points 0");
    run("soft 0.25"); // of 4.6
    run("move 0 1 0");
    std::size_t moved = 0;
    for (std::size_t i = 0; i < cage->points.size(); ++i) {
        const double rise = points()[i].y() - cage->points[i].y();
        BOOST_TEST((rise >= 0 && rise <= 1));
        if (rise > 0) ++moved;
        if ((cage->points[i] - cage->points[0]).length() > 0.25 * 4.7) BOOST_TEST(rise == 0);
    }
    BOOST_TEST(moved > 3);
    BOOST_TEST(moved < 60);
}

BOOST_AUTO_TEST_CASE(in_mode_shape_the_cage_itself_is_moved_and_its_pose_rides_along)
{
    run("move 0.5 0 0");
    const std::vector<Vec3d> posed = points();
    run("mode shape");
    BOOST_TEST(points() == cage->points, boost::test_tools::per_element());
    run("select points 100");
    run("move 0 0.01 0");
    const OpenedMeshPtr edited = session.state().document.cage;
    BOOST_TEST_REQUIRE(edited.get());
    BOOST_TEST(edited->path.empty());
    BOOST_TEST(edited->mesh.points[100] == cage->points[100] + Vec3d(0, 0.01, 0));
    session.setCage(test::posable(MeshPtr(edited, &edited->mesh)));
    run("mode pose");
    const std::vector<Vec3d> carried = points();
    for (std::size_t i = 0; i < carried.size(); ++i) {
        if (i != 100) BOOST_TEST(carried[i] == posed[i]);
    }
    BOOST_TEST((carried[100] - posed[100]).length() < 0.1);
}

BOOST_AUTO_TEST_CASE(edges_are_split_collapsed_flipped_merged_and_cut)
{
    BOOST_CHECK_THROW(run("edit-cage split"), InputError); // it is mode pose
    run("mode shape");
    const auto shape = [&] {
        const OpenedMeshPtr edited = session.state().document.cage;
        session.setCage(test::posable(MeshPtr(edited, &edited->mesh)));
        return edited->mesh;
    };
    const std::size_t quads = cage->quads.size(), triangles = cage->triangles.size();
    BOOST_TEST_REQUIRE(quads + triangles == 128u);
    if (quads > 0) {
        run("select faces 0 3 100");
        run("edit-cage cut");
        const Mesh cut = shape();
        BOOST_TEST(cut.quads.size() == quads - 3);
        BOOST_TEST(cut.triangles.size() == triangles + 6);
        const edit::Elements elements(cut);
        const auto edge = elements.edgeBetween(cut.triangles[0][0], cut.triangles[0][2]);
        BOOST_TEST_REQUIRE(edge != edit::none);
        run("select faces 0 1");
        run("edit-cage merge");
        BOOST_TEST(shape().quads.size() == quads - 2);
    }
    run("select edges 0");
    run("edit-cage split");
    const Mesh split = shape();
    BOOST_TEST(split.points.size() == cage->points.size() + 1);
    run("select points 0");
    BOOST_CHECK_THROW(run("edit-cage split"), InputError);
}

BOOST_AUTO_TEST_CASE(edges_that_are_collapsed_together_are_those_that_were_selected)
{
    std::mt19937 random(11);
    run("mode shape");
    Mesh plain = *cage;
    plain.triangles = triangulate(plain);
    plain.quads.clear();
    const edit::Elements first(plain);
    int collapsed = 0;
    for (int i = 0; i < 200; ++i) {
        // Edges at one point and the points around it, so that they have ends in common.
        std::vector<openvdb::Index32> ids;
        const auto point = static_cast<openvdb::Index32>(random() % plain.points.size());
        for (const auto edge : first.edgesOfPoint(point)) {
            const auto [a, b] = first.edges()[edge];
            for (const auto next : first.edgesOfPoint(a == point ? b : a)) {
                if (random() % 8 == 0) ids.push_back(next);
            }
        }
        std::sort(ids.begin(), ids.end());
        ids.erase(std::unique(ids.begin(), ids.end()), ids.end());
        if (ids.empty()) continue;
        // The same by places instead of numbers.
        Mesh expected = plain;
        std::vector<std::array<Vec3d, 2>> places;
        for (const auto id : ids) {
            places.push_back({plain.points[first.edges()[id].first], plain.points[first.edges()[id].second]});
        }
        bool isRefused = false;
        for (std::size_t k = 0; k < places.size() && !isRefused; ++k) {
            const auto [p, q] = places[k];
            const auto at = [&](const Vec3d& place) {
                const auto found = std::find(expected.points.begin(), expected.points.end(), place);
                return static_cast<openvdb::Index32>(found - expected.points.begin());
            };
            if (p == q) continue;
            const auto edge = edit::Elements(expected).edgeBetween(at(p), at(q));
            if (edge == edit::none) continue;
            try {
                expected = edit::collapseEdge(expected, edge);
            } catch (const InputError&) {
                isRefused = true;
                continue;
            }
            for (auto& other : places) {
                for (Vec3d& end : other) {
                    if (end == p || end == q) end = 0.5 * (p + q);
                }
            }
        }
        session.setCage(test::posable(plain));
        session.execute(Select{{edit::Element::edge, ids}});
        if (isRefused) {
            BOOST_CHECK_THROW(run("edit-cage collapse"), InputError);
            continue;
        }
        run("edit-cage collapse");
        BOOST_TEST_REQUIRE(test::sameMesh(session.state().document.cage->mesh, expected));
        if (ids.size() > 1) ++collapsed;
    }
    BOOST_TEST(collapsed > 20);
}

BOOST_AUTO_TEST_CASE(nothing_is_moved_out_of_sight_for_ever)
{
    for (const char* line : {"move 1e300 0 0", "move 0 1e12 0", "scale 1e300 1 1 0 0 0", "scale 2 2 2 1e300 0 0",
                             "rotate 0 0 1 90 1e300 0 0"}) {
        BOOST_TEST_CONTEXT(line) BOOST_CHECK_THROW(run(line), InputError);
    }
    BOOST_TEST(session.state().document.poses.isEmpty());
    run("move 1e6 0 0");
    BOOST_TEST(points()[0].x() == cage->points[0].x() + 1e6);
}

BOOST_AUTO_TEST_CASE(where_nothing_is_selected_nothing_moves)
{
    run("select points");
    for (const char* line : {"move 1 0 0", "rotate 0 0 1 90 0 0 0", "scale 2 2 2 0 0 0", "reset-pose selected"}) {
        BOOST_CHECK_THROW(run(line), InputError);
    }
    run("select points 4000000");
    BOOST_CHECK_THROW(run("move 1 0 0"), InputError);
    session.setCage(nullptr);
    BOOST_CHECK_THROW(run("move 1 0 0"), InputError);
    BOOST_TEST(session.state().document.poses.isEmpty());
}

BOOST_AUTO_TEST_CASE(what_is_selected_is_forgotten_with_its_faces)
{
    session.setCage(test::posable(*cage));
    BOOST_TEST(session.state().view.selection.ids.size() == 8u);
    session.setCage(test::posable(test::box({0, 0, 0}, {1, 1, 1})));
    BOOST_TEST(session.state().view.selection.ids.empty());
}

BOOST_AUTO_TEST_CASE(axes_of_what_is_selected)
{
    const std::array<Vec3d, 3> view{Vec3d(0, 0, -1), Vec3d(0, 1, 0), Vec3d(1, 0, 0)};
    for (const char* orientation : {"world", "local", "normal", "view"}) {
        run(std::string("orientation ") + orientation);
        const auto frame = selectionFrame(session.state(), session.cage(), view);
        BOOST_TEST_REQUIRE(frame.has_value());
        for (std::size_t i = 0; i < 3; ++i) {
            BOOST_TEST(std::abs(frame->axes[i].length() - 1) < 1e-12);
            BOOST_TEST((frame->axes[i].cross(frame->axes[(i + 1) % 3]) - frame->axes[(i + 2) % 3]).length() < 1e-9);
        }
    }
    BOOST_TEST((selectionFrame(session.state(), session.cage(), view)->axes[0] == view[0]));
}

BOOST_AUTO_TEST_CASE(the_pivot_is_where_it_is_chosen_and_axes_do_not_depend_on_it)
{
    run("select points 0 1 2 3 40");
    run("orientation local");
    Vec3d mean(0);
    openvdb::BBoxd box(cage->points[0], cage->points[0]);
    for (const std::size_t i : {0, 1, 2, 3, 40}) {
        mean += cage->points[i] / 5.0;
        box.expand(cage->points[i]);
    }
    const Vec3d middle = 0.5 * (box.min() + box.max());
    BOOST_TEST((middle - mean).length() > 0.1);
    const auto axes = selectionFrame(session.state(), session.cage(), {})->axes;
    for (const auto& [text, expected] : std::vector<std::pair<std::string, Vec3d>>{
             {"mean", mean}, {"box", middle}, {"origin", Vec3d(0)}, {"0.25 -1 3", Vec3d(0.25, -1, 3)}}) {
        run("pivot " + text);
        const auto frame = selectionFrame(session.state(), session.cage(), {});
        BOOST_TEST_CONTEXT(text)
        {
            BOOST_TEST((frame->origin - expected).length() < 1e-12);
            BOOST_TEST((frame->mean - mean).length() < 1e-12);
            BOOST_TEST(frame->count == 5u);
            BOOST_CHECK(frame->axes == axes);
        }
    }
    // It follows what is posed, and is undone with the view.
    run("pivot box");
    run("move 1 2 3");
    BOOST_TEST((selectionFrame(session.state(), session.cage(), {})->origin - middle - Vec3d(1, 2, 3)).length() <
               1e-12);
    session.undoView();
    BOOST_CHECK((session.state().view.pivot == Pivot{Pivot::Kind::point, {0.25, -1, 3}}));
}

BOOST_AUTO_TEST_CASE(the_model_follows_as_the_binding_poses_it)
{
    run("move 0.3 0.2 0.1");
    const BindOrder order{model, cage, Coordinates::meanValue};
    const BoundModelPtr coarse = boundCoarsely(order, nullptr), whole = boundWhole(*coarse, nullptr);
    BOOST_TEST(coarse->coarse->points().size() <= model->mesh.points.size() / 8);
    PosedModel posed;
    BOOST_TEST(posed.update(coarse, points()));
    BOOST_TEST(!posed.isWhole());
    const Binding plain(*cage, model->mesh.points, Coordinates::meanValue);
    const std::vector<Vec3d> expected = plain.pose(points());
    for (std::size_t i = 0; i < posed.points().size(); ++i) {
        const openvdb::Index32 with = coarse->standIn->points[i];
        const Vec3d offset = coarse->standIn->mesh.points[i] - model->mesh.points[with];
        BOOST_TEST((posed.points()[i] - offset - expected[with]).length() < 1e-5);
    }
    const std::uint64_t version = posed.version();
    BOOST_TEST(posed.update(whole, points()));
    BOOST_TEST(posed.version() != version);
    BOOST_TEST(posed.points() == expected, boost::test_tools::per_element());
    BOOST_TEST(!posed.update(whole, points()));
    BOOST_TEST(posed.update(nullptr, points()));
    BOOST_TEST(posed.points().empty());
}

BOOST_AUTO_TEST_CASE(influence_is_the_sum_of_weights)
{
    const std::vector<openvdb::Index32> some{3, 4, 50, 100};
    for (const Coordinates family : {Coordinates::meanValue, Coordinates::maximumLikelihood}) {
        const Binding binding(*cage, model->mesh.points, family);
        const std::vector<double> weights = computeCoordinates(*cage, model->mesh.points, family);
        const std::vector<double> values = influence(binding, some);
        for (std::size_t i = 0; i < values.size(); ++i) {
            double sum = 0;
            for (const openvdb::Index32 k : some) sum += weights[i * cage->points.size() + k];
            BOOST_TEST(std::abs(values[i] - sum) < 2e-3);
        }
    }
    std::vector<openvdb::Index32> all(cage->points.size());
    for (openvdb::Index32 i = 0; i < all.size(); ++i) all[i] = i;
    // What moves with everything has all of it, by Green coordinates too.
    for (const double value : influence(Binding(*cage, model->mesh.points, Coordinates::green), all)) {
        BOOST_TEST(std::abs(value - 1) < 2e-3);
    }
    for (const double value : influence(Binding(*cage, model->mesh.points, Coordinates::meanValue), {})) {
        BOOST_TEST(value == 0);
    }
}

BOOST_AUTO_TEST_CASE(stretch_tells_how_lengths_changed)
{
    std::vector<Vec3d> posed = model->mesh.points;
    for (Vec3d& p : posed) p *= 2;
    for (const double value : stretch(model->mesh, posed)) BOOST_TEST(std::abs(value - 1) < 1e-9);
    for (Vec3d& p : posed) p *= 0.125;
    for (const double value : stretch(model->mesh, posed)) BOOST_TEST(std::abs(value + 2) < 1e-9);
    for (Vec3d& p : posed) p = Vec3d(0);
    for (const double value : stretch(model->mesh, posed)) BOOST_TEST(value == -4);
}

/// Takes the edited cage as the shown one, as the program does.
void showEdited(Session& session)
{
    session.setCage(test::posable(session.state().document.cage->mesh));
}

BOOST_AUTO_TEST_CASE(locked_points_stay_at_rest_and_pose_like_others)
{
    const auto locked = [&] { return session.state().document.locked; };
    BOOST_CHECK_THROW(run("lock"), InputError); // in mode pose
    run("mode shape");
    run("select points");
    BOOST_CHECK_THROW(run("lock"), InputError);
    run("select points 1 4");
    run("lock");
    BOOST_TEST(locked() == (std::vector<openvdb::Index32>{1, 4}), boost::test_tools::per_element());
    BOOST_TEST(session.documents().undone() == "lock");
    showEdited(session);
    const std::size_t depth = session.documents().depth();
    run("lock"); // no step
    BOOST_TEST(session.documents().depth() == depth);
    BOOST_CHECK_EXCEPTION(run("move 1 0 0"), InputError, [](const InputError& error) {
        return std::string(error.what()) == "all selected points are locked";
    });
    run("select points 0 1 2 3 4 5");
    run("soft 0.3");
    run("move 0.25 0 -1");
    showEdited(session);
    for (std::size_t i = 0; i < 6; ++i) {
        BOOST_TEST(points()[i] == cage->points[i] + (i == 1 || i == 4 ? Vec3d(0) : Vec3d(0.25, 0, -1)));
    }
    run("select points 4");
    run("unlock");
    BOOST_TEST(locked() == std::vector<openvdb::Index32>{1}, boost::test_tools::per_element());
    run("select points 1");
    run("soft 0");
    run("mode pose");
    run("move 1 0 0");
    BOOST_TEST(points()[1] == cage->points[1] + Vec3d(1, 0, 0));
    session.undo();
    run("set faces 50"); // another cage
    BOOST_TEST(locked().empty());
}

BOOST_AUTO_TEST_CASE(a_lock_of_a_fitted_cage_keeps_the_points_where_they_are_seen)
{
    run("mode shape");
    run("fit");
    Mesh fitted = *cage;
    for (Vec3d& p : fitted.points) p *= 1.5;
    session.setCage(test::posable(fitted));
    run("lock");
    BOOST_TEST(!session.state().document.isFitted);
    BOOST_TEST(test::sameMesh(session.state().document.cage->mesh, fitted));
    BOOST_TEST(session.state().document.locked.size() == 8u);
}

BOOST_AUTO_TEST_CASE(a_collapse_renumbers_locked_points_and_moves_none)
{
    run("mode shape");
    run("select points 3 60 127");
    run("lock");
    showEdited(session);
    run("select points 24 25 40 41");
    run("edit-cage collapse");
    const Mesh& edited = session.state().document.cage->mesh;
    BOOST_TEST_REQUIRE(edited.points.size() < cage->points.size());
    const std::vector<openvdb::Index32>& locked = session.state().document.locked;
    BOOST_TEST_REQUIRE(locked.size() == 3u);
    const std::array<std::size_t, 3> before{3, 60, 127};
    for (std::size_t i = 0; i < 3; ++i) BOOST_TEST(edited.points[locked[i]] == cage->points[before[i]]);
    showEdited(session);
    const edit::Elements elements(edited);
    run("select edges " + std::to_string(elements.edgesOfPoint(locked[1])[0]));
    BOOST_CHECK_EXCEPTION(run("edit-cage collapse"), InputError, [](const InputError& error) {
        return std::string(error.what()).find("has a locked point") != std::string::npos;
    });
    run("edit-cage split");
    BOOST_TEST(session.state().document.locked.size() == 3u);
}

BOOST_AUTO_TEST_SUITE_END()
