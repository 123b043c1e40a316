#pragma once

/// \ingroup core
/// The version of these headers, "MAJOR.MINOR.PATCH". CMakeLists.txt reads it from here too.
#define VDBCAGE_VERSION "0.2.0"
/// \ingroup core
/// The day of this version, "YYYY-MM-DD". Manual pages bear it.
#define VDBCAGE_VERSION_DATE "2026-11-28"
