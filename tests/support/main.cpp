#define BOOST_TEST_MODULE vdbcage
#include <boost/test/unit_test.hpp>
