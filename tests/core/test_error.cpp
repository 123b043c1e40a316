#include <boost/test/unit_test.hpp>

#include <string>

#include <vdbcage/core/error.h>

using namespace vdbcage;

BOOST_AUTO_TEST_SUITE(error)

BOOST_AUTO_TEST_CASE(the_subject_stands_before_the_problem)
{
    const InputError error("model", "it has no faces: at least one is needed");
    BOOST_TEST(error.what() == "model: it has no faces: at least one is needed");
    BOOST_TEST(error.subject() == "model");
    BOOST_TEST(error.problem() == "it has no faces: at least one is needed");
    const InputError copy = error;
    BOOST_TEST(copy.subject() == "model");
}

BOOST_AUTO_TEST_CASE(a_text_with_a_colon_has_no_subject)
{
    const InputError error("model: it has no faces");
    BOOST_TEST(error.subject() == "");
    BOOST_TEST(error.problem() == "model: it has no faces");
}

BOOST_AUTO_TEST_CASE(another_name_for_the_subject_keeps_the_message_in_one_line)
{
    const InputError ofLibrary("points", "point 3 is (nan, 0, 0)\n");
    const InputError ofFile("a\n\xE4.obj", ofLibrary.problem());
    BOOST_TEST(ofFile.what() == "a\\n\\xe4.obj: point 3 is (nan, 0, 0)\\n");
    BOOST_TEST(ofFile.subject() == "a\\n\\xe4.obj");
    BOOST_TEST(ofFile.problem() == "point 3 is (nan, 0, 0)\\n");
}

BOOST_AUTO_TEST_SUITE_END()
