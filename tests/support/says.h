#pragma once

#include <boost/test/unit_test.hpp>

#include <exception>
#include <string>

namespace vdbcage::test {

/// Returns a predicate for BOOST_CHECK_EXCEPTION: the error's text contains `text`.
inline auto says(const std::string& text)
{
    return [text](const std::exception& error) {
        BOOST_TEST_INFO(error.what());
        return std::string(error.what()).find(text) != std::string::npos;
    };
}

} // namespace vdbcage::test
