#include <boost/test/unit_test.hpp>

#include <type_traits>
#include <vector>

#include <vdbcage/core/detail/stage_parts.h>
#include <vdbcage/core/error.h>
#include <vdbcage/core/interrupter.h>

using namespace vdbcage;

namespace {

struct Recorder : Interrupter {
    void start(const char* name) override { log += std::string("<") + name; }
    void end() override { log += ">"; }
    bool wasInterrupted(int) override { return stop; }
    std::string log;
    bool stop = false;
};

static_assert(!std::is_constructible_v<Stage, Interrupter*, const char*>, "a stage has a row in stageTable");

} // namespace

BOOST_AUTO_TEST_SUITE(interrupter)

BOOST_AUTO_TEST_CASE(null_is_nobody_watching)
{
    BOOST_CHECK_NO_THROW(throwIfInterrupted(nullptr));
    BOOST_CHECK_NO_THROW(Stage(nullptr, StageName::read));
}

BOOST_AUTO_TEST_CASE(stages_are_bracketed_also_by_exceptions)
{
    Recorder recorder;
    {
        const Stage stage(&recorder, StageName::read);
    }
    try {
        const Stage stage(&recorder, StageName::checkThePose);
        recorder.stop = true;
        throwIfInterrupted(&recorder, 50);
        BOOST_ERROR("not cancelled");
    } catch (const Cancelled&) {
    }
    BOOST_CHECK_THROW(Stage(&recorder, StageName::write), Cancelled);
    BOOST_TEST(recorder.log == "<read><check the pose>");
}

BOOST_AUTO_TEST_CASE(the_clock_lists_each_stage_once_and_passes_everything_on)
{
    Recorder recorder;
    StageClock clock(&recorder);
    for (const StageName name : {StageName::read, StageName::bind, StageName::read}) const Stage stage(&clock, name);
    BOOST_TEST(recorder.log == "<read><bind><read>");
    BOOST_REQUIRE(clock.stages().size() == 2U);
    BOOST_TEST(clock.stages()[0].name == "read");
    BOOST_TEST(clock.stages()[1].name == "bind");
    BOOST_TEST(!clock.wasInterrupted());
    recorder.stop = true;
    BOOST_TEST(clock.wasInterrupted());
}

BOOST_AUTO_TEST_CASE(the_clock_counts_work_as_cpu_time)
{
    StageClock clock;
    constexpr double least = 0.01; // seconds
    for (int i = 0; i < 2; ++i) {
        const Stage stage(&clock, StageName::bind);
        const std::clock_t until = std::clock() + static_cast<std::clock_t>(least * CLOCKS_PER_SEC);
        while (std::clock() < until) {
        }
    }
    BOOST_REQUIRE(clock.stages().size() == 1U);
    BOOST_TEST(clock.stages()[0].cpuSeconds >= 2 * least);
}

BOOST_AUTO_TEST_CASE(parts_of_a_stage_say_how_far_the_whole_is)
{
    struct Watcher : Interrupter {
        bool wasInterrupted(int percent) override
        {
            said.push_back(percent);
            return stop;
        }
        std::vector<int> said;
        bool stop = false;
    } watcher;
    detail::StagePart part(&watcher, 40, 60);
    for (const int percent : {0, 50, -1, 100, 200}) throwIfInterrupted(part.passedOn(), percent);
    BOOST_TEST(watcher.said == (std::vector<int>{40, 50, -1, 60, 60}), boost::test_tools::per_element());
    watcher.stop = true;
    BOOST_CHECK_THROW(throwIfInterrupted(part.passedOn()), Cancelled);
    BOOST_TEST(detail::StagePart(nullptr, 0, 50).passedOn() == nullptr);

    watcher = {};
    detail::StagesSideBySide both(&watcher, {3, 1});
    throwIfInterrupted(both.passedOn(0), 50);
    throwIfInterrupted(both.passedOn(1), 20);
    throwIfInterrupted(both.passedOn(0), 30); // it does not go back
    throwIfInterrupted(both.passedOn(1), -1);
    throwIfInterrupted(both.passedOn(0), 100);
    throwIfInterrupted(both.passedOn(1), 101);
    BOOST_TEST(watcher.said == (std::vector<int>{37, 42, 42, -1, 80, 100}), boost::test_tools::per_element());
    watcher.stop = true;
    BOOST_CHECK_THROW(throwIfInterrupted(both.passedOn(1)), Cancelled);
    BOOST_TEST(detail::StagesSideBySide(nullptr, {1, 1}).passedOn(1) == nullptr);
}

BOOST_AUTO_TEST_SUITE_END()
