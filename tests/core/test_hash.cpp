#include <boost/test/unit_test.hpp>

#include <vdbcage/core/detail/hash.h>

using vdbcage::detail::Hash;

BOOST_AUTO_TEST_SUITE(hash)

BOOST_AUTO_TEST_CASE(known_values_of_fnv_1a)
{
    Hash hash;
    BOOST_TEST(hash.digits() == "cbf29ce484222325");
    hash.add("foo");
    hash.add("bar");
    BOOST_TEST(hash.value() == 0x85944171f73967e8U);
    BOOST_TEST(hash.digits() == "85944171f73967e8");
    Hash other;
    other.add({"\x80\0", 2}); // a byte above 127, a zero, and a value that begins with 0
    BOOST_TEST(other.digits() == "09e58807b65d046d");
}

BOOST_AUTO_TEST_SUITE_END()
