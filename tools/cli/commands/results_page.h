#pragma once

#include <string>
#include <vector>

#include <tools/report/job_results.h>

namespace vdbcage::cli {

/// Returns a page of HTML with all results, in one file. It contains the picture beside each report, of the same name,
/// reduced in size. \throw IoError a picture cannot be read
std::string pageOf(const std::vector<report::JobResult>& results);

} // namespace vdbcage::cli
