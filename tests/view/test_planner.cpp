// The planner with fakes: no thread, no clock, no pipeline.
#include <boost/test/unit_test.hpp>

#include <map>
#include <random>
#include <set>

#include <support/shapes.h>
#include <tools/view/jobs/planner.h>
#include <view/support/orders.h>

using namespace vdbcage;
using namespace vdbcage::view;
using test::orderOf;

namespace {

/// A result that tells by its cage what it was made by.
CageResultPtr resultOf(const Job& job)
{
    CageResult result;
    result.order = job.order;
    const CageOptions& options = job.order.options;
    result.cage.points = {
        {1.0 * options.faces, 1.0 * options.resolution.value_or(0), static_cast<double>(options.effort)}};
    if (job.intermediates) result.intermediates = std::make_shared<const Intermediates>();
    return std::make_shared<const CageResult>(std::move(result));
}

bool carriesItsOptions(const CageResult& result)
{
    return result.cage.points == resultOf({Job::Kind::full, result.order, false})->cage.points;
}

/// Does all that is to be done, and returns the jobs.
std::vector<Job> drain(Planner& planner)
{
    std::vector<Job> jobs;
    if (planner.running()) planner.shouldStop() ? planner.stopped() : planner.finished(resultOf(*planner.running()));
    while (const std::optional<Job> job = planner.start()) {
        jobs.push_back(*job);
        BOOST_TEST_REQUIRE(jobs.size() < 10);
        planner.finished(resultOf(*job));
    }
    return jobs;
}

const OpenedMeshPtr model = test::opened(test::box(openvdb::Vec3d(0), openvdb::Vec3d(1)));
const OpenedMeshPtr otherModel = test::opened(test::box(openvdb::Vec3d(0), openvdb::Vec3d(2)));

} // namespace

BOOST_AUTO_TEST_SUITE(planner)

BOOST_AUTO_TEST_CASE(a_preview_comes_first_then_the_cage_then_the_neighbours_previews)
{
    Planner planner;
    BOOST_TEST(!planner.start());
    BOOST_CHECK(planner.standing() == Planner::Standing::none);
    planner.want(orderOf(model, 100), false);
    std::optional<Job> job = planner.start();
    BOOST_TEST_REQUIRE(job.has_value());
    BOOST_CHECK(job->kind == Job::Kind::preview && job->order == orderOf(model, 100, Effort::fast));
    BOOST_TEST(!planner.start());
    planner.finished(resultOf(*job));
    BOOST_CHECK(planner.standing() == Planner::Standing::preview);
    job = planner.start();
    BOOST_CHECK(job->kind == Job::Kind::full && job->order == orderOf(model, 100));
    planner.finished(resultOf(*job));
    BOOST_CHECK(planner.standing() == Planner::Standing::current);
    BOOST_TEST(planner.isSettled());
    const std::vector<Job> ahead = drain(planner);
    BOOST_TEST_REQUIRE(ahead.size() == 2);
    BOOST_CHECK(ahead[0].order == orderOf(model, 95, Effort::fast) && ahead[0].kind == Job::Kind::ahead);
    BOOST_CHECK(ahead[1].order == orderOf(model, 105, Effort::fast));
    BOOST_CHECK(planner.made()->order == orderOf(model, 100));
}

BOOST_AUTO_TEST_CASE(what_was_made_once_is_there_at_once)
{
    Planner planner;
    planner.want(orderOf(model, 100), false);
    drain(planner);
    planner.want(orderOf(model, 300), false);
    drain(planner);
    planner.want(orderOf(model, 100), false);
    BOOST_CHECK(planner.standing() == Planner::Standing::current);
    BOOST_TEST(planner.isSettled());
    planner.want(orderOf(model, 105), false); // made ahead
    BOOST_CHECK(planner.standing() == Planner::Standing::preview);
    BOOST_CHECK(planner.start()->kind == Job::Kind::full);
}

BOOST_AUTO_TEST_CASE(a_drag_shows_previews_and_its_end_begins_the_full_run)
{
    Planner planner;
    planner.want(orderOf(model, 100), false);
    drain(planner);
    planner.want(orderOf(model, 120), true);
    const std::optional<Job> first = planner.start();
    BOOST_CHECK(first->kind == Job::Kind::preview);
    planner.want(orderOf(model, 140), true);
    BOOST_TEST(!planner.shouldStop()); // it will be done soon
    planner.finished(resultOf(*first));
    BOOST_TEST(planner.made()->order.options.faces == 120);
    BOOST_CHECK(planner.standing() == Planner::Standing::stale);
    const std::optional<Job> second = planner.start();
    BOOST_TEST(second->order.options.faces == 140);
    planner.want(orderOf(model, 160), true);
    planner.want(orderOf(model, 160), false);
    BOOST_TEST(planner.shouldStop());
    planner.stopped();
    const std::optional<Job> full = planner.start();
    BOOST_CHECK(full->kind == Job::Kind::full && full->order == orderOf(model, 160));
}

BOOST_AUTO_TEST_CASE(a_drag_with_least_effort_shows_cages_too)
{
    Planner planner;
    planner.want(orderOf(model, 100, Effort::fast), true);
    std::optional<Job> job = planner.start();
    planner.want(orderOf(model, 120, Effort::fast), true);
    BOOST_TEST(!planner.shouldStop());
    planner.finished(resultOf(*job));
    BOOST_TEST(planner.made()->order.options.faces == 100);
    job = planner.start();
    planner.want(orderOf(model, 120, Effort::fast), false);
    BOOST_TEST(!planner.shouldStop());
    planner.finished(resultOf(*job));
    BOOST_CHECK(planner.standing() == Planner::Standing::current);
}

BOOST_AUTO_TEST_CASE(a_preview_that_shares_no_stage_is_stopped)
{
    Planner planner;
    planner.want(orderOf(model, 100), false);
    planner.start();
    Order other = orderOf(model, 100);
    other.options.resolution = 50;
    planner.want(other, false);
    BOOST_TEST(planner.shouldStop());
    planner.stopped();
    planner.start();
    planner.want(orderOf(otherModel, 100), false);
    BOOST_TEST(planner.shouldStop());
    BOOST_TEST(!planner.made());
}

BOOST_AUTO_TEST_CASE(cancelling_keeps_what_is_shown_until_something_else_is_wanted)
{
    Planner planner;
    planner.want(orderOf(model, 100), false);
    drain(planner);
    planner.want(orderOf(model, 200), false);
    planner.start();
    planner.cancel();
    BOOST_TEST(planner.shouldStop());
    planner.stopped();
    BOOST_TEST(planner.isHalted());
    planner.want(orderOf(model, 200), false);
    BOOST_TEST(!planner.start());
    BOOST_CHECK(planner.standing() == Planner::Standing::stale);
    BOOST_TEST(planner.made()->order.options.faces == 100);
    planner.again();
    BOOST_TEST(planner.start().has_value());
    planner.cancel();
    planner.stopped();
    planner.want(orderOf(model, 300), false);
    drain(planner);
    BOOST_CHECK(planner.standing() == Planner::Standing::current);
}

BOOST_AUTO_TEST_CASE(a_failure_is_told_once_and_not_tried_again)
{
    Planner planner;
    planner.want(orderOf(model, 100), false);
    planner.start();
    planner.failed("too few");
    BOOST_TEST(planner.error() == "too few");
    BOOST_TEST(!planner.start());
    planner.want(orderOf(model, 200), false);
    BOOST_TEST(planner.error().empty());
    const std::optional<Job> stale = planner.start();
    planner.want(orderOf(model, 300), false);
    planner.failed("of no interest any more");
    BOOST_TEST(planner.error().empty());
    drain(planner);
    BOOST_CHECK(planner.standing() == Planner::Standing::current);
}

BOOST_AUTO_TEST_CASE(neighbours_that_fail_are_not_tried_for_ever)
{
    Planner planner;
    planner.want(orderOf(model, 100), false);
    planner.finished(resultOf(*planner.start()));
    planner.finished(resultOf(*planner.start()));
    int tried = 0;
    for (; planner.start(); ++tried) {
        BOOST_TEST_REQUIRE(tried < 5);
        planner.failed("no");
    }
    BOOST_TEST(tried == 2);
    BOOST_TEST(planner.error().empty());
    BOOST_CHECK(planner.standing() == Planner::Standing::current);
}

BOOST_AUTO_TEST_CASE(intermediates_are_made_when_they_are_asked_for)
{
    Planner planner;
    planner.want(orderOf(model, 100), false);
    drain(planner);
    BOOST_TEST(!planner.made()->intermediates);
    planner.want(orderOf(model, 100), false, true);
    BOOST_TEST(!planner.isSettled());
    const std::vector<Job> jobs = drain(planner);
    BOOST_TEST(jobs.size() == 1);
    BOOST_TEST(planner.made()->intermediates.get());
    BOOST_CHECK(planner.standing() == Planner::Standing::current);
}

BOOST_AUTO_TEST_CASE(an_opened_cage_is_looked_at_once)
{
    Planner planner;
    Order order = orderOf(model, 100);
    order.cage = otherModel;
    planner.want(order, false, true);
    const std::vector<Job> jobs = drain(planner);
    BOOST_TEST_REQUIRE(jobs.size() == 1);
    BOOST_CHECK(jobs[0].order == order);
    BOOST_CHECK(planner.standing() == Planner::Standing::current);
}

BOOST_AUTO_TEST_CASE(a_fit_is_finished_while_its_tightness_is_dragged)
{
    const auto fit = [](double tightness) {
        Order order = orderOf(model, 100);
        order.cage = otherModel;
        order.fit = FitOrder{tightness};
        return order;
    };
    Planner planner;
    planner.want(fit(0.1), true);
    const std::optional<Job> first = planner.start();
    BOOST_TEST_REQUIRE(first.has_value());
    BOOST_CHECK(first->order == fit(0.1));
    planner.want(fit(0.2), true);
    planner.want(fit(0.3), true);
    BOOST_TEST(!planner.shouldStop());
    planner.finished(resultOf(*first));
    BOOST_CHECK(planner.made()->order == fit(0.1)); // it is shown until the next is there
    BOOST_CHECK(planner.standing() == Planner::Standing::stale);
    BOOST_CHECK(planner.start()->order == fit(0.3));
    planner.want(fit(0.4), true);
    BOOST_TEST(!planner.shouldStop());
    planner.want(fit(0.4), false); // the drag ends
    BOOST_TEST(planner.shouldStop());
    planner.stopped();
    const std::vector<Job> jobs = drain(planner);
    BOOST_TEST_REQUIRE(jobs.size() == 1);
    BOOST_CHECK(jobs[0].order == fit(0.4));
    BOOST_CHECK(planner.standing() == Planner::Standing::current);
    planner.want(fit(0.1), false); // it was kept
    BOOST_TEST(planner.isSettled());
    planner.want(fit(0.5), false);
    planner.start();
    planner.want(fit(0.6), false);
    BOOST_TEST(planner.shouldStop());
    planner.stopped();
    // Of other locked points, or of none, it is another cage.
    Order locked = fit(0.1);
    locked.fit->locked = {3};
    planner.want(locked, false);
    BOOST_TEST(!planner.isSettled());
}

BOOST_AUTO_TEST_CASE(little_memory_keeps_what_is_wanted)
{
    Planner planner(1);
    for (int faces = 100; faces < 110; ++faces) {
        planner.want(orderOf(model, faces), false);
        BOOST_TEST(drain(planner).size() <= 4);
        BOOST_CHECK(planner.standing() == Planner::Standing::current);
    }
    planner.want(orderOf(model, 100), false);
    BOOST_TEST(!planner.isSettled()); // long forgotten
}

BOOST_AUTO_TEST_CASE(any_sequence_of_changes_cancels_and_late_results)
{
    std::mt19937 random(1);
    const auto below = [&](int n) { return static_cast<int>(random() % static_cast<unsigned>(n)); };
    std::map<Planner::Standing, int> seen;
    int late = 0, failures = 0;
    for (int sequence = 0; sequence < 1000; ++sequence) {
        Planner planner(below(2) == 0 ? 1 : 1 << 20);
        std::vector<Order> past; // for undo
        Order wanted = orderOf(model, 100);
        bool isDragging = false, intermediates = false;
        std::set<std::pair<int, Effort>> broken;
        const auto check = [&] {
            if (const CageResultPtr& made = planner.made()) {
                BOOST_REQUIRE(carriesItsOptions(*made));
                BOOST_REQUIRE(made->order.model == wanted.model);
            }
            const bool isCurrent = planner.made() && planner.made()->order == wanted;
            BOOST_REQUIRE((planner.standing() == Planner::Standing::current) == isCurrent);
            ++seen[planner.standing()];
        };
        const auto end = [&](bool mayStop) {
            const Job job = *planner.running();
            if (planner.shouldStop() && mayStop) return planner.stopped();
            if (planner.shouldStop()) ++late;
            if (broken.count({job.order.options.faces, job.order.options.effort}) > 0) {
                ++failures;
                return planner.failed("broken");
            }
            planner.finished(resultOf(job));
        };
        for (int i = 0; i < 60; ++i) {
            switch (below(9)) {
            case 0:
                past.push_back(wanted);
                wanted.options.faces = 100 + 10 * below(6);
                break;
            case 1:
                past.push_back(wanted);
                wanted.options.resolution = 20 + below(3);
                break;
            case 2:
                past.push_back(wanted);
                wanted.options.effort = static_cast<Effort>(below(3));
                break;
            case 3:
                if (!past.empty()) wanted = past[random() % past.size()];
                break;
            case 4:
                isDragging = !isDragging;
                break;
            case 5:
                if (below(4) == 0) wanted.model = wanted.model == model ? otherModel : model;
                intermediates = below(2) == 0;
                break;
            case 6:
                if (below(3) == 0) planner.cancel();
                if (below(3) == 0) planner.again();
                if (below(10) == 0) broken.insert({100 + 10 * below(6), static_cast<Effort>(below(3))});
                break;
            default:
                if (planner.running()) end(below(2) == 0);
            }
            planner.want(wanted, isDragging, intermediates);
            check();
            const bool wasRunning = planner.running().has_value();
            const std::optional<Job> job = planner.start();
            BOOST_REQUIRE(!(wasRunning && job)); // at most one
            check();
        }
        // The last change always gets its cage.
        broken.clear();
        wanted.options.faces = 500 + sequence;
        for (const bool dragging : {isDragging, false}) {
            planner.want(wanted, dragging, intermediates);
            for (int jobs = 0; planner.running() || planner.start(); ++jobs) {
                BOOST_TEST_REQUIRE(jobs < 8);
                end(true);
                check();
            }
            BOOST_CHECK(planner.standing() != Planner::Standing::stale);
        }
        BOOST_CHECK(planner.standing() == Planner::Standing::current);
        BOOST_TEST((!intermediates || planner.made()->intermediates));
    }
    for (const auto standing :
         {Planner::Standing::none, Planner::Standing::current, Planner::Standing::preview, Planner::Standing::stale}) {
        BOOST_TEST(seen[standing] > 100);
    }
    BOOST_TEST(late > 100);
    BOOST_TEST(failures > 100);
}

BOOST_AUTO_TEST_CASE(steps_of_faces_stay_within_the_range)
{
    BOOST_TEST(steppedFaces(400, 1, CageFaces::quads) == 420);
    BOOST_TEST(steppedFaces(400, -1, CageFaces::quads) == 380);
    BOOST_TEST(steppedFaces(6, -1, CageFaces::quads) == 6);
    BOOST_TEST(steppedFaces(12, -1, CageFaces::loops) == 11);
    BOOST_TEST(steppedFaces(6, -1, CageFaces::loops) == 6);
    BOOST_TEST(steppedFaces(12, 1, CageFaces::quads) == 13);
    BOOST_TEST(steppedFaces(1000000, 1, CageFaces::quads) == 1000000);
}

BOOST_AUTO_TEST_SUITE_END()
