#include <boost/test/unit_test.hpp>

#include <optional>
#include <random>
#include <string>
#include <vector>

#include <tools/report/run_progress.h>
#include <vdbcage/core/stages.h>

using namespace vdbcage;
using report::RunProgress;

namespace {

/// A stage that reports evenly.
void pass(RunProgress& run, const std::string& stage, double from, double seconds)
{
    run.start(stage, from);
    for (int percent = 1; percent <= 100; ++percent) run.advance(percent, from + 0.01 * percent * seconds);
}

} // namespace

BOOST_AUTO_TEST_SUITE(run_progress)

BOOST_AUTO_TEST_CASE(it_never_goes_back, *boost::unit_test::label("property"))
{
    std::vector<std::string> stages{"", "of another program"};
    for (const StageInfo& stage : stageTable) stages.emplace_back(stage.name);
    std::mt19937 random(1);
    for (int i = 0; i < 500; ++i) {
        RunProgress run;
        int last = 0;
        double seconds = 0;
        const auto step = [&](const auto& change) {
            change();
            BOOST_REQUIRE_GE(run.percent(), last);
            BOOST_REQUIRE_LE(run.percent(), 99);
            const auto left = run.secondsLeft(seconds);
            BOOST_REQUIRE(!left || *left > 0);
            last = run.percent();
        };
        for (int k = 0; k < 30; ++k) {
            step([&] { run.start(stages[random() % stages.size()], seconds); });
            for (std::size_t n = random() % 10; n > 0; --n) {
                seconds += 0.1 * static_cast<double>(random() % 100);
                step([&] { run.advance(static_cast<int>(random() % 130) - 10, seconds); });
            }
        }
    }
}

BOOST_AUTO_TEST_CASE(a_run_of_one_try_goes_through_all_percent)
{
    RunProgress run;
    BOOST_TEST(run.percent() == 0);
    std::vector<int> at;
    for (const char* stage :
         {"read", "voxelize", "guard", "voxelize", "close", "surface", "decimate", "quads", "certify", "write"}) {
        pass(run, stage, 0, 0);
        at.push_back(run.percent());
    }
    const std::vector<int> expected{2, 6, 8, 8, 10, 13, 60, 92, 98, 99};
    BOOST_TEST(at == expected, boost::test_tools::per_element());
}

BOOST_AUTO_TEST_CASE(what_begins_later_begins_at_0)
{
    RunProgress saving, binding, unknown, nameless;
    saving.start("write", 0);
    BOOST_TEST(saving.percent() == 0);
    pass(binding, "bind", 0, 0);
    BOOST_TEST(binding.percent() > 90);
    unknown.start("check the pose", 0);
    unknown.advance(42, 1);
    BOOST_TEST(unknown.percent() == 42);
    nameless.advance(42, 1);
    BOOST_TEST(nameless.percent() == 42);
    // A stage of no share in the middle of a run.
    RunProgress run;
    pass(run, "surface", 0, 0);
    pass(run, "tighten", 0, 0);
    const int before = run.percent();
    for (const char* stage : {"coplanar", "smooth", "of another program"}) {
        pass(run, stage, 0, 0);
        BOOST_TEST(run.percent() == before);
    }
}

BOOST_AUTO_TEST_CASE(another_try_shares_out_what_is_left)
{
    RunProgress run;
    for (const char* stage : {"read", "close", "surface", "loops"}) pass(run, stage, 0, 10);
    for (int i = 0; i < 10; ++i) {
        const int before = run.percent();
        run.start("close", 20 * i);
        BOOST_TEST(run.percent() == before);
        for (const char* stage : {"close", "surface", "loops"}) pass(run, stage, 20 * i, 10);
        BOOST_TEST((run.percent() > before || before == 99));
        BOOST_TEST(!run.secondsLeft(20 * i + 9)); // nobody knows how many tries come
    }
}

BOOST_AUTO_TEST_CASE(time_left_is_of_the_run)
{
    RunProgress run;
    pass(run, "read", 0, 1);
    BOOST_TEST(!run.secondsLeft(1)); // a short stage says little
    pass(run, "surface", 1, 3);
    BOOST_TEST(!run.secondsLeft(4));
    run.start("quads", 4);
    run.advance(4, 20);
    BOOST_TEST(!run.secondsLeft(20)); // too early
    // It goes on as slowly as it began: 400 s, whatever came before, and what comes after it takes 8 % of all.
    int last = 1000;
    for (int percent = 5; percent <= 100; ++percent) {
        const double now = 4 + 4 * percent;
        run.advance(percent, now);
        const auto left = run.secondsLeft(now);
        BOOST_REQUIRE(left.has_value());
        BOOST_TEST(*left < last);
        BOOST_TEST(*left >= 404 - now);
        BOOST_TEST(*left <= 1.1 * 404 - now + 1);
        last = *left;
    }
}

BOOST_AUTO_TEST_CASE(time_left_is_counted_down_while_nothing_is_said)
{
    RunProgress run;
    run.start("quads", 0);
    run.advance(20, 20); // of 100 s
    const auto first = run.secondsLeft(20);
    BOOST_REQUIRE(first.has_value());
    int last = *first;
    for (double now = 21; now < 200; ++now) {
        run.advance(20, now); // the same again
        const auto left = run.secondsLeft(now);
        BOOST_TEST((left ? *left == last - 1 : now > 100));
        if (!left) break;
        last = *left;
    }
    BOOST_TEST(last == 1);
    BOOST_TEST(!run.secondsLeft(1000)); // it takes longer: a guess no more
}

BOOST_AUTO_TEST_SUITE_END()
