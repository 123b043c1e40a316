#pragma once

#include <string>

#include <vdbcage/bounding/fit.h>

namespace vdbcage::report {

/// Returns the property of the place that a fit did not find, with some of the faces and kept points that hold it back:
/// words that go on after "no place was found where ".
/// \pre it does not bound
std::string unfoundPlace(const Fit& fit);

} // namespace vdbcage::report
