#include <boost/test/unit_test.hpp>

#include <atomic>
#include <random>
#include <thread>

#include <support/shapes.h>
#include <tools/view/posing/binder.h>
#include <vdbcage/core/error.h>
#include <view/support/orders.h>

using namespace vdbcage;
using namespace vdbcage::view;

namespace {

/// Binds for real, when it may: it can be held before the coarse and before the whole binding.
struct Fixture {
    std::atomic<int> steps{1 << 30}; ///< that may still be done
    std::atomic<int> begun{0}, done{0};
    std::string error;
    const OpenedMeshPtr model = test::opened(test::torus(2, 0.3, 48, 24));
    Binder binder{[this](const BindOrder& order, Interrupter& interrupter, const auto& publish) {
                      ++begun;
                      const auto wait = [&] {
                          while (steps <= 0) {
                              throwIfInterrupted(&interrupter, 10);
                              std::this_thread::yield();
                          }
                          --steps;
                      };
                      wait();
                      if (!error.empty()) throw InputError(error);
                      const BoundModelPtr coarse = boundCoarsely(order, &interrupter);
                      publish(coarse);
                      wait();
                      const BoundModelPtr whole = boundWhole(*coarse, &interrupter);
                      ++done;
                      return whole;
                  },
                  [] {}};

    static MeshPtr cage(double radius) { return std::make_shared<const Mesh>(test::torus(2, radius, 16, 8)); }
    BindOrder order(double radius, Coordinates family = Coordinates::meanValue) const
    {
        return {model, cage(radius), family};
    }
    void settle()
    {
        for (;;) {
            binder.update();
            if (binder.isSettled()) return;
            binder.waitForNews(60);
        }
    }
};

} // namespace

BOOST_FIXTURE_TEST_SUITE(binder, Fixture)

BOOST_AUTO_TEST_CASE(a_coarse_binding_comes_first_and_then_the_whole)
{
    steps = 1;
    binder.want(order(0.6));
    while (!binder.bound()) {
        binder.waitForNews(60);
        binder.update();
    }
    BOOST_TEST(!binder.bound()->whole);
    BOOST_TEST(!binder.isSettled());
    steps = 1;
    settle();
    BOOST_TEST_REQUIRE(binder.bound().get());
    BOOST_TEST(binder.bound()->whole->points() == model->mesh.points, boost::test_tools::per_element());
    BOOST_TEST(!binder.progress());
}

BOOST_AUTO_TEST_CASE(what_was_bound_is_there_at_once_also_by_an_equal_cage)
{
    for (const Coordinates family : {Coordinates::meanValue, Coordinates::green, Coordinates::maximumLikelihood}) {
        binder.want(order(0.6, family));
        settle();
    }
    BOOST_TEST(begun == 3);
    for (const Coordinates family : {Coordinates::green, Coordinates::meanValue, Coordinates::maximumLikelihood}) {
        binder.want(order(0.6, family));
        BOOST_TEST(binder.isSettled());
        BOOST_CHECK(binder.bound()->order.family == family);
        BOOST_TEST(binder.bound()->whole.get());
    }
    binder.want(std::nullopt);
    BOOST_TEST(!binder.bound());
    BOOST_TEST(begun == 3);
}

BOOST_AUTO_TEST_CASE(one_that_never_ends_is_stopped_by_another_wish_or_by_cancel)
{
    steps = 0;
    binder.want(order(0.6));
    BOOST_TEST(!binder.isSettled());
    binder.want(order(0.5)); // returns at once
    steps = 1 << 30;
    settle();
    BOOST_CHECK(binder.bound()->order == order(0.5));
    BOOST_TEST(done == 1);
    steps = 0;
    binder.want(order(0.7));
    binder.cancel();
    BOOST_TEST(binder.isSettled());
    BOOST_TEST(binder.isHalted());
    binder.want(order(0.7)); // the same: it stays cancelled
    BOOST_TEST(binder.isHalted());
    steps = 1 << 30;
    binder.again();
    settle();
    BOOST_CHECK(binder.bound()->order == order(0.7));
    steps = 0;
    binder.want(order(0.4)); // and the end of the test ends it
}

BOOST_AUTO_TEST_CASE(errors_arrive_and_the_next_one_works)
{
    error = "no";
    binder.want(order(0.6));
    settle();
    BOOST_TEST(binder.error() == "no");
    BOOST_TEST(binder.isHalted());
    error.clear();
    binder.want(order(0.5));
    settle();
    BOOST_TEST(binder.error().empty());
    BOOST_TEST(binder.bound().get());
}

BOOST_AUTO_TEST_CASE(any_sequence_of_wishes_ends_with_the_last)
{
    std::mt19937 random(7);
    const Coordinates families[3]{Coordinates::meanValue, Coordinates::green, Coordinates::maximumLikelihood};
    for (int sequence = 0; sequence < 100; ++sequence) {
        std::optional<BindOrder> wanted;
        binder.want(wanted);
        for (int i = 0; i < 10; ++i) {
            switch (random() % 5) {
            case 0:
                wanted.reset();
                binder.want(wanted);
                break;
            case 1:
                binder.cancel();
                break;
            case 2:
                binder.update();
                break;
            default:
                wanted = order(0.45 + 0.05 * static_cast<double>(random() % 4), families[random() % 3]);
                binder.want(wanted);
            }
            if (binder.bound()) BOOST_TEST_REQUIRE((wanted && binder.bound()->order == *wanted));
        }
        binder.again();
        settle();
        if (!wanted) continue;
        BOOST_TEST_REQUIRE(binder.bound().get());
        BOOST_TEST(binder.bound()->whole.get());
        BOOST_CHECK(binder.bound()->order == *wanted);
    }
}

BOOST_AUTO_TEST_SUITE_END()
