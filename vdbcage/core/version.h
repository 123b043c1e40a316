#pragma once

/// Version of these headers. CMakeLists.txt reads it from here too.
#define VDBCAGE_VERSION "0.1.0"
