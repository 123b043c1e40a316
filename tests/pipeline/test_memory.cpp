#include <boost/test/unit_test.hpp>

#include <limits>
#include <regex>

#include <vdbcage/core/error.h>
#include <vdbcage/pipeline/memory.h>

#include "runs.h"

using namespace vdbcage;

namespace {

constexpr std::size_t mebibyte = 1024 * 1024;

CageOptions fine()
{
    CageOptions options;
    options.resolution = 1024;
    return options;
}

/// The words of the refusal; empty if it is none.
std::string refusal(const CageOptions& options, std::size_t limit)
{
    try {
        requireMemory(test::saturn(), options, limit);
        return "";
    } catch (const MemoryError& error) {
        return error.what();
    }
}

/// The resolution that a refusal names; 0 if it names none.
int named(const std::string& text)
{
    std::smatch match;
    return std::regex_search(text, match, std::regex("with ([0-9]+) it would fit")) ? std::stoi(match[1]) : 0;
}

} // namespace

BOOST_AUTO_TEST_SUITE(memory)

BOOST_AUTO_TEST_CASE(finer_voxels_larger_models_and_more_faces_take_more)
{
    const Mesh model = test::saturn();
    const std::size_t usual = predictedMemory(model);
    BOOST_TEST(usual > 10 * mebibyte);
    BOOST_TEST(usual < 500 * mebibyte);
    CageOptions options;
    std::size_t last = 0;
    for (const int resolution : {8, 64, 100, 500, 2048}) {
        options.resolution = resolution;
        const std::size_t now = predictedMemory(model, options);
        BOOST_TEST(now > last);
        last = now;
    }
    BOOST_TEST(last > 4000 * mebibyte); // the surface has millions of quads
    BOOST_TEST(last < 8192 * mebibyte); // they are decimated alone
    options.bounding = false;
    BOOST_TEST(predictedMemory(model, options) < last);

    options = {};
    options.faces = 100000;
    BOOST_TEST(predictedMemory(model, options) > usual + 50 * mebibyte);
    BOOST_TEST(predictedMemory(test::sphere({0, 0, 0}, 1, 400)) > usual + 50 * mebibyte);
}

BOOST_AUTO_TEST_CASE(the_resolution_that_a_refusal_names_is_the_finest_that_fits)
{
    CageOptions options = fine();
    for (const std::size_t limit : {100 * mebibyte, 300 * mebibyte, 1024 * mebibyte}) {
        const std::string text = refusal(fine(), limit);
        BOOST_TEST(text.find("--resolution: '1024' would take about ") == 0U, text);
        options.resolution = named(text);
        BOOST_TEST(*options.resolution >= 8, text);
        BOOST_TEST(refusal(options, limit) == "");
        ++*options.resolution;
        BOOST_TEST(refusal(options, limit) != "");
    }
    const std::size_t takes = predictedMemory(test::saturn(), fine());
    BOOST_TEST(refusal(fine(), takes) == "");
    BOOST_TEST(refusal(fine(), takes - 1) != "");
    BOOST_TEST(named(refusal(fine(), takes - 1)) == 1023);
    BOOST_TEST(refusal(fine(), std::numeric_limits<std::size_t>::max()) == "");
}

BOOST_AUTO_TEST_CASE(a_refusal_says_where_no_resolution_would_do)
{
    BOOST_TEST(refusal({}, 1000).find("--resolution: 'auto' would take about ") == 0U);
    BOOST_TEST(refusal({}, 1000).find("no resolution would fit") != std::string::npos);
    CageOptions coarsest;
    coarsest.resolution = 8;
    BOOST_TEST(refusal(coarsest, 1000).find("no resolution would fit") != std::string::npos);
}

BOOST_AUTO_TEST_CASE(bad_options_and_models_are_refused_as_by_a_run)
{
    CageOptions options;
    options.resolution = 7;
    BOOST_CHECK_THROW(predictedMemory(test::saturn(), options), InputError);
    BOOST_CHECK_THROW(requireMemory(test::saturn(), options, 1), InputError);
    BOOST_CHECK_THROW(predictedMemory({}), InputError);
}

BOOST_AUTO_TEST_CASE(a_run_refuses_before_it_makes_surfaces_and_predicts_nothing_without_a_limit)
{
    CageOptions options;
    options.resolution = 128;
    options.effort = Effort::fast;
    options.faces = 100;
    for (const bool isBounding : {true, false}) {
        options.bounding = isBounding;
        Pipeline made(test::saturn());
        test::Watcher refused;
        BOOST_CHECK_THROW(made.run(options, &refused, 60 * mebibyte), MemoryError);
        BOOST_TEST(refused.open() == 0);
        BOOST_TEST(refused.runs["decimate"] == 0);
        test::Watcher without, within;
        const Mesh cage = Pipeline(test::saturn()).run(options, &without);
        BOOST_CHECK(test::sameMesh(Pipeline(test::saturn()).run(options, &within, 8192 * mebibyte), cage));
        BOOST_CHECK(test::sameMesh(made.run(options), cage));
        BOOST_TEST(within.runs["close"] == without.runs["close"] + 1); // of coarser voxels, to predict
    }
}

BOOST_AUTO_TEST_CASE(counting_can_be_cancelled_and_is_no_stage)
{
    test::Watcher watcher(1L << 40);
    predictedMemory(test::saturn(), fine(), &watcher);
    BOOST_TEST(watcher.runs.empty());
    const long asks = watcher.checks;
    BOOST_TEST(asks > 3);
    for (const long at : {0L, asks / 2, asks - 1}) {
        test::Watcher stopping(at);
        BOOST_CHECK_THROW(predictedMemory(test::saturn(), fine(), &stopping), Cancelled);
    }
}

BOOST_AUTO_TEST_SUITE_END()
