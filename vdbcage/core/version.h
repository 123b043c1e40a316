#pragma once

/// Version of these headers (read from here by CMakeLists.txt too).
#define VDBCAGE_VERSION "0.1.0"
