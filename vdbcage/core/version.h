#pragma once

/// \ingroup core
/// Version of these headers, "MAJOR.MINOR.PATCH". CMakeLists.txt reads it from here too.
#define VDBCAGE_VERSION "0.1.0"
