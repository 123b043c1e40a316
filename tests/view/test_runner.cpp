#include <boost/test/unit_test.hpp>

#include <array>
#include <atomic>
#include <new>
#include <random>

#include <support/shapes.h>
#include <support/stop_at.h>
#include <tools/view/jobs/runner.h>
#include <vdbcage/core/detail/grids.h>
#include <vdbcage/core/error.h>
#include <view/support/orders.h>

using namespace vdbcage;
using namespace vdbcage::view;

namespace {

Order orderOf(const OpenedMeshPtr& model, int faces, Effort effort = Effort::fair)
{
    Order order = test::orderOf(model, faces, effort);
    order.options.resolution = 24;
    return order;
}

/// Makes boxes at once, or when it is told to; fails where it is told to.
class FakeMaker : public CageMaker {
public:
    explicit FakeMaker(std::atomic<bool>& mayEnd, std::atomic<int>& made) : mayEnd_(mayEnd), made_(made) {}

    CageResultPtr make(const Job& job, Interrupter& interrupter) override
    {
        const Stage stage(&interrupter, StageName::loops);
        while (!mayEnd_) {
            throwIfInterrupted(&interrupter, 50);
            std::this_thread::yield();
        }
        if (job.order.options.faces == 66) throw Error("66 faces");
        if (job.order.options.faces == 67) throw std::bad_alloc();
        CageResult result;
        result.order = job.order;
        ++made_;
        return std::make_shared<const CageResult>(std::move(result));
    }

private:
    std::atomic<bool>& mayEnd_;
    std::atomic<int>& made_;
};

void settle(Runner& runner)
{
    for (;;) {
        runner.update();
        if (runner.planner().isSettled()) return;
        runner.waitForNews(60);
    }
}

struct Fixture {
    std::atomic<bool> mayEnd{true};
    std::atomic<int> made{0}, woken{0};
    const OpenedMeshPtr model = test::opened(test::sphere({0, 0, 0}, 1, 8));
    Runner runner{std::make_unique<FakeMaker>(mayEnd, made), [this] { ++woken; }};
};

/// The cage of a pipeline that has done nothing else.
Mesh freshCage(const Order& order)
{
    return makeCage(order.model->mesh, order.options);
}

} // namespace

BOOST_FIXTURE_TEST_SUITE(runner_with_fakes, Fixture)

BOOST_AUTO_TEST_CASE(what_is_wanted_is_made_and_the_owner_woken)
{
    BOOST_TEST(!runner.update());
    runner.waitForNews(60); // nothing is under way
    runner.want(orderOf(model, 100), false);
    settle(runner);
    BOOST_CHECK(runner.planner().standing() == Planner::Standing::current);
    BOOST_TEST(woken > 0);
    while (runner.planner().running()) {
        runner.waitForNews(60);
        runner.update();
    }
    BOOST_TEST(made == 4);
    BOOST_TEST(!runner.progress());
}

BOOST_AUTO_TEST_CASE(a_run_that_never_ends_is_cancelled)
{
    mayEnd = false;
    runner.want(orderOf(model, 100), false);
    for (std::string stage; stage != "loops";) stage = runner.progress()->stage;
    runner.cancel();
    settle(runner);
    BOOST_TEST(made == 0);
    BOOST_TEST(runner.planner().isHalted());
    runner.want(orderOf(model, 200), false); // and the end of the test ends it
}

BOOST_AUTO_TEST_CASE(errors_of_any_kind_arrive_and_the_next_run_works)
{
    for (const int faces : {66, 67}) {
        runner.want(orderOf(model, faces), false);
        settle(runner);
        BOOST_TEST(!runner.planner().error().empty());
        runner.want(orderOf(model, 100 + faces), false);
        settle(runner);
        BOOST_TEST(runner.planner().error().empty());
        BOOST_CHECK(runner.planner().standing() == Planner::Standing::current);
    }
}

BOOST_AUTO_TEST_SUITE_END()

BOOST_AUTO_TEST_SUITE(runner_with_pipelines)

BOOST_AUTO_TEST_CASE(changes_cancels_and_late_results_give_the_cage_of_the_last_change)
{
    std::mt19937 random(5);
    const auto below = [&](int n) { return static_cast<int>(random() % static_cast<unsigned>(n)); };
    const OpenedMeshPtr models[2] = {test::opened(test::sphere({0, 0, 0}, 1, 8)),
                                     test::opened(test::torus(1, 0.3, 16, 8))};
    Runner runner(makePipelineMaker(), [] {});
    for (int sequence = 0; sequence < 12; ++sequence) {
        Order wanted = orderOf(models[0], 40);
        bool isDragging = false;
        for (int i = 0; i < 8; ++i) {
            switch (below(6)) {
            case 0:
                wanted.options.effort = below(2) == 0 ? Effort::fast : Effort::fair;
                break;
            case 1:
                wanted.options.resolution = 16 + 4 * below(3);
                break;
            case 2:
                wanted.model = models[random() % 2];
                break;
            case 3:
                runner.cancel();
                break;
            case 4:
                isDragging = !isDragging;
                break;
            default:
                wanted.options.faces = 40 + 8 * below(6);
            }
            runner.want(wanted, isDragging, below(2) == 0);
            for (int n = below(40); n > 0; --n) std::this_thread::yield();
            if (below(3) == 0) runner.waitForNews(60);
            runner.update();
            if (const CageResultPtr& made = runner.planner().made()) {
                BOOST_REQUIRE(made->order.model == wanted.model);
                BOOST_REQUIRE((runner.planner().standing() == Planner::Standing::current) == (made->order == wanted));
            }
        }
        wanted.options.faces = 41 + 8 * below(6);
        runner.want(wanted, false, true);
        settle(runner);
        BOOST_CHECK(runner.planner().standing() == Planner::Standing::current);
        const CageResult& made = *runner.planner().made();
        BOOST_TEST(test::sameMesh(made.cage, freshCage(wanted)));
        BOOST_TEST(made.report.check.bounding());
        BOOST_TEST_REQUIRE(made.intermediates.get());
        BOOST_TEST(made.intermediates->solid->activeVoxelCount() == made.report.solidVoxels);
    }
}

BOOST_AUTO_TEST_CASE(after_a_cancel_at_any_ask_the_next_run_gives_a_fresh_pipelines_bytes)
{
    std::mt19937 random(7);
    const OpenedMeshPtr model = test::opened(test::torus(1, 0.3, 12, 6));
    for (const Effort effort : {Effort::fast, Effort::fair, Effort::best}) {
        const Job job{Job::Kind::full, orderOf(model, 60, effort), false};
        const Mesh fresh = freshCage(job.order);
        // Other voxels, so that every stage has something to do.
        std::array<Job, 2> others{job, job};
        std::array<int, 2> asked{};
        for (std::size_t i = 0; i < others.size(); ++i) {
            others[i].order.options.resolution = i == 0 ? 22 : 26;
            constexpr int never = 1 << 30;
            test::StopAt counter(never);
            makePipelineMaker()->make(others[i], counter);
            asked[i] = test::questions(counter, never);
        }
        const std::unique_ptr<CageMaker> maker = makePipelineMaker();
        int cancelled = 0;
        for (std::size_t run = 0; run < 20; ++run) {
            const Job& first = others[run % 2];
            test::StopAt stop(static_cast<int>(random() % static_cast<unsigned>(asked[run % 2])));
            try {
                maker->make(first, stop);
            } catch (const Cancelled&) {
                ++cancelled;
            }
            Interrupter none;
            BOOST_TEST(test::sameMesh(maker->make(job, none)->cage, fresh));
        }
        BOOST_TEST(cancelled >= 15); // what the run before left is not made again, and so asks less
    }
}

BOOST_AUTO_TEST_CASE(an_opened_cage_is_checked_as_the_command_does)
{
    const OpenedMeshPtr model = test::opened(test::sphere({0, 0, 0}, 1, 8));
    Runner runner(makePipelineMaker(), [] {});
    for (const double size : {2.0, 0.5}) {
        Order order = orderOf(model, 100);
        order.cage = test::opened(test::box(openvdb::Vec3d(-size), openvdb::Vec3d(size)));
        runner.want(order, false, true);
        settle(runner);
        const CageResultPtr& made = runner.planner().made();
        BOOST_TEST_REQUIRE(made.get());
        BOOST_TEST(test::sameMesh(made->cage, order.cage->mesh));
        BOOST_TEST(made->report.check.bounding() == (size > 1));
    }
}

BOOST_AUTO_TEST_CASE(an_opened_cage_that_cuts_is_fitted_except_where_it_is_locked)
{
    const OpenedMeshPtr model = test::opened(test::sphere({0, 0, 0}, 1, 8));
    Runner runner(makePipelineMaker(), [] {});
    Order order = orderOf(model, 100);
    Mesh drawn = test::sphere({0, 0, 0}, 0.9, 6);
    drawn.points[0] = drawn.points[0].unit() * 1.5;
    order.cage = test::opened(drawn);
    const auto fitted = [&](const FitOrder& fit) {
        order.fit = fit;
        runner.want(order, false);
        settle(runner);
        BOOST_TEST_REQUIRE(runner.planner().error() == "");
        return runner.planner().made();
    };
    const CageResultPtr least = fitted({0, {0}}), tightest = fitted({1, {0}});
    for (const CageResultPtr& made : {least, tightest}) {
        BOOST_TEST(made->fitProblem == "");
        BOOST_TEST(made->report.check.bounding());
        BOOST_TEST(made->cage.points[0] == drawn.points[0]);
        BOOST_TEST(made->cage.points[1] != drawn.points[1]);
    }
    BOOST_TEST(tightest->report.check.meanDistance < least->report.check.meanDistance);
    // One that bounds already stays at the least moves.
    order.cage = test::opened(least->cage);
    BOOST_TEST(test::sameMesh(fitted({0})->cage, least->cage));
    // What does not come to bound stays as it was drawn, with the reason.
    order.cage = test::opened(drawn);
    FitOrder all;
    for (openvdb::Index32 i = 0; i < drawn.points.size(); ++i) all.locked.push_back(i);
    const CageResultPtr held = fitted(all);
    BOOST_TEST(held->fitProblem.rfind("no place was found where it does not cut the model", 0) == 0u);
    BOOST_TEST(test::sameMesh(held->cage, drawn));
    BOOST_TEST(!held->report.check.bounding());
    Mesh open = drawn;
    open.triangles.pop_back();
    order.cage = test::opened(open);
    const CageResultPtr refused = fitted({0.5});
    BOOST_TEST(refused->fitProblem.rfind("it is not a closed, oriented 2-manifold", 0) == 0u);
    BOOST_TEST(!refused->report.check.valid());
}

BOOST_AUTO_TEST_CASE(an_objection_to_the_model_names_its_file)
{
    Mesh flat;
    flat.points = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}};
    flat.triangles = {{0, 1, 2}};
    Runner runner(makePipelineMaker(), [] {});
    runner.want(orderOf(test::opened(flat, "/some/flat.obj"), 100), false);
    settle(runner);
    BOOST_TEST(runner.planner().error().rfind("/some/flat.obj: ", 0) == 0u);
}

BOOST_AUTO_TEST_SUITE_END()
