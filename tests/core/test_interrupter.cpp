#include <boost/test/unit_test.hpp>

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

} // namespace

BOOST_AUTO_TEST_SUITE(interrupter)

BOOST_AUTO_TEST_CASE(null_is_nobody_watching)
{
    BOOST_CHECK_NO_THROW(throwIfInterrupted(nullptr));
    BOOST_CHECK_NO_THROW(Stage(nullptr, "a"));
}

BOOST_AUTO_TEST_CASE(stages_are_bracketed_also_by_exceptions)
{
    Recorder recorder;
    {
        const Stage stage(&recorder, "a");
    }
    try {
        const Stage stage(&recorder, "b");
        recorder.stop = true;
        throwIfInterrupted(&recorder, 50);
        BOOST_ERROR("not cancelled");
    } catch (const Cancelled&) {
    }
    BOOST_CHECK_THROW(Stage(&recorder, "c"), Cancelled);
    BOOST_TEST(recorder.log == "<a><b>");
}

BOOST_AUTO_TEST_CASE(the_clock_lists_each_stage_once_and_passes_everything_on)
{
    Recorder recorder;
    StageClock clock(&recorder);
    for (const char* name : {"a", "b", "a"}) const Stage stage(&clock, name);
    BOOST_TEST(recorder.log == "<a><b><a>");
    BOOST_REQUIRE(clock.stages().size() == 2U);
    BOOST_TEST(clock.stages()[0].name == "a");
    BOOST_TEST(clock.stages()[1].name == "b");
    BOOST_TEST(!clock.wasInterrupted());
    recorder.stop = true;
    BOOST_TEST(clock.wasInterrupted());
}

BOOST_AUTO_TEST_CASE(the_clock_counts_work_as_cpu_time)
{
    StageClock clock;
    constexpr double least = 0.01; // seconds
    for (int i = 0; i < 2; ++i) {
        const Stage stage(&clock, "work");
        const std::clock_t until = std::clock() + static_cast<std::clock_t>(least * CLOCKS_PER_SEC);
        while (std::clock() < until) {
        }
    }
    BOOST_REQUIRE(clock.stages().size() == 1U);
    BOOST_TEST(clock.stages()[0].cpuSeconds >= 2 * least);
}

BOOST_AUTO_TEST_SUITE_END()
