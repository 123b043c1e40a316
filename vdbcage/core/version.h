#pragma once

/// Version of these headers. CMakeLists.txt reads it from here too.
#define VDBCAGE_VERSION "0.1.0"
/// The day of this version.
#define VDBCAGE_VERSION_DATE "2026-11-26"
