#pragma once

#include <string>
#include <vector>

#include <tools/report/job_results.h>

namespace vdbcage::cli {

/// A page of HTML with all results, in one file. A picture that lies beside a report, of the same name, is in it, made
/// smaller. \throw IoError a picture cannot be read
std::string pageOf(const std::vector<report::JobResult>& results);

} // namespace vdbcage::cli
