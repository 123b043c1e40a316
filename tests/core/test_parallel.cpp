// A loop that returns has run every body, whatever happened around it.

#include <boost/test/unit_test.hpp>

#include <algorithm>
#include <atomic>
#include <numeric>
#include <stdexcept>
#include <vector>

#include <support/cancelled_host.h>
#include <tbb/blocked_range.h>
#include <vdbcage/core/detail/parallel.h>

using namespace vdbcage::detail;

namespace {

constexpr int count = 10000;

} // namespace

BOOST_AUTO_TEST_SUITE(parallel)

BOOST_AUTO_TEST_CASE(loops_run_whole_where_the_host_has_cancelled)
{
    std::atomic<int> plain{0}, ours{0}, invoked{0};
    int sum = 0;
    std::vector<int> numbers(count);
    vdbcage::test::inCancelledHost([&] {
        tbb::parallel_for(0, count, [&](int) { ++plain; });
        parallelFor(0, count, [&](int) { ++ours; });
        sum = parallelReduce(
            tbb::blocked_range<int>(0, count, 1), 0,
            [](const tbb::blocked_range<int>& range, int part) { return part + range.end() - range.begin(); },
            std::plus<>());
        parallelInvoke([&] { ++invoked; }, [&] { ++invoked; });
        std::iota(numbers.rbegin(), numbers.rend(), 0);
        parallelSort(numbers.begin(), numbers.end());
    });
    BOOST_TEST(plain < count, "the host's group was not cancelled");
    BOOST_TEST(ours == count);
    BOOST_TEST(sum == count);
    BOOST_TEST(invoked == 2);
    BOOST_TEST(std::is_sorted(numbers.begin(), numbers.end()));
}

BOOST_AUTO_TEST_CASE(loops_of_others_run_whole_too)
{
    std::atomic<int> bodies{0};
    int answer = 0;
    vdbcage::test::inCancelledHost([&] {
        isolated([&] { tbb::parallel_for(0, count, [&](int) { ++bodies; }); });
        answer = isolated([] { return 42; });
    });
    BOOST_TEST(bodies == count);
    BOOST_TEST(answer == 42);
}

BOOST_AUTO_TEST_CASE(loops_within_a_loop_run_whole_when_a_body_beside_them_throws)
{
    std::atomic<int> begun{0}, whole{0};
    const auto body = [&](int i) {
        if (i == 0) throw std::runtime_error("the first");
        ++begun;
        std::atomic<int> inner{0};
        parallelFor(0, 100, [&](int) { ++inner; });
        if (inner == 100) ++whole;
    };
    BOOST_CHECK_THROW(parallelFor(0, 100, body), std::runtime_error);
    BOOST_TEST(whole == begun);
}

BOOST_AUTO_TEST_CASE(what_a_body_throws_arrives)
{
    const auto bad = [](int i) {
        if (i == 77) throw std::runtime_error("77");
    };
    BOOST_CHECK_THROW(parallelFor(0, count, bad), std::runtime_error);
    BOOST_CHECK_THROW(isolated([&]() -> int { throw std::runtime_error("no answer"); }), std::runtime_error);
    vdbcage::test::inCancelledHost([&] { BOOST_CHECK_THROW(parallelFor(0, count, bad), std::runtime_error); });
}

BOOST_AUTO_TEST_SUITE_END()
